/// \file
/// Two spheres with a loaded tangential spring that turn as one rigid body, in a simulation: the force turns
/// with them.

#include "cases.hpp"
#include "impact.hpp"
#include "law_name.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace validation {

namespace {

constexpr double radius_i = 0.01, radius_j = 0.015, overlap = 2e-5, slip = 5e-7, rate = 200.0;
constexpr int loading = 100; // steps

/// N; after the turn in the frame of the pair, less that before.
struct Turned {
  double size_off, direction_off; ///< over the size before, rad
};

/// \param angle rad; a multiple of that of a step
template <class Law>
Turned turn_pair(const scree::Vector& axis, double angle, int steps) {
  const double dt = angle / rate / steps;
  scree::Simulation<With<Law>> sim{{.stiffness = scree::Stiffness::of_contact,
                                    .gravity = scree::Vector::Zero(),
                                    .time_step = dt,
                                    .sort_interval = 0}};
  // So heavy that the contact does not move them: they go where they are told to. The rest is ours.
  const auto id = sim.add_material({.density = 1e15,
                                    .normal_stiffness = 1e6,
                                    .shear_stiffness = 8e5,
                                    .youngs_modulus = 1e9,
                                    .poisson_ratio = 0.3,
                                    .friction = 0.6,
                                    .restitution = 1.0});
  const auto shape = scree::make_clump("ball", std::vector<scree::Sphere>{{scree::Vector::Zero(), 1.0}});
  // The axis goes through a point beside the pair, so that both spheres move.
  const scree::Vector centre{0.003, -0.002, 0.006};
  const scree::Vector loaded_i = scree::Vector{0.0, 0.0, radius_i + radius_j - overlap} - centre, j = -centre;
  const scree::Vector start_i = loaded_i - slip * scree::Vector::UnitX();
  sim.add({.clump = &shape, .material = id, .position = start_i, .scale = radius_i});
  sim.add({.clump = &shape, .material = id, .position = j, .scale = radius_j});
  const auto turn_at = [&](int step) {
    return scree::Quaternion{Eigen::AngleAxisd{angle * std::max(0, step - loading) / steps, axis}};
  };
  const auto place = [&](int step, std::size_t b) -> scree::Vector {
    if (b == 1) {
      return turn_at(step) * j;
    }
    return step <= loading ? scree::Vector(start_i + (loaded_i - start_i) * step / loading)
                           : scree::Vector(turn_at(step) * loaded_i);
  };
  // Of the step's forces, which are those at its start.
  const auto tangential = [&](int step) {
    const scree::Vector force = scree::to_eigen(sim.bodies().forces()[0].force);
    const scree::Vector normal = (place(step, 0) - place(step, 1)).normalized();
    return scree::Vector(turn_at(step).conjugate() * (force - normal * normal.dot(force)));
  };
  scree::Vector before = scree::Vector::Zero();
  for (int step = 0; step < loading + steps + 1; ++step) {
    const bool turning = step >= loading;
    for (std::size_t b = 0; b < 2; ++b) {
      sim.set_motion(b, (place(step + 1, b) - sim.bodies().position(b)) / dt,
                     turning ? scree::Vector(rate * axis) : scree::Vector(scree::Vector::Zero()));
    }
    // A step takes its forces at its start, from the motion that led there; the motion set now leads on.
    sim.step();
    if (step == loading) {
      before = tangential(step);
    }
  }
  const scree::Vector after = tangential(loading + steps);
  return {std::abs(after.norm() / before.norm() - 1.0), (after.normalized() - before.normalized()).norm()};
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
  for (const Axis& axis : axes) {
    const std::string name = fmt::format("pair turned about {}, {}", axis.name, law_name<Law>);
    for (const int quarters : {1, 4}) {
      const int steps = 5000 * quarters;
      const double angle = 0.5 * std::numbers::pi * quarters, a = angle / steps;
      const Turned off = turn_pair<Law>(axis.direction, angle, steps);
      out.add(name, fmt::format("size after {} degrees", 90 * quarters), "1", 0.0, rigid_pair, off.size_off,
              {1e-9, false, "x"});
      out.add(name, fmt::format("direction after {} degrees", 90 * quarters), "rad", 0.0, rigid_pair,
              off.direction_off, {1e-9, false, "x"});
      const Turned fine = turn_pair<Law>(axis.direction, angle, 2 * steps);
      fmt::print("{} {}: a {} size {} {} dir {} {}\n", name, quarters, a, off.size_off, fine.size_off,
                 off.direction_off, fine.direction_off);
    }
  }
}

} // namespace

Outcome turning_pair(const Inputs& /*inputs*/) {
  Outcome out;
  turn_by<scree::LinearSpring<>>(out);
  turn_by<scree::HertzMindlin<>>(out);
  return out;
}

} // namespace validation
