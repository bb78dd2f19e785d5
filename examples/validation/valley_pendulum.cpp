/// \file
/// A clump that rolls to and fro in a trough: a physical pendulum of finite amplitude.

#include "cases.hpp"
#include "impact.hpp"
#include "law.hpp"

#include "scree/core/random.hpp"
#include "scree/integrators/leapfrog.hpp"
#include "scree/integrators/rotor_splitting.hpp"

#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/jacobi_elliptic.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <type_traits>
#include <vector>

namespace validation {

namespace {

constexpr double g = 9.81, trough = 0.1, wheel = 0.02, hub = 0.01, half_axle = 0.032; // m

template <class Law, class Used>
struct Rolling : scree::DefaultModel {
  using Contact = Law;
  using Integrator = Used;
};

/// I / (m r^2) of two wheels and a hub apart from each other, spheres of one density, about their axle.
double inertia_ratio() {
  return 0.4 * (2.0 * std::pow(wheel, 5) + std::pow(hub, 5)) /
         ((2.0 * std::pow(wheel, 3) + std::pow(hub, 3)) * wheel * wheel);
}

struct Swing {
  double period = 0.0;                          ///< s
  double lowest_speed = 0.0, spin = 0.0;        ///< m/s, rad/s, the first time at the bottom
  double yaw = 0.0;                             ///< largest spin across the axle over the greatest spin
  double overlap = 0.0;                         ///< m, at rest
  Series angles{"scree", Origin::code, {}, {}}; ///< degrees over s
};

template <class Law, class Integrator>
Swing swing(double amplitude) {
  scree::Simulation<Rolling<Law, Integrator>> sim{
      {.stiffness = scree::Stiffness::of_contact, .time_step = 1e-5, .top_speed = 0.02}};
  const scree::Material material{.density = 2650,
                                 .normal_stiffness = 1e6,
                                 .shear_stiffness = 1e6,
                                 .youngs_modulus = 2e10,
                                 .poisson_ratio = 0.25,
                                 .friction = 1.0,
                                 .restitution = 0.5};
  const auto id = sim.add_material(material);
  const auto shape = scree::make_clump("axle", std::vector<scree::Sphere>{{{-half_axle, 0.0, 0.0}, wheel},
                                                                          {{0.0, 0.0, 0.0}, hub},
                                                                          {{half_axle, 0.0, 0.0}, wheel}});
  // The trough and gravity lie across all axes of space, and the clump's own axes across those of the trough.
  const scree::Quaternion turned = scree::Random{11, "trough"}.orientation();
  const scree::Vector along = turned * scree::Vector::UnitX(), across = turned * scree::Vector::UnitY(),
                      up = turned * scree::Vector::UnitZ();
  sim.set_gravity(-g * up);
  sim.add_wall({.name = "trough",
                .surfaces = {{scree::Cylinder{.axis = along, .radius = trough}, id}},
                .dynamics = scree::Fixed{}});
  Swing out;
  // N, on one wheel at the start.
  const double load = 0.5 * material.density * shape.volume * g;
  const auto depth = [&](double force) {
    return is_hertz<Law> ? std::pow(0.75 * force / (effective_modulus(material, material) * std::sqrt(wheel)),
                                    2.0 / 3.0)
                         : force / material.normal_stiffness;
  };
  out.overlap = depth(load);
  const double arm = trough - wheel + depth(load * std::cos(amplitude));
  sim.add({.clump = &shape,
           .material = id,
           .position = arm * (std::sin(amplitude) * across - std::cos(amplitude) * up),
           .orientation = turned * scree::Quaternion{Eigen::AngleAxisd{0.7, scree::Vector::UnitX()}}});
  const auto& bodies = sim.bodies();
  const auto angle = [&] {
    const scree::Vector p = bodies.position(0);
    return std::atan2(p.dot(across), -p.dot(up));
  };
  std::vector<double> crossings;
  double before = angle(), sideways = 0.0;
  while (crossings.size() < 5 && sim.time() < 10.0) {
    sim.step();
    const double now = angle();
    const scree::Vector w = bodies.angular_velocity(0);
    sideways = std::max(sideways, (w - along * along.dot(w)).norm());
    if ((before < 0.0) != (now < 0.0)) {
      crossings.push_back(sim.time() - sim.time_step() * now / (now - before));
      if (crossings.size() == 1) {
        out.lowest_speed = bodies.velocity(0).norm();
        out.spin = w.norm();
      }
    }
    before = now;
    if (sim.steps() % 1000 == 0) {
      out.angles.x.push_back(sim.time());
      out.angles.y.push_back(now * 180.0 / std::numbers::pi);
    }
  }
  out.period = (crossings.back() - crossings.front()) / (0.5 * static_cast<double>(crossings.size() - 1));
  out.yaw = sideways / out.spin;
  return out;
}

template <class Law, class Integrator>
void swing_by(Outcome& out, const std::string& integrator) {
  const std::string name = fmt::format("axle in a trough, {}, {}", law_name<Law>, integrator);
  const double ratio = inertia_ratio(), length = (trough - wheel) * (1.0 + ratio);
  const double small = 2.0 * std::numbers::pi * std::sqrt(length / g);
  Chart chart{
      "valley_pendulum_" + integrator + "_" + law_name<Law>, name, "time, s", "angle, degrees", {}, {}};
  for (const double degrees : {2.0, 30.0, 60.0}) {
    const double amplitude = degrees * std::numbers::pi / 180.0;
    const Swing s = swing<Law, Integrator>(amplitude);
    // The wheel presses with up to 3 - 2 cos(amplitude) of its weight.
    const Tolerance yielding{s.overlap / wheel * (3.0 - 2.0 * std::cos(amplitude)), true,
                             "overlap over the wheel's radius: arm of friction and length of the pendulum"};
    const double period = small * 2.0 / std::numbers::pi * boost::math::ellint_1(std::sin(0.5 * amplitude));
    out.add(name, fmt::format("period from {:g} degrees", degrees), "s", period,
            {Origin::theory, "pendulum of length (R - r)(1 + I / (m r^2)), complete elliptic integral"},
            s.period, yielding);
    const double fastest =
        std::sqrt(2.0 * g * (trough - wheel) * (1.0 - std::cos(amplitude)) / (1.0 + ratio));
    out.add(name, fmt::format("speed at the bottom from {:g} degrees", degrees), "m/s", fastest,
            {Origin::theory, "energy of a body that rolls without slip"}, s.lowest_speed, yielding);
    out.add(name, fmt::format("r w / v at the bottom from {:g} degrees", degrees), "1", 1.0,
            {Origin::theory, "rolls without slip"}, wheel * s.spin / s.lowest_speed, yielding);
    out.add(name, fmt::format("spin across the axle from {:g} degrees over that about it", degrees), "1", 0.0,
            {Origin::theory, "both wheels alike"}, s.yaw,
            {1e-9, false, "symmetry: rounding that 2e5 steps add up"});
    // sin(angle / 2) = k cd(t sqrt(g / length), k), k = sin(amplitude / 2).
    Series exact{"pendulum", Origin::theory, {}, {}};
    const double modulus = std::sin(0.5 * amplitude);
    for (double t = 0.0; t < s.angles.x.back(); t += 0.05) {
      const double half = std::asin(modulus * boost::math::jacobi_cd(modulus, t * std::sqrt(g / length)));
      exact.x.push_back(t);
      exact.y.push_back(2.0 * half * 180.0 / std::numbers::pi);
    }
    chart.references.push_back(exact);
    chart.references.back().label = fmt::format("pendulum from {:g} degrees", degrees);
    chart.simulated.push_back(s.angles);
    chart.simulated.back().label = fmt::format("from {:g} degrees", degrees);
  }
  out.draw(chart);
}

} // namespace

/// An axle with two wheels and a hub, set down at rest on the side of a trough.
Outcome valley_pendulum(const Inputs& /*inputs*/) {
  Outcome out;
  swing_by<scree::LinearSpring<>, scree::Leapfrog>(out, "Leapfrog");
  swing_by<scree::LinearSpring<>, scree::RotorSplitting>(out, "RotorSplitting");
  swing_by<scree::HertzMindlin<>, scree::Leapfrog>(out, "Leapfrog");
  out.notes.push_back(
      "Physical pendulum: a clump cannot be hung from a pivot, as nothing in scree holds a clump but "
      "contacts. The axle in a trough obeys the same equation. Its sizes and material are ours.");
  return out;
}

} // namespace validation
