#pragma once
/// \file
/// Fills a trough with rock at rest.

#include "scree/laboratory/bed_making.hpp"

namespace scree {

/// Makes a bed from beginning to end (`BedMaking`). `watch(simulation, Stage)` is called after every step.
/// \throws Error as BedMaking does.
template <class Simulation, class Watch>
BedReport settle_bed(Simulation& simulation, const BedContainer& bed, const Assembly& assembly,
                     MaterialId rock, const BedRecipe& recipe, Random& random, Watch watch) {
  BedMaking making{bed, rock, recipe};
  making.pour(simulation, assembly, random);
  while (making.step(simulation)) {
    watch(simulation, making.stage());
  }
  return making.report();
}

} // namespace scree
