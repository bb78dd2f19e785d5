/// \file
/// Momentum and angular momentum change only by what acts from outside.

#include "scree/core/random.hpp"
#include "scree/simulation/run.hpp"
#include "scree/simulation/simulation.hpp"
#include "support/meshes.hpp"
#include "support/relative_error.hpp"
#include "support/scenes.hpp"

#include <doctest/doctest.h>

#include <algorithm>

using namespace scree;

namespace {

struct Momenta {
  Vector linear = Vector::Zero();
  Vector angular = Vector::Zero(); ///< about the origin of space

  void add(double mass, const Vector& x, const Vector& v, const Matrix& inertia, const Vector& w) {
    linear += mass * v;
    angular += mass * x.cross(v) + inertia * w;
  }
};

template <class Sim>
Momenta of_grains(const Sim& sim) {
  Momenta sum;
  const auto& bodies = sim.bodies();
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const Matrix turn = bodies.orientation(b).toRotationMatrix();
    sum.add(bodies.mass(b), bodies.position(b), bodies.velocity(b),
            turn * bodies.inertia(b).asDiagonal() * turn.transpose(), bodies.angular_velocity(b));
  }
  return sum;
}

const MassProperties scoop_body{0.5, {0.01, 0.0, 0.02}, Vector{4e-4, 5e-4, 6e-4}.asDiagonal()};

/// A box without a lid, of mesh, hung on two ropes and dragged through grains on a floor.
struct Dig : Simulation<> {
  std::size_t floor = 0, side = 0, scoop = 0;
  double gravity_time = 0.0; ///< s, over which gravity has acted on the velocities

  explicit Dig(bool stones)
      : Simulation<>{{.gravity = {0.5, 0.0, -9.81}, .time_step = 2e-5, .sort_interval = 37}} {
    const auto rock =
        add_material({.normal_stiffness = 3e4, .shear_stiffness = 3e4, .friction = 0.4, .restitution = 0.7});
    const Clump ball = test::ball(0.006), stone = test::stone(0.006);
    Random random{191};
    for (std::size_t k = 0; k < 200; ++k) {
      const auto along = [](std::size_t n) { return 0.02 + 0.018 * static_cast<double>(n); };
      add({.clump = stones && k % 2 == 0 ? &stone : &ball,
           .material = rock,
           .position = {along(k % 10), along(k / 10 % 5) - 0.05, along(k / 50)},
           .orientation = random.orientation(),
           .velocity = 0.3 * Vector{random.normal(), random.normal(), random.normal()},
           .angular_velocity = 5.0 * Vector{random.normal(), random.normal(), random.normal()}});
    }
    floor = add_wall({.name = "floor", .surfaces = {{Plane{}, rock}}, .dynamics = Fixed{}});
    side = add_wall(
        {.name = "side", .surfaces = {{Plane{{0.22, 0, 0}, {-1, 0, 0}}, rock}}, .dynamics = Fixed{}});
    TriangleMesh box = test::box_mesh({0.06, 0.06, 0.05});
    Rope drag{
        .name = "drag", .hitch = {0.03, 0, 0}, .winch = {0.6, 0.05, 0.1}, .stiffness = 2e4, .damping = 5.0};
    drag.wound = [](double t) { return 0.4 * t; };
    const Rope hoist{.name = "hoist", .hitch = {-0.02, 0.01, 0.025}, .winch = {0, 0, 0.5}, .stiffness = 1e4};
    scoop = add_wall({.name = "scoop",
                      .surfaces = {{box, rock}},
                      .dynamics = RopeCoupled{scoop_body, {drag, hoist}},
                      .motion = {.position = {-0.03, 0, 0.06}}});
  }

  void advance() {
    gravity_time += steps() == 0 ? 0.5 * time_step() : time_step();
    step();
  }
};

} // namespace

TEST_CASE(
    "physics: momentum of a rope-coupled body and grains changes only by gravity, ropes and fixed walls") {
  for (const bool stones : {false, true}) {
    CAPTURE(stones);
    Dig dig{stones};
    const Vector start = of_grains(dig).linear;
    double mass = scoop_body.mass;
    for (std::size_t b = 0; b < dig.bodies().size(); ++b) {
      mass += dig.bodies().mass(b);
    }
    for (int part = 0; part < 5; ++part) {
      for (int k = 0; k < 1500; ++k) {
        dig.advance();
      }
      const auto& body = dig.dynamics<RopeCoupled>(dig.scoop);
      const Vector now = of_grains(dig).linear + scoop_body.mass * body.velocity();
      const Vector gravity = mass * dig.setup().gravity * dig.gravity_time;
      Vector outside = gravity;
      double passed = gravity.norm();
      for (const Rope& rope : body.ropes()) {
        outside += rope.impulse;
        passed += rope.impulse.norm();
      }
      for (const std::size_t wall : {dig.floor, dig.side}) {
        outside -= dig.wall(wall).load.impulse;
        passed += dig.wall(wall).load.impulse.norm();
      }
      CHECK((now - start - outside).norm() < 1e-9 * passed);
    }
    // All of it was at work.
    for (const Rope& rope : dig.dynamics<RopeCoupled>(dig.scoop).ropes()) {
      CHECK(rope.impulse.norm() > 0.01);
    }
    CHECK(dig.wall(dig.scoop).load.impulse.norm() > 0.01);
    CHECK(dig.wall(dig.side).load.impulse.norm() > 0.01);
  }
}

TEST_CASE("physics: angular momentum of spheres changes only by the moments of gravity and walls") {
  // Of spheres the leapfrog keeps it exactly: x_n x (v_n+1/2 - v_n-1/2) is the moment at the step, and the
  // drift is along v. A wall's angular impulse is about its own origin, here that of space.
  Simulation<> sim{{.gravity = {0.3, -0.2, -5.0}, .time_step = 2e-5, .sort_interval = 41}};
  const auto rock = sim.add_material(
      {.normal_stiffness = 3e4, .shear_stiffness = 3e4, .friction = 0.4, .restitution = 0.7});
  const Clump ball = test::ball(0.006);
  Random random{192};
  for (int k = 0; k < 125; ++k) {
    sim.add({.clump = &ball,
             .material = rock,
             .position = 0.014 * Vector(k % 5 + 1, k / 5 % 5 + 1, k / 25 + 1),
             .velocity = 0.5 * Vector{random.normal(), random.normal(), random.normal()},
             .angular_velocity = 30.0 * Vector{random.normal(), random.normal(), random.normal()}});
  }
  sim.add_wall({.name = "box",
                .surfaces = {{Plane{}, rock}, {test::box_mesh({0.2, 0.2, 0.02}), rock}},
                .dynamics = Fixed{}});
  const Momenta start = of_grains(sim);
  Vector gravity = Vector::Zero();
  double passed = start.angular.norm();
  for (int k = 0; k < 5000; ++k) {
    Vector moment = Vector::Zero();
    for (std::size_t b = 0; b < 125; ++b) {
      moment += sim.bodies().position(b).cross(sim.bodies().mass(b) * sim.setup().gravity);
    }
    gravity += moment * (k == 0 ? 0.5 : 1.0) * sim.time_step();
    sim.step();
  }
  const Momenta end = of_grains(sim);
  const Vector& wall = sim.wall(0).load.angular_impulse;
  passed += gravity.norm() + wall.norm();
  CHECK(wall.norm() > 1e-4);
  CHECK((end.angular - start.angular - gravity + wall).norm() < 1e-9 * passed);
}

TEST_CASE("physics: angular momentum that a free wall body and clumps exchange is kept to two millionths") {
  const auto gap = [](double dt) {
    // No gravity or walls but the free body, which stones hit: all is internal.
    Simulation<> sim{{.gravity = Vector::Zero(), .time_step = dt}};
    const auto rock = sim.add_material(
        {.normal_stiffness = 3e4, .shear_stiffness = 3e4, .friction = 0.4, .restitution = 0.7});
    const Clump stone = test::stone(0.006);
    Random random{193};
    for (int k = 0; k < 60; ++k) {
      sim.add({.clump = &stone,
               .material = rock,
               .position = {-0.06 - 0.02 * (k % 15), 0.02 * (k / 15 % 2) - 0.01, 0.02 * (k / 30) - 0.01},
               .orientation = random.orientation(),
               .velocity = {1.0, 0.05 * random.normal(), 0.05 * random.normal()}});
    }
    const auto scoop = sim.add_wall({.name = "scoop",
                                     .surfaces = {{test::box_mesh({0.06, 0.06, 0.05}), rock}},
                                     .dynamics = RopeCoupled{scoop_body}});
    const auto momenta = [&] {
      Momenta all = of_grains(sim);
      const auto& wall = sim.wall(scoop);
      const auto& body = sim.dynamics<RopeCoupled>(scoop);
      const Matrix turn = wall.motion.orientation.toRotationMatrix();
      all.add(scoop_body.mass, wall.motion.to_space(body.centre()), body.velocity(),
              turn * scoop_body.inertia * turn.transpose(), wall.motion.angular_velocity);
      return all;
    };
    const Momenta start = of_grains(sim);
    run_for(sim, 0.1);
    CHECK(sim.wall(scoop).load.impulse.norm() > 0.01);
    const Momenta end = momenta();
    CHECK((end.linear - start.linear).norm() < 1e-12);
    double size = 0.0; // angular momentum that was exchanged
    size += sim.wall(scoop).load.angular_impulse.norm() + 0.06 * sim.wall(scoop).load.impulse.norm();
    return (end.angular - start.angular).norm() / size;
  };
  const double coarse = gap(2e-5), fine = gap(4e-6);
  CHECK(coarse < 2e-6);
  CHECK(fine < 0.4 * coarse);
}

TEST_CASE("a thrown clump flies along the parabola and keeps its spin") {
  Simulation<> sim{{.gravity = {1.0, -2.0, -9.81}, .time_step = 1e-4}};
  const auto rock = sim.add_material({.normal_stiffness = 1e4, .shear_stiffness = 1e4});
  const Clump stone = test::stone(0.01);
  const Vector at{0.1, 0.2, 0.3}, velocity{1.0, 2.0, 3.0};
  const auto id = sim.add({.clump = &stone,
                           .material = rock,
                           .position = at,
                           .orientation = Quaternion{0.9, 0.2, -0.3, 0.1},
                           .velocity = velocity,
                           .angular_velocity = {10.0, -20.0, 15.0}});
  const auto spin = [&] {
    const Matrix turn = sim.bodies().orientation(0).toRotationMatrix();
    return Vector(turn * sim.bodies().inertia(0).asDiagonal() * turn.transpose() *
                  sim.bodies().angular_velocity(0));
  };
  sim.step();
  REQUIRE(test::number_of(sim, id) == 0);
  const Vector before = spin();
  const Quaternion start = sim.bodies().orientation(0);
  const auto rotational = [&] {
    const double v2 = sim.bodies().velocity(0).squaredNorm();
    return sim.bodies().kinetic_energy(0) - 0.5 * sim.bodies().mass(0) * v2;
  };
  const double energy = rotational();
  double turned = 0.0;
  while (sim.time() < 1.0) {
    const std::vector<SphereRecord<double>> members{sim.bodies().spheres().begin(),
                                                    sim.bodies().spheres().end()};
    sim.step();
    const double t = sim.time();
    REQUIRE((sim.bodies().position(0) - at - velocity * t - 0.5 * sim.setup().gravity * t * t).norm() <
            1e-11);
    REQUIRE((spin() - before).norm() < 0.01 * before.norm());
    REQUIRE(rotational() == test::about(energy, 1e-6));
    turned = std::max(turned, sim.bodies().orientation(0).angularDistance(start));
    // Its members move with it.
    const auto& bodies = sim.bodies();
    for (std::size_t s = 0; s < stone.spheres.size(); ++s) {
      const Vector arm = bodies.orientation(0) * stone.spheres[s].centre;
      REQUIRE((to_eigen(bodies.spheres()[s].position) - bodies.position(0) - arm).norm() < 1e-14);
      // As in any leapfrog, their velocity is that of the way they came: chord for arc.
      const Vector way = to_eigen(bodies.spheres()[s].position - members[s].position);
      const double turn = bodies.angular_velocity(0).norm() * sim.time_step();
      REQUIRE((to_eigen(bodies.spheres()[s].velocity) - way / sim.time_step()).norm() <
              turn * turn * turn / 6.0 * arm.norm() / sim.time_step() + 1e-11);
    }
  }
  CHECK(turned > 3.0);
}
