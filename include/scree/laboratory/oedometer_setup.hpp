#pragma once
/// \file
/// What confined compression is given, and what it measures.

#include "scree/laboratory/oedometer_cycle.hpp"
#include "scree/laboratory/round_container.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace scree {

/// Confined compression (Coetzee et al. 2010, section 4.4): the container is the paper's, all else is ours.
struct OedometerSetup {
  RockSample sample = paper_rock();
  RoundContainer container{}; ///< 400 mm across, 250 mm high [paper]
  FillRecipe fill{};
  double low_stress = 1e4;            ///< Pa, on the lid where a branch of unloading ends, above 0
  double high_stress = 1e5;           ///< Pa, where one of loading ends, above low_stress
  std::uint64_t cycles = 4;           ///< loadings, each but the last followed by an unloading too, 1 or more
  double strain_rate = 0.01;          ///< 1/s, of the lid's speed over the container's height, above 0
  double most_inertial_number = 1e-3; ///< of the loading, below which it counts as quasi-static; above 0
  double approach = 5.0;              ///< times as fast does the lid come down on the grains, 1 or above
  double approach_to = 0.5;           ///< share of the low stress up to which it does, 1e-6 to 1
  /// Whether the grains still have the friction that they were poured with when the lid comes down on them,
  /// up to the low load. Where that is small, they give way until many of them bear the lid, as in a specimen
  /// whose surface was levelled; else a few do, and how these are seated is most of what is measured.
  bool seated = false;
  double slope_from = 0.3;    ///< share of the way from low to high load at which the slope begins
  double slope_to = 0.9;      ///< and at which it ends
  std::uint64_t points = 200; ///< of the curve, about, in each branch, 10 or more
  std::uint64_t seed = 1;
  unsigned threads = 0; ///< 0: one for each processor

  /// \throws Error for a value out of its range.
  void check() const {
    container.check();
    fill.check();
    require_positive("oedometer low_stress", low_stress, "Pa");
    require_positive("oedometer high_stress", high_stress, "Pa");
    if (!(high_stress > low_stress)) {
      throw Error(message("oedometer high_stress = ", high_stress,
                          " Pa must be above low_stress = ", low_stress, " Pa"));
    }
    require("oedometer cycles", static_cast<double>(cycles), {1.0, 1000.0});
    require_positive("oedometer strain_rate", strain_rate, "1/s");
    require_positive("oedometer most_inertial_number", most_inertial_number);
    require("oedometer approach", approach, {1.0, 1000.0});
    require("oedometer approach_to", approach_to, {1e-6, 1.0});
    require("oedometer slope_from", slope_from, {0.0, 1.0});
    require("oedometer slope_to", slope_to, {0.0, 1.0});
    if (!(slope_to > slope_from)) {
      throw Error(message("oedometer slope_to = ", slope_to, " must be above slope_from = ", slope_from));
    }
    require("oedometer points", static_cast<double>(points), {10.0, 1e6});
  }
};

/// The desk version: fewer, larger and softer grains under less load, moved faster, as wide as the paper's.
/// All else is ours: below some 5 kPa the few grains of one filling rearrange in ways of their own, and the
/// modulus of the third loading scatters by 15 % from seed to seed; here it is 4 %.
inline OedometerSetup desk_oedometer() {
  return {.sample = desk_rock(),
          .container = {.radius = 0.2, .height = 0.15},
          .low_stress = 8e3,
          .high_stress = 4e4,
          .cycles = 3,
          .strain_rate = 0.06,
          .approach_to = 0.1};
}

struct OedometerResult {
  double slope = 0.0;           ///< N/m, of the last loading
  double modulus = 0.0;         ///< Pa, of the last loading
  double height = 0.0;          ///< m, of the lid above the floor when it carried the low load first
  double inertial_number = 0.0; ///< strain rate times d sqrt(rho / p), with the low stress and mean diameter
  std::vector<OedometerCycle> cycles{};
  std::vector<OedometerPoint> curve{};
  FillReport fill{};
};

} // namespace scree
