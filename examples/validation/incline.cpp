/// \file
/// What lies on an incline: a sphere that rolls or slides, a block that sticks or slides, against the statics
/// and dynamics of rigid bodies.

#include "incline.hpp"
#include "cases.hpp"
#include "degree.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

namespace validation {

namespace {

using namespace incline;

template <class Law>
void sphere_by(Outcome& out) {
  constexpr double mu = 0.3;
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

} // namespace validation
