#pragma once
/// \file
/// Oedometer tests on Karlsruhe fine sand (Wichtmann & Triantafyllidis, Acta Geotech. 2016): loaded,
/// unloaded, loaded again.

#include "scree/compare/stiffness.hpp"

#include <filesystem>

namespace sand {

struct SandTest {
  int number = 0;
  double void_ratio = 0.0; ///< at first
  double highest = 0.0;    ///< Pa, stress at which it was unloaded
  scree::StressStrain loading{}, unloading{}, reloading{};
};

/// Reads `folder`/OE/OE`number`.dat: a head, then stress [kPa], strain [%] and void ratio in each line. Of
/// one strain in OE4 the sign is wrong at the source; where there is no stress, strains count without their
/// sign.
/// \throws Error with file and line for what cannot be read, or a test that is not loaded, unloaded and loaded.
SandTest read_sand_test(const std::filesystem::path& folder, int number);

} // namespace sand
