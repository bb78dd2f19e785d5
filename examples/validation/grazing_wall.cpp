/// \file
/// A sphere that meets a plane at any angle, with or without spin, has no more energy after than before, and
/// what it lost is what friction and dashpots say they took.

#include "cases.hpp"
#include "impact.hpp"
#include "law_name.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace validation {

namespace {

constexpr double radius = 0.01, speed = 1.0;

/// Shares of the energy before.
struct Balance {
  double gained; ///< 0 where it lost
  double missed; ///< lost and not accounted for
  double lost;
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
  return {std::max(0.0, -lost) / at_first, std::abs(lost - record.lost.total()) / at_first, lost / at_first};
}

template <class Law>
void meet_by(Outcome& out) {
  const double degree = std::numbers::pi / 180.0, w = speed / radius;
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
    for (const double e : {0.2, 0.5, 1.0}) {
      for (const double mu : {0.0, 0.1, 0.5, 1.5}) {
        for (const int steps : {500, 1000, 2000}) {
          double g = 0, m = 0;
          for (const double a : angles) {
            const Balance b = meet<Law>(a * degree, spin.spin, e, mu, steps);
            g = std::max(g, b.gained);
            m = std::max(m, b.missed);
          }
          fmt::print("{} {} e {} mu {} steps {}: gain {:.3g} missed {:.3g}\n", law_name<Law>, spin.name, e,
                     mu, steps, g, m);
        }
      }
    }
  }
  (void)out;
}

} // namespace

Outcome grazing_wall(const Inputs& /*inputs*/) {
  Outcome out;
  meet_by<scree::LinearSpring<>>(out);
  meet_by<scree::HertzMindlin<>>(out);
  return out;
}

} // namespace validation
