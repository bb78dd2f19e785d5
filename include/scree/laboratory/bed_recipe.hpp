#pragma once
/// \file
/// How a bed of rock is made, and what came of it.

#include "scree/core/error.hpp"
#include "scree/laboratory/come_to_rest.hpp"
#include "scree/packing/assembly.hpp"

#include <cstddef>
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

  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {
    archive(self.porosity, self.poured_porosity, self.unbalanced, self.moving, self.at_rest,
            self.bulk_density, self.poured, self.kept, self.drawn, self.duration);
  }
};

} // namespace scree
