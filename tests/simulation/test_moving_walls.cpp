/// \file
/// Walls that move, and what grains do to them.

#include "scree/simulation/run.hpp"
#include "scree/simulation/simulation.hpp"
#include "support/meshes.hpp"
#include "support/relative_error.hpp"
#include "support/scenes.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

using namespace scree;

namespace moving_walls_tests {

namespace {

constexpr double g = 9.81, radius = 0.01;
const Clump ball = test::ball(radius);
const Material rock{.normal_stiffness = 2e4, .shear_stiffness = 2e4, .friction = 0.5, .restitution = 0.5};
const double ball_mass = rock.density * ball.volume;
const double sinking = ball_mass * g / 1e4; ///< m, of a ball at rest

} // namespace

TEST_CASE("a ball on a belt is dragged at mu g until it has the belt's speed, as it rolls up") {
  // Sliding: v = mu g t, w = -5/2 mu g t / r, until v - (-w r) = V, that is v = 2/7 V; from then on it rolls.
  const double belt = 0.3, mu = 0.5;
  Simulation<> sim{{.time_step = 1e-5}};
  const auto id = sim.add_material(rock);
  sim.add({.clump = &ball, .material = id, .position = {0, 0, radius - sinking}});
  sim.add_wall(
      {.name = "belt", .surfaces = {{Plane{}, id}}, .dynamics = Prescribed::constant_velocity({belt, 0, 0})});
  const double slides = 2.0 * belt / (7.0 * mu * g);
  run_for(sim, 0.5 * slides);
  CHECK(sim.bodies().velocity(0).x() == test::about(mu * g * 0.5 * slides, 1e-3));
  CHECK(sim.wall(0).load.force.x() == test::about(-mu * ball_mass * g, 1e-3));
  run_for(sim, slides);
  CHECK(sim.bodies().velocity(0).x() == test::about(2.0 / 7.0 * belt, 2e-3));
  CHECK(sim.bodies().angular_velocity(0).y() == test::about(-5.0 / 7.0 * belt / radius, 2e-3));
  CHECK(sim.bodies().velocity(0).y() == 0.0);
  // The belt's work went into the ball's motion and into friction.
  CHECK(sim.wall(0).load.work ==
        test::about(sim.bodies().kinetic_energy(0) + sim.dissipation().total(), 0.01));
  CHECK(sim.wall(0).motion.position.x() == test::about(belt * sim.time()));
}

TEST_CASE("a floor that follows any function carries a ball along") {
  // Slow against the contact: the ball's inertia adds to its weight.
  const double amplitude = 1e-3, rate = 40.0;
  Simulation<> sim{{.time_step = 1e-5}};
  const auto id = sim.add_material(rock);
  sim.add({.clump = &ball, .material = id, .position = {0, 0, radius - sinking}});
  sim.add_wall({.name = "shaker",
                .surfaces = {{Plane{}, id}},
                .dynamics = Prescribed{[=](double t) {
                  return Pose{{0, 0, amplitude * (1.0 - std::cos(rate * t))}};
                }}});
  run_for(sim, 0.1);
  for (int k = 0; k < 100; ++k) {
    run_for(sim, 2e-3);
    const double acceleration = amplitude * rate * rate * std::cos(rate * (sim.time() - sim.time_step()));
    REQUIRE(-sim.wall(0).load.force.z() == test::about(ball_mass * (g + acceleration), 0.01));
  }
}

TEST_CASE("a turning drum takes what slides in it up to where friction ends") {
  // Four balls in one clump cannot roll. It slides down as fast as the wall comes up where its weight
  // balances the normal forces of its two rows, at an angle b before and behind its centre, and their
  // friction: with A = (R - r) cos2(b), tan(slope) = mu R / (A - mu2 (R - A)), from the balance along and
  // across the slope and of the moments about the axis. The damping ends the swing about that point, which
  // friction alone would not.
  const double inside = 0.2, mu = 0.3;
  Simulation<> sim{{.time_step = 2e-5, .local_damping = 0.7}};
  Material smooth = rock;
  smooth.friction = mu;
  const auto id = sim.add_material(smooth);
  std::vector<Sphere> spheres;
  for (const double x : {0.0, 1.5}) {
    for (const double y : {0.0, 3.0}) {
      spheres.push_back({radius * Vector{x, y, 0.0}, radius});
    }
  }
  const Clump plate = make_clump("plate", spheres);
  const Cylinder drum{.base = {0, -1, 0}, .axis = Vector::UnitY(), .radius = inside, .length = 2.0};
  // The clump's longest axis, its first, lies along the drum's.
  sim.add({.clump = &plate,
           .material = id,
           .position = {0, 0, -inside + 1.1 * radius},
           .orientation = Quaternion{Eigen::AngleAxisd{0.5 * std::numbers::pi, Vector::UnitZ()}}});
  sim.add_wall(
      {.name = "drum", .surfaces = {{drum, id}}, .dynamics = Prescribed::constant_rotation({0, 1.0, 0})});
  run_for(sim, 6.0);
  const Vector at = sim.bodies().position(0);
  const double off_axis = inside - radius - 0.75 * radius * 0.75 * radius / (inside - radius);
  const double slope = std::atan(mu * inside / (off_axis - mu * mu * (inside - off_axis)));
  CHECK(at.x() < 0.0); // at the bottom the wall moves towards -x
  CHECK(std::atan2(-at.x(), -at.z()) == test::about(slope, 1e-3));
  CHECK(std::abs(at.y()) < 1e-3 * inside);
  CHECK(sim.bodies().velocity(0).norm() < 0.01 * inside); // of the wall's 0.2 m/s
  CHECK(sim.wall(0).load.contacts == 4);
  // The drum's moment about its axis is that of friction, and its work is what friction takes.
  CHECK(sim.wall(0).load.moment.y() == test::about(sim.bodies().mass(0) * g * at.x(), 0.01));
}

TEST_CASE(
    "a ball at rest on a wall loads it with its weight, and with the moment of it about the wall's origin") {
  for (const bool on_mesh : {false, true}) {
    CAPTURE(on_mesh);
    Simulation<> sim{{.time_step = 2e-5, .local_damping = 0.3}};
    const auto id = sim.add_material(rock);
    const Vector origin{0.5, -0.3, -0.2}, at{0.13, 0.07, 0.0};
    sim.add({.clump = &ball, .material = id, .position = at + Vector{0, 0, radius - 0.5 * sinking}});
    std::vector<WallSurface> surfaces;
    if (on_mesh) {
      TriangleMesh slab = test::box_mesh({2.0, 2.0, 0.1});
      for (Vector& v : slab.vertices) {
        v += Vector{0, 0, -0.05} - origin;
      }
      surfaces.emplace_back(slab, id);
    } else {
      surfaces.emplace_back(Plane{-origin, Vector::UnitZ()}, id);
    }
    sim.add_wall(
        {.name = "floor", .surfaces = surfaces, .dynamics = Fixed{}, .motion = {.position = origin}});
    run_for(sim, 0.2);
    const Vector weight{0, 0, -ball_mass * g};
    const WallLoad before = sim.wall(0).load;
    CHECK((before.force - weight).norm() < 1e-6 * ball_mass * g);
    CHECK((before.moment - (at - origin).cross(weight)).norm() < 1e-6 * ball_mass * g);
    CHECK(before.contacts == 1);
    const double from = sim.time();
    run_for(sim, 0.1);
    const double passed = sim.time() - from;
    CHECK((sim.wall(0).load.impulse - before.impulse - weight * passed).norm() <
          1e-6 * ball_mass * g * passed);
    CHECK((sim.wall(0).load.angular_impulse - before.angular_impulse - (at - origin).cross(weight) * passed)
              .norm() < 1e-6 * ball_mass * g * passed);
    CHECK(sim.wall(0).load.work == 0.0);
  }
}

TEST_CASE("a ball on a slope loads it in two directions") {
  Simulation<> sim{{.time_step = 2e-5, .local_damping = 0.3}};
  const auto id = sim.add_material(rock);
  // Three balls, so that nothing rolls.
  const Clump tripod = make_clump("tripod", std::vector<Sphere>{{{0.01, 0, 0}, radius},
                                                                {{-0.005, 0.0087, 0}, radius},
                                                                {{-0.005, -0.0087, 0}, radius}});
  // Its principal frame has the normal of the three as z, the axis of the largest moment.
  const double slope = 0.3;
  const Quaternion tilt{Eigen::AngleAxisd{slope, Vector::UnitY()}};
  sim.add({.clump = &tripod, .material = id, .position = tilt * Vector{0, 0, radius}, .orientation = tilt});
  sim.add_wall(
      {.name = "slope", .surfaces = {{Plane{}, id}}, .dynamics = Fixed{}, .motion = {.orientation = tilt}});
  run_for(sim, 0.5);
  const double weight = sim.bodies().mass(0) * g;
  const Vector load = tilt.conjugate() * sim.wall(0).load.force;
  CHECK(load.z() == test::about(-weight * std::cos(slope), 1e-5));
  CHECK(load.x() == test::about(weight * std::sin(slope), 1e-5));
  CHECK(std::abs(load.y()) < 1e-6 * weight);
  CHECK(sim.bodies().velocity(0).norm() < 1e-7);
}

TEST_CASE("a force-controlled lid comes to rest on balls at its force, and follows it when it changes") {
  Simulation<> sim{{.time_step = 1e-5, .local_damping = 0.2}};
  const auto id = sim.add_material(rock);
  for (const Vector& at :
       {Vector{0.05, 0, 0}, Vector{-0.02, 0.04, 0}, Vector{-0.03, -0.05, 0}, Vector{0, 0, 0}}) {
    sim.add({.clump = &ball, .material = id, .position = at + Vector{0, 0, radius - sinking}});
  }
  sim.add_wall({.name = "floor", .surfaces = {{Plane{}, id}}, .dynamics = Fixed{}});
  const auto lid =
      sim.add_wall({.name = "lid",
                    .surfaces = {{Plane{Vector::Zero(), -Vector::UnitZ()}, id}},
                    .dynamics = ForceControlled{{.mass = 0.1,
                                                 .force = [](double t) { return t < 0.5 ? 2.0 : 3.0; },
                                                 .damping = 3.0}},
                    .motion = {.position = {0, 0, 2.5 * radius}}});
  run_for(sim, 0.499);
  CHECK(sim.wall(lid).load.force.z() == test::about(2.0, 1e-5));
  CHECK(sim.wall(lid).load.contacts == 4);
  CHECK(sim.wall(lid).motion.velocity.norm() < 1e-6);
  // Both contacts of a ball give way: the lid's is 0.5 N deep, the floor's by the weight more.
  CHECK(sim.wall(lid).motion.position.z() ==
        test::about(2.0 * radius - 0.5 / 1e4 - (0.5 + ball_mass * g) / 1e4, 1e-7));
  run_for(sim, 0.5);
  CHECK(sim.wall(lid).load.force.z() == test::about(3.0, 1e-5));
  CHECK(sim.wall(0).load.force.z() == test::about(-3.0 - 4.0 * ball_mass * g, 1e-5));
  // Straight down and up: nothing sideways.
  CHECK(sim.wall(lid).motion.position.head<2>().isZero(0.0));
}

TEST_CASE("a lid on nothing falls with its force over its mass") {
  Simulation<> sim{{.time_step = 1e-4}};
  const auto lid =
      sim.add_wall({.name = "lid",
                    .surfaces = {},
                    .dynamics = ForceControlled{
                        {.axis = {0, 0, -3.0}, .mass = 0.5, .force = [](double) { return 1.5; }}}});
  run_for(sim, 0.2);
  CHECK(sim.wall(lid).motion.position.z() == test::about(-0.5 * 3.0 * 0.04, 1e-9));
}

TEST_CASE("walls of several kinds act in one simulation, each on the grains that it meets") {
  Simulation<> sim{{.time_step = 1e-5, .local_damping = 0.3}};
  const auto id = sim.add_material(rock);
  const double tray_mass = 0.3;
  std::vector<Rope> ropes;
  for (const Vector& corner : {Vector{0.05, 0, 0}, Vector{-0.03, 0.04, 0}, Vector{-0.03, -0.04, 0}}) {
    const Vector winch = corner + Vector{0, 1, 1};
    ropes.push_back({.hitch = corner, .winch = winch, .stiffness = 2e3, .damping = 20.0});
  }
  const MassProperties tray{tray_mass, Vector::Zero(), Vector{2e-4, 2e-4, 3e-4}.asDiagonal()};
  const auto floor = sim.add_wall({.name = "floor", .surfaces = {{Plane{}, id}}, .dynamics = Fixed{}});
  const auto lid =
      sim.add_wall({.name = "lid",
                    .surfaces = {{test::box_mesh({0.05, 0.05, 0.01}), id}},
                    .dynamics = ForceControlled{{.mass = 0.1, .force = [](double) { return 1.0; }}},
                    .motion = {.position = {0, 0, 2.0 * radius + 0.005}}});
  const auto paddle =
      sim.add_wall({.name = "paddle",
                    .surfaces = {{test::box_mesh({0.01, 0.1, 0.1}), id}},
                    .dynamics = Prescribed::constant_velocity({0.1, 0, 0}, {.position = {0.1, -1, 0.05}})});
  const auto hung = sim.add_wall({.name = "tray",
                                  .surfaces = {{test::box_mesh({0.1, 0.1, 0.02}), id}},
                                  .dynamics = RopeCoupled{tray, ropes},
                                  .motion = {.position = {0, 1, 0.3}}});
  sim.add({.clump = &ball, .material = id, .position = {0, 0, radius}});
  sim.add({.clump = &ball, .material = id, .position = {0.2, -1, radius}});
  sim.add({.clump = &ball, .material = id, .position = {0, 1, 0.31 + radius}});
  run_for(sim, 3.0);
  CHECK(sim.wall(lid).load.force.z() == test::about(1.0, 1e-4));
  CHECK(sim.wall(floor).load.force.z() == test::about(-1.0 - 2.0 * ball_mass * g, 0.02)); // paddle's rub
  CHECK(sim.wall(hung).load.force.z() == test::about(-ball_mass * g, 1e-4));
  double tension = 0.0;
  for (const Rope& rope : sim.dynamics<RopeCoupled>(hung).ropes()) {
    tension += rope.tension;
  }
  CHECK(tension == test::about((tray_mass + ball_mass) * g, 1e-4));
  CHECK(sim.wall(paddle).motion.position.x() == test::about(0.4));
  CHECK(sim.wall(paddle).load.impulse.x() < -0.1 * ball_mass);
  const std::size_t pushed = test::number_of(sim, 1);
  CHECK(sim.bodies().position(pushed).x() > 0.4 + 0.005 + radius - 1e-5);
}

TEST_CASE("a prescribed wall refuses a path that is not a number") {
  Simulation<> sim{{.time_step = 1e-4}};
  sim.add_wall({.name = "wild",
                .surfaces = {},
                .dynamics = Prescribed{[](double t) {
                  return Pose{{t < 1e-3 ? 0.0 : std::numeric_limits<double>::quiet_NaN(), 0, 0}};
                }}});
  CHECK_THROWS_WITH_AS(run_for(sim, 0.01), doctest::Contains("prescribed wall"), Error);
}

} // namespace moving_walls_tests
