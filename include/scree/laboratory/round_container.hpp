#pragma once
/// \file
/// A round container, filled by pouring and struck off level.

#include "scree/laboratory/come_to_rest.hpp"
#include "scree/laboratory/rock_sample.hpp"
#include "scree/laboratory/stage.hpp"
#include "scree/packing/loose_pile.hpp"
#include "scree/walls/wall.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

namespace scree {

/// An upright tube around the z axis on a floor at z = 0. Its mantle reaches beyond its height, as a collar
/// that keeps what is poured above the brim together.
struct RoundContainer {
  double radius = 0.2;  ///< m, above 0; the paper's oedometer
  double height = 0.25; ///< m, above 0

  /// m3, up to the brim.
  [[nodiscard]] double volume() const { return area() * height; }
  /// m2.
  [[nodiscard]] double area() const { return std::numbers::pi * radius * radius; }

  [[nodiscard]] std::vector<WallSurface> mantle(MaterialId material) const {
    return {{Cylinder{.radius = radius}, material}};
  }
  [[nodiscard]] static std::vector<WallSurface> floor(MaterialId material) { return {{Plane{}, material}}; }

  /// m, that holds the centres of all grains in it and of those that fall into it (SaneBounds::domain).
  [[nodiscard]] Eigen::AlignedBox3d domain() const {
    return {Vector{-radius, -radius, 0.0}, Vector{radius, radius, std::numeric_limits<double>::infinity()}};
  }

  /// \throws Error for a dimension that is not above 0.
  void check() const {
    require_positive("container radius", radius, "m");
    require_positive("container height", height, "m");
  }
};

/// How a container is filled. All numbers are ours.
struct FillRecipe {
  double surplus = 0.25;           ///< of the volume, poured above the brim and struck off, above 0
  double expected_porosity = 0.45; ///< for how much to pour, 0.05 to 0.95
  double settling_damping = 0.3;   ///< local, while the grains come to rest, 0 to 0.99
  /// Times its own, the friction of the rock until it is struck off, above 0: less than 1 packs it denser, as
  /// tamping does, more than 1 looser.
  double packing_friction = 1.0;
  RestCriterion rest{.moving = 0.01}; ///< of the grains when the container is full

  /// \throws Error for a value out of its range.
  void check() const {
    require_positive("fill surplus", surplus);
    require("fill expected porosity", expected_porosity, {0.05, 0.95});
    require("fill settling damping", settling_damping, {0.0, 0.99});
    require("fill packing friction", packing_friction, {1e-3, 1e3});
    rest.check();
  }
};

/// What came of it.
struct FillReport {
  std::size_t poured = 0, kept = 0;
  double mass = 0.0;               ///< kg, of the grains kept
  double bulk_density = 0.0;       ///< kg/m3, of these over the volume
  Unrest unrest{};                 ///< at the end
  std::vector<DrawnClump> drawn{}; ///< what was poured
};

/// Pours grains into the container, whose walls are in the simulation, lets them come to rest, takes away
/// those whose centres are above the brim and lets the others rest again. `watch(simulation, Stage)` is
/// called after every step; its share runs from 0 to 1.
/// \throws Error for a parameter out of its range, where less was poured than the container holds, or where
/// the grains do not come to rest.
template <class Simulation, class Watch>
FillReport fill_container(Simulation& simulation, const RoundContainer& container, const Assembly& assembly,
                          MaterialId rock, const FillRecipe& recipe, Random& random, Watch watch) {
  container.check();
  recipe.check();
  FillReport report;
  const double solid = container.volume() * (1.0 - recipe.expected_porosity) * (1.0 + recipe.surplus);
  report.drawn = assembly.draw_volume(solid, random);
  Packing pile = loose_pile(assembly.clumps(), report.drawn, RoundFootprint{container.radius, 0.0}, random);
  double top = 0.0;
  for (PackedBody& body : pile.bodies) {
    body.material = rock;
    top = std::max(top, body.position.z());
  }
  simulation.add(pile);
  report.poured = pile.bodies.size();

  require_positive("fill gravity", simulation.setup().gravity.norm(), "m/s2");
  const double fall = std::sqrt(2.0 * top / simulation.setup().gravity.norm()), start = simulation.time();
  Stage stage{"filling", 0.0};
  auto observe = [&](auto& s) {
    stage.share = std::min(0.9, 0.3 * (s.time() - start) / fall);
    watch(s, std::as_const(stage));
  };
  RestCriterion poured = recipe.rest;
  poured.moving = 1.0; // what still rolls over the surface is struck off
  require_rest("fill",
               settle_with_friction(simulation, rock, recipe.packing_friction, recipe.settling_damping,
                                    poured, fall, observe),
               poured);

  const double brim = container.height;
  double above = 0.0; // m3 of solid
  simulation.remove_bodies([&](const auto& bodies, std::size_t b) {
    const bool over = bodies.position(b).z() > brim;
    above += over ? bodies.solid_volume(b) : 0.0;
    return over;
  });
  // Less than half a grain over the whole area leaves hollows below the brim.
  const double size = assembly.mean_diameter();
  if (above < 0.5 * size * container.area() * (1.0 - recipe.expected_porosity)) {
    throw Error(
        message("fill: what was poured stands ", above / container.area(), " m of solid above the brim at ",
                brim, " m, which grains of ", size, " m leave uneven: surplus = ", recipe.surplus,
                " over expected_porosity = ", recipe.expected_porosity, " is too little for this material"));
  }
  report.unrest = settle(simulation, recipe.settling_damping, recipe.rest, 0.02, observe);
  require_rest("fill", report.unrest, recipe.rest);
  report.kept = simulation.bodies().size();
  for (std::size_t b = 0; b < report.kept; ++b) {
    report.mass += simulation.bodies().mass(b);
  }
  report.bulk_density = report.mass / container.volume();
  return report;
}

} // namespace scree
