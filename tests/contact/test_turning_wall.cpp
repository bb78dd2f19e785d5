/// \file
/// The tangential spring of a contact with a wall turns as the wall turns under the sphere.

#include "support/relative_error.hpp"

#include "scree/simulation/simulation.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace scree;

namespace turning_wall_tests {
using test::relative_error;

namespace {

constexpr double radius = 0.01, overlap = 1e-5, slip = 1e-6, stiffness = 1e6, dt = 1e-6, rate = 500.0;

/// The tangential force on a sphere that has loaded its spring by `slip` along x and then turned with the
/// plane z = 0 as one body about `axis` through the contact, over the force before, in the frame of the
/// plane.
Vector turned_force(const Vector& axis, double angle) {
  const double loaded_at = 100 * dt;
  const auto turn_at = [&](double time) {
    return Quaternion{Eigen::AngleAxisd{rate * std::max(0.0, time - loaded_at), axis}};
  };
  Simulation<> sim{{.stiffness = Stiffness::of_contact, .gravity = Vector::Zero(), .time_step = dt}};
  // So heavy that the contact does not move it: it goes where it is told to.
  const auto heavy = sim.add_material(
      {.density = 1e15, .normal_stiffness = stiffness, .shear_stiffness = stiffness, .friction = 0.9});
  const Clump ball = make_clump("ball", std::vector<Sphere>{{Vector::Zero(), radius}});
  const Vector start{-slip, 0.0, radius - overlap}, loaded{0.0, 0.0, radius - overlap};
  sim.add({.clump = &ball, .material = heavy, .position = start});
  sim.add_wall({.name = "table", .surfaces = {{Plane{}, heavy}}, .dynamics = Prescribed{[=](double time) {
                                                                   return Pose{Vector::Zero(), turn_at(time)};
                                                                 }}});
  const auto place_at = [&](double time) {
    return time <= loaded_at ? Vector(start + (loaded - start) * (time / loaded_at))
                             : Vector(turn_at(time) * loaded);
  };
  // Of the step's forces, which are those at its start.
  const auto tangential = [&](double time) {
    const Vector normal = turn_at(time) * Vector::UnitZ();
    const Vector force = to_eigen(sim.bodies().forces()[0].force);
    return Vector(turn_at(time).conjugate() * (force - normal * normal.dot(force)));
  };
  Vector before = Vector::Zero();
  const int steps = static_cast<int>(std::lround((loaded_at + angle / rate) / dt));
  for (int step = 0; step <= steps; ++step) {
    // As in any motion, the velocity is that which led to the place; gravity bends the path. The first kick
    // is a half.
    const double now = step * dt;
    const Vector goes = place_at(now + dt) - place_at(now);
    const Vector came = step > 0 ? Vector(place_at(now) - place_at(now - dt)) : goes;
    const bool turning = now > loaded_at + 0.5 * dt;
    sim.set_motion(0, came / dt, turning ? Vector(rate * axis) : Vector(Vector::Zero()));
    sim.set_gravity((goes - came) / (dt * dt));
    sim.step();
    if (std::abs(now - loaded_at) < 0.5 * dt) {
      before = tangential(now);
    }
  }
  CHECK(relative_error(before.norm(), stiffness * slip) < 0.02);
  CHECK(sim.dissipation().friction == 0.0);
  return tangential(steps * dt) / before.norm();
}

} // namespace

TEST_CASE("the spring of a wall contact turns with the wall, about any axis") {
  const double angle = 2.5;
  for (const Vector& axis : {Vector{0.0, 0.0, 1.0}, Vector{1.0, 0.0, 0.0}, Vector{0.0, 1.0, 0.0},
                             Vector{2.0, -1.0, 2.0}.normalized()}) {
    CAPTURE(axis.transpose());
    const Vector force = turned_force(axis, angle);
    MESSAGE("turned by 2.5 rad about " << axis.transpose() << ": force in the frame of the wall "
                                       << force.transpose());
    // In the frame of the wall it still points back along x.
    // Second order of the step: the velocity is that of a chord, shorter than the arc by a^3 / 6 in a step of
    // a.
    const double a = rate * dt;
    CHECK((force + Vector::UnitX()).norm() < 1.05 * angle * radius / slip * a * a / 6.0);
  }
}

} // namespace turning_wall_tests
