/// \file
/// A sphere that meets a plane at any angle, with or without spin, has no more energy after than before, and
/// what it lost is what friction and dashpots say they took.

#include "cases.hpp"
#include "degree.hpp"
#include "impact.hpp"
#include "law.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace validation {

namespace {

constexpr double radius = 0.01, speed = 1.0;

struct Balance {
  double gained; ///< over the energy of the motion along the normal before; 0 where it lost
  double missed; ///< lost and not accounted for, over the energy before
  double lost;   ///< over the energy before
};

/// \param angle from the normal, rad
template <class Law>
Balance meet(double angle, const scree::Vector& spin, double restitution, double friction, int steps) {
  // Ours; of a soft grain, so that a contact is a share of the time.
  const scree::Material grain{.density = 2650,
                              .normal_stiffness = 2e5,
                              .shear_stiffness = 1.6e5,
                              .youngs_modulus = 1e8,
                              .poisson_ratio = 0.3,
                              .friction = friction,
                              .restitution = restitution};
  const scree::Vector before{speed * std::sin(angle), 0.0, -speed * std::cos(angle)};
  const Ball ball{grain, radius, before, spin};
  const double mass = mass_of(ball);
  const HertzImpact hertz{effective_modulus(grain, grain), radius, mass, -before.z()};
  const double duration =
      is_hertz<Law> ? hertz.duration : std::numbers::pi * std::sqrt(mass / grain.normal_stiffness);
  const ImpactRecord record = impact<Law>({ball}, &grain, duration, steps, scree::Stiffness::of_contact);
  const auto energy = [&](const scree::Vector& v, const scree::Vector& w) {
    return 0.5 * mass * (v.squaredNorm() + 0.4 * radius * radius * w.squaredNorm());
  };
  const double at_first = energy(before, spin);
  const double lost = at_first - energy(record.after[0].velocity, record.after[0].angular_velocity);
  return {std::max(0.0, -lost) / (0.5 * mass * before.z() * before.z()),
          (lost - record.lost.total()) / at_first, lost / at_first};
}

template <class Law>
void meet_by(Outcome& out) {
  constexpr int steps = 2000;
  const double w = speed / radius;
  const std::vector<double> angles{0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 85.0, 89.0, 89.9};
  struct Spin {
    const char* name;
    scree::Vector spin;
  };
  const std::vector<Spin> spins{{"without spin", scree::Vector::Zero()},
                                {"rolling forward", {0.0, w, 0.0}},
                                {"rolling backward", {0.0, -w, 0.0}},
                                {"spinning obliquely", {0.6 * w, -0.3 * w, 0.8 * w}}};
  for (const Spin& spin : spins) {
    const std::string name = fmt::format("sphere that meets a plane {}, {}", spin.name, law_name<Law>);
    Chart chart{fmt::format("grazing_{}_{}", spin.name, law_name<Law>),
                name + ", mu 0.5",
                "angle from the normal, degrees",
                "share of the energy lost",
                {},
                {}};
    std::replace(chart.name.begin(), chart.name.end(), ' ', '_');
    double gained = 0.0, missed = 0.0, extrapolated = 0.0;
    for (const double e : {0.2, 0.5, 1.0}) {
      for (const double mu : {0.0, 0.1, 0.5, 1.5}) {
        Series lost{fmt::format("scree, e {:g}", e), Origin::code, angles, {}};
        for (const double angle : angles) {
          const Balance coarse = meet<Law>(angle * degree, spin.spin, e, mu, steps / 2);
          const Balance fine = meet<Law>(angle * degree, spin.spin, e, mu, steps);
          gained = std::max(gained, fine.gained);
          missed = std::max(missed, std::abs(fine.missed));
          extrapolated = std::max(extrapolated, std::abs(2.0 * fine.missed - coarse.missed));
          lost.y.push_back(fine.lost);
        }
        if (mu == 0.5) {
          chart.simulated.push_back(lost);
        }
      }
    }
    const double turn = std::numbers::pi / steps;
    const Source never{Origin::theory, "no contact makes energy"};
    const Source balance{Origin::theory, "what is lost is the work of friction and dashpots"};
    out.add(name, "greatest gain over the energy along the normal", "1", 0.0, never, gained,
            {turn * turn, false, "(w dt)^2: spring left over where the contact ends within a step"});
    out.add(name, "largest energy lost and not accounted for, over that before", "1", 0.0, balance, missed,
            {(1.0 + 2.0 * scree::damping_ratio(0.2)) * turn, false,
             "w dt: work of the velocities half a step behind the forces; 2 z w dt: the dashpot sets in "
             "within a step, z of the lowest restitution"});
    out.add(name, "the same, extrapolated to a step of 0", "1", 0.0, balance, extrapolated,
            {4.0 * turn * turn, false, "(w dt)^2 of the coarser of the two steps"});
    out.draw(chart);
  }
}

} // namespace

/// Angles from normal to grazing, restitutions 0.2 to 1, frictions 0 to 1.5, spins in both senses.
Outcome grazing_wall(const Inputs& /*inputs*/) {
  Outcome out;
  meet_by<scree::LinearSpring<>>(out);
  meet_by<scree::HertzMindlin<>>(out);
  out.notes.push_back(
      "Walls make no energy: angles 0 to 89.9 degrees, e 0.2, 0.5 and 1, mu 0, 0.1, 0.5 and 1.5; the "
      "table has the worst of each spin. Radius, speed and material are ours.");
  return out;
}

} // namespace validation
