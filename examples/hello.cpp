/// \brief A first simulation, line by line: 200 grains fall into a box and come to rest
/// \smoke

// A recipe for packings lays the grains out, the simulation moves them, and a driver says for how long.
#include "scree/packing/loose_lattice.hpp"
#include "scree/simulation/run.hpp"
#include "scree/simulation/simulation.hpp"

#include <cmath>
#include <cstdio>
#include <vector>

int main() {
  // Everything is in SI units: metres, kilograms, seconds, newtons. `Simulation<>` takes the physics of
  // `DefaultModel` (linear springs with friction, see simulation/model.hpp). Its setup has a default for
  // every value; here only gravity is spelled out. No time step is given, so scree takes one that is stable.
  scree::Simulation<> simulation{{.gravity = {0.0, 0.0, -9.81}}};

  // What the grains and the box are made of. A stiffness far below that of rock lets the time step be longer;
  // it is stiff enough if grains at rest overlap by less than about a hundredth of their radius.
  // `restitution` is the share of the speed that is left after an impact.
  const auto rock = simulation.add_material({.name = "rock",
                                             .density = 2650.0,         // kg/m3
                                             .normal_stiffness = 5.0e4, // N/m
                                             .shear_stiffness = 5.0e4,  // N/m
                                             .friction = 0.5,
                                             .restitution = 0.3});

  // A grain is a clump: spheres that move as one rigid body. Mass and inertia are those of the solid that the
  // two spheres fill together; the places and radii are in metres.
  const std::vector<scree::Sphere> lobes{{{0.0, 0.0, 0.0}, 0.010}, {{0.008, 0.0, 0.0}, 0.008}};
  const scree::Clump grain = scree::make_clump("grain", lobes);

  // 200 of them, the shape with number 0 at its own size, set apart from each other above the floor of a box.
  // Place and orientation are random, and the same in every run: a random stream is known by its seed.
  const Eigen::AlignedBox3d box{scree::Vector{0.0, 0.0, 0.0}, scree::Vector{0.15, 0.15, 0.5}}; // m
  const std::vector<scree::DrawnClump> drawn(200, {.shape = 0, .scale = 1.0});
  scree::Random random{1};
  simulation.add(scree::loose_lattice({grain}, drawn, box, random)); // their material is number 0, the rock

  // A wall body has a name, surfaces that move together, and a dynamics that says how: these stay `Fixed`.
  // A plane is solid on the side away from its normal. The floor is a body of its own, so that it can be
  // asked what it carries.
  const auto floor = simulation.add_wall(
      {.name = "floor", .surfaces = {{scree::Plane{}, rock}}, .dynamics = scree::Fixed{}});
  const auto sides =
      simulation.add_wall({.name = "sides",
                           .surfaces = {{scree::Plane{box.min(), scree::Vector::UnitX()}, rock},
                                        {scree::Plane{box.min(), scree::Vector::UnitY()}, rock},
                                        {scree::Plane{box.max(), -scree::Vector::UnitX()}, rock},
                                        {scree::Plane{box.max(), -scree::Vector::UnitY()}, rock}},
                           .dynamics = scree::Fixed{}});

  // An observer is anything that can be called with the simulation. It only looks: with or without it the
  // grains move the same way.
  const auto report = [](const auto& s) {
    const auto& grains = s.bodies();
    double height = 0.0, energy = 0.0;
    for (std::size_t g = 0; g < grains.size(); ++g) {
      height += grains.position(g).z() / static_cast<double>(grains.size());
      energy += grains.kinetic_energy(g);
    }
    std::printf("%4.2f s: mean height %5.1f mm, kinetic energy %8.6f J\n", s.time(), 1e3 * height, energy);
  };

  // A driver steps through one second, and has the observer called every tenth of simulated time.
  scree::run_for(simulation, 1.0, scree::Every{0.1, report});

  // The grains push down on the floor, and rub down the sides, which carry the rest of the weight.
  const double on_floor = -simulation.wall(floor).load.force.z();
  const double on_sides = -simulation.wall(sides).load.force.z();
  double weight = 0.0;
  for (std::size_t g = 0; g < simulation.bodies().size(); ++g) {
    weight += simulation.bodies().mass(g) * 9.81;
  }
  std::printf("floor %.2f N + sides %.2f N = %.2f N, weight %.2f N\n", on_floor, on_sides,
              on_floor + on_sides, weight);
  std::printf("%zu steps of %.1f us\n", simulation.steps(), 1e6 * simulation.time_step());

  // Every example tells by its result whether it found what it should: 0 for yes.
  return std::abs((on_floor + on_sides) / weight - 1.0) < 0.01 ? 0 : 1;
}
