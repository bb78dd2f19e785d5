/// \file
/// A block of known friction on a rope.

#include "scree/simulation/run.hpp"
#include "scree/simulation/simulation.hpp"
#include "support/meshes.hpp"
#include "support/relative_error.hpp"
#include "support/scenes.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

using namespace scree;

TEST_CASE("physics: a block dragged over a level layer of spheres needs mu m g") {
  // Walls do not touch walls, so the plane is a plate of closely set spheres: one clump, too heavy to be
  // moved and too rough for the floor to let it slide.
  constexpr double radius = 0.01, g = 9.81, mu = 0.37, block_mass = 4.0, speed = 0.1;
  std::vector<Sphere> layer;
  for (int i = 0; i < 24; ++i) {
    for (int j = 0; j < 9; ++j) {
      layer.push_back({{2.0 * radius * i, 2.0 * radius * (j - 4), 0.0}, radius});
    }
  }
  const Clump plate = make_clump("plate", layer, MassConvention::sum_of_spheres);
  Simulation<> sim{{.time_step = 2e-5, .local_damping = 0.1}};
  const auto stone = sim.add_material({.name = "stone",
                                       .density = 5e4,
                                       .normal_stiffness = 2e6,
                                       .shear_stiffness = 2e6,
                                       .friction = 5.0,
                                       .restitution = 0.8});
  const auto steel = sim.add_material({.name = "steel",
                                       .normal_stiffness = 2e5,
                                       .shear_stiffness = 2e5,
                                       .friction = 1.0,
                                       .restitution = 0.8});
  sim.set_pair(stone, steel, {.friction = mu, .restitution = 0.8, .rolling_friction = {}});
  sim.add_wall({.name = "floor", .surfaces = {{Plane{}, stone}}, .dynamics = Fixed{}});
  const double length = 2.0 * radius * 23;
  // Principal axes in ascending moments: the plate's long side is its x.
  sim.add({.clump = &plate, .material = stone, .position = {0.5 * length, 0, radius}});

  const Vector sizes{0.14, 0.1, 0.06};
  const MassProperties body{block_mass, Vector::Zero(),
                            Vector{block_mass / 12.0 * (0.1 * 0.1 + 0.06 * 0.06),
                                   block_mass / 12.0 * (0.14 * 0.14 + 0.06 * 0.06),
                                   block_mass / 12.0 * (0.14 * 0.14 + 0.1 * 0.1)}
                                .asDiagonal()};
  const double height = 2.0 * radius + 0.5 * sizes.z();
  // Pulled level, low enough that it does not tip.
  Rope rope{.name = "drag",
            .hitch = {0.07, 0, -0.02},
            .winch = {2.07, 0, height - 0.02},
            .stiffness = 5e3,
            .damping = 100.0};
  rope.wound = [](double t) { return t < 0.2 ? 0.5 * speed * t * t / 0.2 : speed * (t - 0.1); };
  const auto block = sim.add_wall({.name = "block",
                                   .surfaces = {{test::box_mesh(sizes), steel}},
                                   .dynamics = RopeCoupled{body, {rope}},
                                   .motion = {.position = {0.1, 0, height}}});
  run_for(sim, 0.8);
  const Vector plate_at = sim.bodies().position(0), block_at = sim.wall(block).motion.position;
  const double from = sim.time();
  double impulse = -sim.dynamics<RopeCoupled>(block).ropes()[0].impulse.x(), weight = 0.0;
  std::size_t steps = 0;
  while (sim.time() < from + 1.0) {
    sim.step();
    weight += sim.wall(block).load.force.z();
    ++steps;
  }
  impulse += sim.dynamics<RopeCoupled>(block).ropes()[0].impulse.x();
  const double mean = impulse / (sim.time() - from);
  CHECK(sim.wall(block).motion.position.x() - block_at.x() == test::about(speed, 0.01));
  CHECK(weight / static_cast<double>(steps) == test::about(block_mass * g, 0.001));
  CHECK(mean == test::about(mu * block_mass * g, 0.01));
  CHECK((sim.bodies().position(0) - plate_at).norm() < 1e-5);
  // It lies flat and goes straight.
  CHECK(std::abs(sim.wall(block).motion.position.y()) < 1e-3);
  CHECK(Eigen::AngleAxisd{sim.wall(block).motion.orientation}.angle() < 0.01);
  // What the winch put in was lost to friction, nearly all.
  CHECK(sim.dissipation().friction > 0.9 * sim.dynamics<RopeCoupled>(block).ropes()[0].winch_work);
}
