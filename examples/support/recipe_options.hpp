#pragma once
/// \file
/// How grains are poured and come to rest, as options, and what came of it.

#include "scree/laboratory/bed_recipe.hpp"
#include "scree/laboratory/round_container.hpp"
#include "support/options.hpp"

#include <string>

namespace scree::examples {

/// \param of what comes to rest: the name of the group
inline void bind_rest(Options& options, const std::string& of, RestCriterion& rest) {
  options.add(of + ".unbalanced", rest.unbalanced, {1e-6, 1.0},
              "mean unbalanced over mean contact force that counts as rest");
  options.add(of + ".speed", rest.speed, {1e-6, 10.0, "m/s"}, "above which a grain moves");
  options.add(of + ".moving", rest.moving, {0.0, 1.0}, "share of the grains that may move at rest");
  options.add(of + ".patience", rest.patience, {1e-3, 1e4, "s"}, "simulated, in which rest must come");
}

inline void bind_fill(Options& options, FillRecipe& fill) {
  options.group("Filling");
  options.add("fill.surplus", fill.surplus, {0.001, 2.0}, "poured above the brim, of the volume");
  options.add("fill.expected_porosity", fill.expected_porosity, {0.05, 0.95}, "for how much to pour");
  options.add("fill.settling_damping", fill.settling_damping, {0.0, 0.99}, "local, while grains settle");
  options.add("fill.packing_friction", fill.packing_friction, {1e-3, 1e3},
              "times its own, the rock's friction while it is poured; below 1 it packs denser");
  bind_rest(options, "fill", fill.rest);
}

inline void bind_bed(Options& options, BedRecipe& bed) {
  options.add("bed.porosity", bed.porosity, {0.0, 0.95}, "to reach; 0: as poured");
  options.add("bed.porosity_tolerance", bed.porosity_tolerance, {1e-5, 0.1}, "of the requested porosity");
  options.add("bed.surplus", bed.surplus, {0.001, 2.0},
              "poured beyond the brim and struck off, of the volume");
  options.add("bed.expected_porosity", bed.expected_porosity, {0.05, 0.95}, "for how much to pour");
  options.add("bed.settling_damping", bed.settling_damping, {0.0, 0.99}, "local, while the bed is made");
  options.add("bed.packing_friction", bed.packing_friction, {1e-3, 1e3},
              "times its own, the rock's friction while it is poured; below 1 it packs denser");
  bind_rest(options, "bed", bed.rest);
}

/// Adds how the filling lies to a summary.
template <class Json>
void summarise_fill(Json& summary, const FillReport& fill) {
  summary["fill"] = {{"poured_grains", fill.poured},
                     {"kept_grains", fill.kept},
                     {"unbalanced", fill.unrest.unbalanced},
                     {"moving", fill.unrest.moving}};
}

} // namespace scree::examples
