/// \file
/// What lies on an incline: a sphere that rolls or slides, a block that sticks or slides, a sphere held by
/// rolling resistance. All against the statics and dynamics of rigid bodies.

#include "cases.hpp"
#include "impact.hpp"
#include "law_name.hpp"

#include "scree/contact/rolling_resistance.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace validation {

namespace {

constexpr double radius = 0.01, g = 9.81;

/// Ours, as the results do not depend on it but by the overlap, 1e-4 r by both laws.
scree::Material stone(double friction, double rolling_friction = 0.0) {
  return {.density = 2650,
          .normal_stiffness = 1e5,
          .shear_stiffness = 8e4,
          .youngs_modulus = 2e9,
          .poisson_ratio = 0.25,
          .friction = friction,
          .restitution = 0.3, // the springs come to rest within some 10 ms
          .rolling_friction = rolling_friction};
}

/// Bodies on the plane z = 0, whose slope is in the direction of gravity.
template <class Law>
struct Incline {
  scree::Simulation<With<Law>> sim;
  scree::Clump shape;

  Incline(const scree::Material& material, const std::vector<scree::Sphere>& spheres, const Law& law = {})
      : sim{{.contact = law,
             .stiffness = scree::Stiffness::of_contact,
             .gravity = {0.0, 0.0, -g},
             .time_step = 1e-5,
             .top_speed = 0.05}},
        shape{scree::make_clump("body", spheres)} {
    const auto id = sim.add_material(material);
    sim.add_wall({.name = "incline", .surfaces = {{scree::Plane{}, id}}, .dynamics = scree::Fixed{}});
    const double depth = overlap(material, 0.0);
    sim.add({.clump = &shape, .material = id, .position = {0.0, 0.0, radius - depth}});
  }

  /// m, of each sphere at rest, where the normal is turned by `angle` from gravity.
  [[nodiscard]] double overlap(const scree::Material& material, double angle) const {
    const double load =
        material.density * shape.volume * g * std::cos(angle) / static_cast<double>(shape.spheres.size());
    if constexpr (!is_hertz<Law>) {
      return load / material.normal_stiffness;
    }
    return std::pow(0.75 * load / (effective_modulus(material, material) * std::sqrt(radius)), 2.0 / 3.0);
  }

  void tilt(double angle) { sim.set_gravity(g * scree::Vector{std::sin(angle), 0.0, -std::cos(angle)}); }
  /// Tilts without a jerk in 0.3 s, so that springs and friction carry what they can carry at rest.
  void raise(double angle) {
    constexpr double duration = 0.3;
    const double begin = sim.time();
    while (sim.time() < begin + duration) {
      const double s = (sim.time() - begin) / duration;
      tilt(angle * s * s * s * (10.0 - 15.0 * s + 6.0 * s * s));
      sim.step();
    }
    tilt(angle);
  }
  void run(double duration) {
    const double end = sim.time() + duration;
    while (sim.time() < end) {
      sim.step();
    }
  }
  [[nodiscard]] double speed() const { return sim.bodies().velocity(0).x(); }
  [[nodiscard]] double spin() const { return sim.bodies().angular_velocity(0).y(); }
};

const std::vector<scree::Sphere> ball{{scree::Vector::Zero(), radius}};

/// How a body is sped up once its springs are at rest.
struct Speeding {
  double linear, angular; ///< m/s2, rad/s2
  double rolling;         ///< r w / v at the end
};

template <class Law>
Speeding speed_up(Incline<Law>& incline, double settling = 0.1, double duration = 0.1) {
  incline.run(settling);
  const double time = incline.sim.time(), v = incline.speed(), w = incline.spin();
  incline.run(duration);
  const double passed = incline.sim.time() - time;
  return {(incline.speed() - v) / passed, (incline.spin() - w) / passed,
          radius * incline.spin() / incline.speed()};
}

/// The place between `low` and `high` where `above` begins to hold.
template <class Predicate>
double threshold(double low, double high, Predicate above) {
  for (int k = 0; k < 12; ++k) {
    const double middle = 0.5 * (low + high);
    (above(middle) ? high : low) = middle;
  }
  return 0.5 * (low + high);
}

template <class Law>
void sphere_by(Outcome& out) {
  constexpr double mu = 0.3, degree = std::numbers::pi / 180.0;
  const scree::Material material = stone(mu);
  const std::string name = fmt::format("sphere on an incline, mu {:g}, {}", mu, law_name<Law>);
  const double most = Incline<Law>{material, ball}.overlap(material, 0.0) / radius;
  const Tolerance arm{most, true,
                      "friction acts half the overlap above the foot: up to the overlap at rest over r"};
  const Tolerance exact{1e-9, true, "a constant force, which the leapfrog has no error for: rounding"};
  const Source rolls{Origin::theory, "rolling without slip: 5/7 g sin"},
      slides{Origin::theory, "sliding: g (sin - mu cos), 5/2 mu g cos / r"};
  const auto at = [&](double angle) {
    Incline<Law> incline{material, ball};
    incline.tilt(angle);
    return speed_up(incline);
  };
  const double change = std::atan(3.5 * mu);
  Series found{std::string{"scree, "} + law_name<Law>, Origin::code, {}, {}}, spins = found;
  Series theory{"rigid sphere", Origin::theory, {}, {}}, spins_theory = theory;
  for (const double degrees : {5.0, 15.0, 25.0, 35.0, 42.0, 46.0, 46.8, 50.0, 60.0, 70.0, 80.0}) {
    const double angle = degrees * degree;
    const Speeding s = at(angle);
    const bool slip = angle > change;
    const double a = g * (slip ? std::sin(angle) - mu * std::cos(angle) : 5.0 / 7.0 * std::sin(angle));
    const double alpha = (slip ? 2.5 * mu * g * std::cos(angle) : a) / radius;
    found.x.push_back(degrees);
    found.y.push_back(s.linear / g);
    spins.x.push_back(degrees);
    spins.y.push_back(s.angular * radius / g);
    theory.x.push_back(degrees);
    theory.y.push_back(a / g);
    spins_theory.x.push_back(degrees);
    spins_theory.y.push_back(alpha * radius / g);
    out.add(name, fmt::format("acceleration at {:g} degrees", degrees), "m/s2", a, slip ? slides : rolls,
            s.linear, slip ? exact : arm);
    out.add(name, fmt::format("angular acceleration at {:g} degrees", degrees), "rad/s2", alpha,
            slip ? slides : rolls, s.angular, arm);
    if (!slip) {
      out.add(name, fmt::format("r w / v at {:g} degrees", degrees), "1", 1.0, rolls, s.rolling, arm);
    }
  }
  // The contact's speed grows by g (sin - 7/2 mu cos) beyond the change; what is looked for is 1/1000 of v.
  const double slope = threshold(0.9 * 3.5 * mu, 1.1 * 3.5 * mu, [&](double tangent) {
    const Speeding s = at(std::atan(tangent));
    return s.angular * radius < (1.0 - 1e-3) * s.linear;
  });
  out.add(name, "slope at which it begins to slide", "1", 3.5 * mu,
          {Origin::theory, "tan(angle) = 7/2 mu for a sphere"}, slope,
          {1e-3 + 0.2 / (1 << 12) + most, true,
           "slip looked for, 1/1000 of the speed (ours); bisection; half the overlap off friction's arm"});
  out.draw({std::string{"incline_"} + law_name<Law>,
            name,
            "angle of the incline, degrees",
            "a / g and r w' / g",
            {theory, spins_theory},
            {found, spins}});
}

template <class Law>
void block_by(Outcome& out) {
  constexpr double mu = 0.4, half = 0.015;
  const scree::Material material = stone(mu);
  const std::string name = fmt::format("block of four spheres on an incline, mu {:g}, {}", mu, law_name<Law>);
  std::vector<scree::Sphere> feet;
  for (const double x : {-half, half}) {
    for (const double y : {-half, half}) {
      feet.push_back({{x, y, 0.0}, radius});
    }
  }
  for (const double share : {0.5, 0.9, 0.99}) {
    const double angle = std::atan(share * mu);
    Incline<Law> incline{material, feet};
    incline.raise(angle);
    incline.run(0.1);
    const double before = incline.sim.bodies().position(0).x();
    incline.run(0.2);
    const double moved = incline.sim.bodies().position(0).x() - before;
    out.add(name, fmt::format("creep at a slope of {:g} mu, over g sin t^2 / 2", share), "1", 0.0,
            {Origin::theory, "Coulomb: rests below atan(mu)"}, moved / (0.02 * g * std::sin(angle)),
            {1e-9, false, "at rest to rounding once the springs are"});
  }
  for (const double share : {1.01, 1.1, 1.5, 2.0}) {
    const double angle = std::atan(share * mu);
    Incline<Law> incline{material, feet};
    incline.raise(angle);
    const Speeding s = speed_up(incline);
    out.add(name, fmt::format("acceleration at a slope of {:g} mu", share), "m/s2",
            g * (std::sin(angle) - mu * std::cos(angle)), {Origin::theory, "sliding: g (sin - mu cos)"},
            s.linear, {1e-9, true, "a constant force, which the leapfrog has no error for: rounding"});
  }
}

template <class Law>
void resisted_by(Outcome& out) {
  for (const double mu_r : {0.02, 0.1, 0.3}) {
    const scree::Material material = stone(0.9, mu_r);
    const std::string name =
        fmt::format("sphere on an incline, rolling resistance {:g}, {}", mu_r, law_name<Law>);
    const Law law{scree::RollingResistance{.damping = 0.3}};
    const double most = Incline<Law>{material, ball, law}.overlap(material, 0.0) / radius;
    const double slope = threshold(0.95 * mu_r, 1.05 * mu_r, [&](double tangent) {
      Incline<Law> incline{material, ball, law};
      incline.raise(std::atan(tangent));
      incline.run(0.3);
      return incline.speed() > 1e-4 * g * tangent * 0.3;
    });
    out.add(name, "slope at which it begins to roll", "1", mu_r,
            {Origin::theory, "m g r sin = mu_r r m g cos"}, slope,
            {1e-4 * 1.4 + 0.1 / (1 << 12) + most, true,
             "speed looked for, 1e-4 of g tan t (ours); bisection; half the overlap off friction's arm"});
    for (const double share : {1.1, 1.5, 2.0}) {
      const double angle = std::atan(share * mu_r);
      Incline<Law> incline{material, ball, law};
      incline.raise(angle);
      const Speeding s = speed_up(incline);
      const double a = 5.0 / 7.0 * g * (std::sin(angle) - mu_r * std::cos(angle));
      out.add(name, fmt::format("acceleration at a slope of {:g} mu_r", share), "m/s2", a,
              {Origin::theory, "rolling against a couple: 5/7 g (sin - mu_r cos)"}, s.linear,
              {most * share / (share - 1.0), true,
               "half the overlap off friction's arm, over the share of the slope that is left"});
    }
    Incline<Law> rests{material, ball, law};
    rests.raise(std::atan(0.98 * mu_r));
    rests.run(0.5);
    const double before = rests.sim.bodies().position(0).x();
    rests.run(0.5);
    out.add(name, "creep at a slope of 0.98 mu_r, over r", "1", 0.0, {Origin::theory, "rests below mu_r"},
            (rests.sim.bodies().position(0).x() - before) / radius,
            {1e-6, false, "the rolling spring and its dashpot have come to rest (ours)"});
  }
}

} // namespace

/// A sphere set down at rest on inclines from flat to steep.
Outcome sphere_on_incline(const Inputs& /*inputs*/) {
  Outcome out;
  sphere_by<scree::LinearSpring<>>(out);
  sphere_by<scree::HertzMindlin<>>(out);
  return out;
}

/// Four spheres in a square that move as one body, on an incline raised slowly.
Outcome block_on_incline(const Inputs& /*inputs*/) {
  Outcome out;
  block_by<scree::LinearSpring<>>(out);
  block_by<scree::HertzMindlin<>>(out);
  return out;
}

/// A sphere with rolling resistance on an incline raised slowly.
Outcome resisted_rolling(const Inputs& /*inputs*/) {
  Outcome out;
  resisted_by<scree::LinearSpring<scree::RollingResistance>>(out);
  resisted_by<scree::HertzMindlin<scree::RollingResistance>>(out);
  return out;
}

} // namespace validation
