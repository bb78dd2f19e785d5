#pragma once
/// \file
/// Density of solid rock: a batch is weighed and immersed in water.

#include "scree/core/random.hpp"
#include "scree/laboratory/rock_sample.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace scree {

struct ImmersionSetup {
  RockSample sample = paper_rock();
  std::uint64_t grains = 20'000; ///< of the batch, 1 to 10^8; ours
  std::uint64_t seed = 1;
};

/// The desk version: fewer of larger grains. All ours.
inline ImmersionSetup desk_immersion() {
  return {.sample = desk_rock(), .grains = 2000};
}

/// After one more grain was put in.
struct ImmersedBatch {
  double mass = 0.0;   ///< kg, by the mass convention of the clumps
  double volume = 0.0; ///< m3, that the clumps displace: what their spheres cover together
};

struct ImmersionResult {
  double solid_density = 0.0;           ///< kg/m3, mass over volume of the whole batch
  std::vector<ImmersedBatch> batches{}; ///< grain after grain
};

/// Draws a batch and weighs it in air and in water (as ASTM C127 does with coarse aggregate). Needs no
/// simulation. Where a clump's mass is that of the union of its spheres, what comes out is the density of the
/// particles; where it is the sum of the spheres, it is above that by what their overlaps count twice.
/// \throws Error for a batch of no grains, or a material out of range.
inline ImmersionResult immerse(const ImmersionSetup& setup) {
  require("immersion grains", static_cast<double>(setup.grains), {1.0, 1e8});
  validate(setup.sample.rock);
  Random random{setup.seed, "immersion"};
  const auto clumps = setup.sample.assembly.clumps();
  ImmersionResult out;
  ImmersedBatch batch;
  for (const DrawnClump& grain : setup.sample.assembly.draw(setup.grains, random)) {
    const double cube = grain.scale * grain.scale * grain.scale;
    batch.mass += setup.sample.rock.density * clumps[grain.shape].volume * cube;
    batch.volume += clumps[grain.shape].union_volume * cube;
    out.batches.push_back(batch);
  }
  out.solid_density = batch.mass / batch.volume;
  return out;
}

} // namespace scree
