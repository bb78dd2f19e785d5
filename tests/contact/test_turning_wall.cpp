/// \file
/// The tangential spring of a contact with a wall turns as the wall turns under the sphere.

#include "support/relative_error.hpp"

#include "scree/simulation/simulation.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace scree;
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
  const auto& bodies = sim.bodies();
  const auto tangential = [&] {
    const Vector normal =
        turn_at(sim.time() - dt) * Vector::UnitZ(); // the forces are those before the last move
    const Vector force = to_eigen(bodies.forces()[0].force);
    return Vector(turn_at(sim.time() - dt).conjugate() * (force - normal * normal.dot(force)));
  };
  Vector before = Vector::Zero();
  while (rate * (sim.time() - loaded_at) < angle) {
    const bool turning = sim.time() > loaded_at - 0.5 * dt;
    sim.set_motion(0, (place_at(sim.time() + dt) - bodies.position(0)) / dt,
                   turning ? Vector(rate * axis) : Vector(Vector::Zero()));
    sim.step();
    if (std::abs(sim.time() - dt - loaded_at) < 0.5 * dt) {
      before = tangential();
    }
  }
  CHECK(relative_error(before.norm(), stiffness * slip) < 0.02);
  CHECK(sim.dissipation().friction == 0.0);
  return tangential() / before.norm();
}

} // namespace

TEST_CASE("the spring of a wall contact turns with the wall, about any axis") {
  const double angle = 2.5;
  for (const Vector& axis : {Vector{0.0, 0.0, 1.0}, Vector{1.0, 0.0, 0.0}, Vector{0.0, 1.0, 0.0},
                             Vector{2.0, -1.0, 2.0}.normalized()}) {
    CAPTURE(axis.transpose());
    const Vector force = turned_force(axis, angle);
    // Velocities stand half a step behind the normal. About an oblique axis this is a false slip of
    // rate^2 dt / 2 times the distance of the centre along the plane from the axis, first order in the step.
    const double false_slip = 0.5 * dt * rate * angle * radius * std::abs(axis.z()) * axis.head<2>().norm();
    MESSAGE("turned by 2.5 rad about " << axis.transpose() << ": force in the frame of the wall "
                                       << force.transpose() << "; false slip at most " << false_slip / slip);
    // In the frame of the wall it still points back along x.
    CHECK((force + Vector::UnitX()).norm() < 0.01 + 1.01 * false_slip / slip);
  }
}
