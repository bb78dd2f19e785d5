/// \file
/// Two spheres with a loaded tangential spring that turn as one rigid body, in a simulation: the force turns
/// with them.

#include "cases.hpp"
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

constexpr double radius_i = 0.01, radius_j = 0.015, overlap = 2e-5, slip = 5e-6, rate = 200.0;
constexpr int loading = 100; // steps

/// How much the tangential force changes in the frame of the pair, over its size.
template <class Law>
double turn_pair(const scree::Vector& axis, double angle, int steps) {
  const double dt = angle / rate / steps;
  scree::Simulation<With<Law>> sim{{.stiffness = scree::Stiffness::of_contact,
                                    .gravity = scree::Vector::Zero(),
                                    .time_step = dt,
                                    .sort_interval = 0}};
  // So heavy that the contact does not move it: it goes where gravity takes it. The rest is ours.
  const auto id = sim.add_material({.density = 1e15,
                                    .normal_stiffness = 1e6,
                                    .shear_stiffness = 8e5,
                                    .youngs_modulus = 1e9,
                                    .poisson_ratio = 0.3,
                                    .friction = 0.6,
                                    .restitution = 1.0});
  const auto shape = scree::make_clump("ball", std::vector<scree::Sphere>{{scree::Vector::Zero(), 1.0}});
  const scree::Vector loaded{0.0, 0.0, radius_i + radius_j - overlap};
  const scree::Vector start = loaded - slip * scree::Vector::UnitX();
  sim.add({.clump = &shape, .material = id, .position = start, .scale = radius_i});
  sim.add({.clump = &shape, .material = id, .scale = radius_j, .fixed = true});
  const auto turn_at = [&](int step) {
    return scree::Quaternion{Eigen::AngleAxisd{angle * std::max(0, step - loading) / steps, axis}};
  };
  // At rest before and in the first step, whose kick is a half.
  const auto place = [&](int step) {
    const double share = std::clamp(static_cast<double>(step - 1) / (loading - 1), 0.0, 1.0);
    return scree::Vector(turn_at(step) * (start + share * (loaded - start)));
  };
  // Of the step's forces, which are those at its start.
  const auto tangential = [&](int step) {
    const scree::Vector force = scree::to_eigen(sim.bodies().forces()[0].force);
    const scree::Vector normal = place(step).normalized();
    return scree::Vector(turn_at(step).conjugate() * (force - normal * normal.dot(force)));
  };
  scree::Vector before = scree::Vector::Zero();
  for (int step = 0; step <= loading + steps; ++step) {
    // As in any motion, the velocity is that which led to the place; gravity bends the path.
    const scree::Vector here = place(step), came = here - place(step - 1), goes = place(step + 1) - here;
    const scree::Vector spin =
        step > loading ? scree::Vector(rate * axis) : scree::Vector(scree::Vector::Zero());
    sim.set_motion(0, came / dt, spin);
    sim.set_motion(1, scree::Vector::Zero(), spin);
    sim.set_gravity((goes - came) / (dt * dt));
    sim.step();
    if (step == loading) {
      before = tangential(step);
    }
  }
  return (tangential(loading + steps) - before).norm() / before.norm();
}

template <class Law>
void turn_by(Outcome& out) {
  struct Axis {
    const char* name;
    scree::Vector direction;
  };
  const std::vector<Axis> axes{{"the normal (both twist together)", scree::Vector::UnitZ()},
                               {"the direction of the force", scree::Vector::UnitX()},
                               {"across force and normal", scree::Vector::UnitY()},
                               {"an axis oblique to all", scree::Vector{1.0, 2.0, -0.7}.normalized()}};
  const Source rigid_pair{Origin::theory, "a rigid pair: the force turns with it"};
  constexpr double distance = radius_i + radius_j - overlap;
  for (const Axis& axis : axes) {
    const std::string name = fmt::format("pair turned about {}, {}", axis.name, law_name<Law>);
    const double across = std::hypot(axis.direction.x(), axis.direction.y());
    for (const int quarters : {1, 4}) {
      const int steps = 10000 * quarters;
      const double angle = 0.5 * std::numbers::pi * quarters, a = angle / steps;
      // Velocities are those of the chord of half a step ago. Across the axis they seem to slip by a^3/6 in a
      // step of `a`, as the chord is shorter than the arc; the spring itself is turned to third order.
      const double slips = angle * distance / slip * a * a / 6.0 * across;
      const double turns = angle * a * a / 6.0;
      const Tolerance of_step{
          1.05 * (slips + turns) + 1e-11, false,
          "second order of the step, as the leapfrog is: chord for arc, and the turn of the "
          "spring to third order in each step"};
      const double off = turn_pair<Law>(axis.direction, angle, steps);
      out.add(name, fmt::format("change of the force in the pair after {} degrees", 90 * quarters), "1", 0.0,
              rigid_pair, off, of_step);
      if (quarters == 1) {
        const double fine = turn_pair<Law>(axis.direction, angle, 2 * steps);
        out.add(name, "order of the change in the step", "1", 2.0, {Origin::theory, "the leapfrog's order"},
                std::log2(off / fine),
                {0.02, false, "next term of the error: of the order of a step's turn, 1e-4"});
      }
    }
  }
}

} // namespace

/// One sphere is led round the other: loaded by a slip of 5 um, then turned by 90 and 360 degrees.
Outcome turning_pair(const Inputs& /*inputs*/) {
  Outcome out;
  turn_by<scree::LinearSpring<>>(out);
  turn_by<scree::HertzMindlin<>>(out);
  out.notes.push_back("Turning pair: radii, slip and material are ours.");
  return out;
}

} // namespace validation
