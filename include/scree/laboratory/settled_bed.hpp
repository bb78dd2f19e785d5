#pragma once
/// \file
/// The recipe that fills a trough with rock at rest.

#include "scree/laboratory/bed_container.hpp"
#include "scree/laboratory/come_to_rest.hpp"
#include "scree/laboratory/stage.hpp"
#include "scree/measure/porosity.hpp"
#include "scree/packing/assembly.hpp"
#include "scree/packing/loose_pile.hpp"
#include "scree/simulation/run.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace scree {

/// How a bed is made. All numbers are ours, not in the paper.
struct BedRecipe {
  double porosity = 0.0;             ///< to reach, in (0, 1); 0: as it comes to rest under its own friction
  double porosity_tolerance = 0.005; ///< absolute
  double surplus = 0.12;             ///< of the volume, poured and struck off at the brim, above 0
  double expected_porosity = 0.42;   ///< for how much to pour, where none is requested, 0.05 to 0.95
  double settling_damping = 0.3;     ///< local, while the grains come to rest, 0 to 0.99
  /// Times its own, the friction of the rock while it is poured, above 0, as FillRecipe::packing_friction.
  double packing_friction = 1.0;
  RestCriterion rest{}; ///< of the bed; its patience is that of each stage

  /// \throws Error for a value out of its range.
  void check() const {
    if (porosity != 0.0) {
      require("bed porosity", porosity, {0.05, 0.95});
    }
    require_positive("bed porosity_tolerance", porosity_tolerance);
    require_positive("bed surplus", surplus);
    require("bed expected_porosity", expected_porosity, {0.05, 0.95});
    require("bed settling_damping", settling_damping, {0.0, 0.99});
    require("bed packing_friction", packing_friction, {1e-3, 1e3});
    rest.check();
  }
};

/// What came of it.
struct BedReport {
  double porosity = 0.0;        ///< of the core, away from walls and surface
  double poured_porosity = 0.0; ///< before it was made denser
  double unbalanced = 0.0;      ///< mean unbalanced over mean contact force
  double moving = 0.0;          ///< share of the grains that are faster than the recipe's speed of rest
  bool at_rest = false;         ///< whether both are within the recipe, or the patience was over first
  double bulk_density = 0.0;    ///< kg/m3, of all grains below the brim over the volume of the trough
  std::size_t poured = 0, kept = 0;
  std::vector<DrawnClump> drawn{}; ///< what was poured, for its histogram
  double duration = 0.0;           ///< s, simulated
};

namespace detail {

/// The bed without a margin of two grains along walls, floor and surface, at its deepest third.
inline Eigen::AlignedBox3d bed_core(const BedContainer& bed, double grain) {
  double from = 0.0, to = bed.length;
  if (bed.floor.size() > 3) {
    from = bed.floor[1].x;
    to = bed.floor[bed.floor.size() - 2].x;
  }
  const double margin = std::min({2.0 * grain, 0.25 * (to - from), 0.25 * bed.width, 0.3 * bed.deepest()});
  return {Vector{from + margin, -0.5 * bed.width + margin, -bed.deepest() + margin},
          Vector{to - margin, 0.5 * bed.width - margin, -margin}};
}

/// A loose pile above the trough, as high over each place as the trough is deep there.
inline Packing poured(const BedContainer& bed, const Assembly& assembly, MaterialId rock,
                      const BedRecipe& recipe, Random& random) {
  const double expected = recipe.porosity > 0.0 ? recipe.porosity : recipe.expected_porosity;
  const double box = bed.length * bed.width * bed.deepest();
  const auto drawn = assembly.draw_volume(box * (1.0 - expected) * (1.0 + recipe.surplus), random);
  const Eigen::AlignedBox3d footprint{Vector{0.0, -0.5 * bed.width, -bed.shallowest()},
                                      Vector{bed.length, 0.5 * bed.width, 0.0}};
  Packing pile = loose_pile(assembly.clumps(), drawn, footprint, random);
  const double base = footprint.min().z();
  double top = base;
  for (const PackedBody& body : pile.bodies) {
    top = std::max(top, body.position.z());
  }
  std::erase_if(pile.bodies, [&](const PackedBody& body) {
    return body.position.z() - base > (top - base) * bed.depth_at(body.position.x()) / bed.deepest();
  });
  for (PackedBody& body : pile.bodies) {
    body.material = rock;
  }
  return pile;
}

} // namespace detail

/// Shakes the bed without friction until `measured()` reaches the porosity `target` or the patience is over,
/// and stops all grains there, as in motion they would pack on while friction takes hold. Returns whether the
/// target was reached.
/// \param target not below that of the recipe
/// \throws Error where what it came to is beyond the recipe's tolerance of the porosity requested.
template <class Simulation, class Measured, class Watch>
bool densify(Simulation& simulation, MaterialId rock, const BedRecipe& recipe, double target,
             const Measured& measured, Watch& watch) {
  const Material material = simulation.materials().at(rock);
  const Vector gravity = simulation.setup().gravity;
  Material slippery = material;
  slippery.friction = 0.0;
  slippery.rolling_friction = 0.0;
  double porosity = measured();
  const double loosest = porosity;
  double densest = porosity;
  simulation.change_material(rock, slippery);
  // A tenth of gravity at 20 Hz: enough to unlock, too little to throw.
  const double start = simulation.time();
  double checked = start;
  run_while(
      simulation,
      [&](const auto& s) {
        const double t = s.time() - start;
        simulation.set_gravity(gravity * (1.0 + 0.1 * std::sin(2.0 * std::numbers::pi * 20.0 * t)));
        if (s.time() - checked >= 0.001) {
          checked = s.time();
          porosity = measured();
          densest = std::min(densest, porosity);
        }
        return porosity > target && t < recipe.rest.patience;
      },
      watch);
  simulation.set_gravity(gravity);
  simulation.change_material(rock, material);
  stop_all(simulation);
  if (porosity > target && porosity > recipe.porosity + recipe.porosity_tolerance) {
    throw Error(message("bed porosity = ", recipe.porosity, " is denser than this material packs: it allows ",
                        densest, " to ", loosest));
  }
  return porosity <= target;
}

/// Pours grains of `assembly` into `bed`, lets them come to rest, makes them denser where a porosity is
/// requested, strikes them off at the brim and lets them rest again. The walls of the bed must be in the
/// simulation. The bed stays in the simulation with the history of its contacts. `watch(simulation,
/// Stage)` is called after every step.
///
/// Denser: the friction between grains is taken away while the bed is shaken gently and given back, once or
/// more, until the porosity is reached. So a requested porosity lies between what gentle pouring leaves and
/// what shaking without friction reaches.
/// \throws Error for a porosity that this material does not reach, with the range that it does.
template <class Simulation, class Watch>
BedReport settle_bed(Simulation& simulation, const BedContainer& bed, const Assembly& assembly,
                     MaterialId rock, const BedRecipe& recipe, Random& random, Watch watch) {
  recipe.check();
  const double gravity = simulation.setup().gravity.norm();
  require_positive("bed gravity", gravity, "m/s2");
  const double start = simulation.time();
  BedReport report;

  const double depth = bed.deepest();
  const Packing pile = detail::poured(bed, assembly, rock, recipe, random);
  double grain = 0.0;
  for (const PackedBody& body : pile.bodies) {
    report.drawn.push_back({body.shape, body.scale});
    grain +=
        2.0 * pile.shapes[body.shape].bounding_radius * body.scale / static_cast<double>(pile.bodies.size());
  }
  simulation.add(pile);
  report.poured = pile.bodies.size();

  const double damping = simulation.setup().local_damping;
  simulation.set_local_damping(recipe.settling_damping);
  const double fall = std::sqrt(2.0 * 2.0 * depth / gravity);
  Stage stage{"settling", 0.0};
  const auto observe = [&](auto& s) { watch(s, stage); };
  // What still rolls over the surface is struck off or shaken anyway.
  RestCriterion inside = recipe.rest;
  inside.moving = 1.0;
  settle_with_friction(simulation, rock, recipe.packing_friction, recipe.settling_damping, inside, fall,
                       observe);

  const Eigen::AlignedBox3d core = detail::bed_core(bed, grain);
  const auto measured = [&] { return porosity(simulation.bodies(), core); };
  report.poured_porosity = report.porosity = measured();
  if (recipe.porosity > 0.0) {
    if (report.porosity < recipe.porosity - recipe.porosity_tolerance) {
      throw Error(message("bed porosity = ", recipe.porosity,
                          " is looser than this material settles: poured gently it "
                          "comes to rest at ",
                          report.porosity, " (friction ", simulation.materials().at(rock).friction, ")"));
    }
    stage = {"densifying", 0.6};
    bool denser = true;
    while (denser && report.porosity > recipe.porosity + 0.5 * recipe.porosity_tolerance) {
      // Grains pack on while friction takes hold again: the last third of the way is left to them.
      const double target = recipe.porosity + (report.porosity - recipe.porosity) / 3.0;
      denser = densify(simulation, rock, recipe, target, measured, observe);
      come_to_rest(simulation, inside, 0.02, observe);
      const double now = measured();
      denser = denser && now < report.porosity;
      report.porosity = now;
    }
  }

  stage = {"striking off", 0.8};
  if (simulation.remove_bodies(
          [](const auto& bodies, std::size_t b) { return bodies.position(b).z() > 0.0; }) == 0) {
    throw Error(message("bed: what was poured does not reach the brim: surplus = ", recipe.surplus,
                        " is too little for this material"));
  }
  const Unrest left = come_to_rest(simulation, recipe.rest, 0.05, observe);
  report.unbalanced = left.unbalanced;
  report.moving = left.moving;
  report.at_rest = left.within(recipe.rest);
  simulation.set_local_damping(damping);
  report.porosity = measured();
  if (recipe.porosity > 0.0 && std::abs(report.porosity - recipe.porosity) > recipe.porosity_tolerance) {
    throw Error(message("bed porosity = ", recipe.porosity, " was not reached to ", recipe.porosity_tolerance,
                        ": struck off and at rest the bed has ", report.porosity));
  }
  report.kept = simulation.bodies().size();
  double mass = 0.0;
  for (std::size_t b = 0; b < simulation.bodies().size(); ++b) {
    mass += simulation.bodies().mass(b);
  }
  report.bulk_density = mass / bed.volume();
  report.duration = simulation.time() - start;
  return report;
}

} // namespace scree
