#pragma once
/// \file
/// Density of solid rock: a batch is weighed and immersed in water.

#include "scree/core/random.hpp"
#include "scree/laboratory/rock_sample.hpp"

#include <cstddef>
#include <cstdint>

namespace scree {

struct ImmersionSetup {
  RockSample sample = paper_rock();
  std::uint64_t grains = 2000; ///< of the batch, 1 or more; ours
  std::uint64_t seed = 1;
};

struct ImmersionResult {
  double mass = 0.0;          ///< kg, by the mass convention of the clumps
  double volume = 0.0;        ///< m3, that the clumps displace: what their spheres cover together
  double solid_density = 0.0; ///< kg/m3, mass over volume
};

/// Draws a batch and weighs it in air and in water (as ASTM C127 does with coarse aggregate). Needs no
/// simulation. Where a clump's mass is that of the union of its spheres, what comes out is the density of the
/// particles; where it is the sum of the spheres, it is above that by what their overlaps count twice.
/// \throws Error for a batch of no grains.
inline ImmersionResult immerse(const ImmersionSetup& setup) {
  require("immersion grains", static_cast<double>(setup.grains), {1.0, 1e8});
  Random random{setup.seed, "immersion"};
  const auto clumps = setup.sample.assembly.clumps();
  ImmersionResult out;
  for (const DrawnClump& grain : setup.sample.assembly.draw(setup.grains, random)) {
    const double cube = grain.scale * grain.scale * grain.scale;
    out.mass += setup.sample.rock.density * clumps[grain.shape].volume * cube;
    out.volume += clumps[grain.shape].union_volume * cube;
  }
  out.solid_density = out.mass / out.volume;
  return out;
}

} // namespace scree
