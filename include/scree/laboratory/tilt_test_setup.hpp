#pragma once
/// \file
/// What a tilt test is given, and what it measures.

#include "scree/laboratory/bed_recipe.hpp"
#include "scree/laboratory/rock_sample.hpp"

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace scree {

/// What lies on what is tilted.
enum class TiltMethod {
  single, ///< rocks apart from each other on a plate
  layer   ///< a tray full of rock, struck off level
};

inline std::string_view to_string(TiltMethod method) {
  return method == TiltMethod::single ? "single" : "layer";
}

/// A tray without a lid, along the slope. All numbers are ours.
struct Tray {
  double length = 0.6; ///< m, along the slope, above 0
  double width = 0.4;  ///< m, above 0
  double depth = 0.12; ///< m, above 0
  bool rough = true;   ///< whether the grains that touch the floor are held there, as if glued

  /// \throws Error for a dimension that is not above 0.
  void check() const {
    require_positive("tray length", length, "m");
    require_positive("tray width", width, "m");
    require_positive("tray depth", depth, "m");
  }
};

/// All numbers are ours.
struct TiltTestSetup {
  RockSample sample = paper_rock();
  TiltMethod method = TiltMethod::single;
  std::size_t rocks = 100;                                               ///< on the plate, 2 or more
  Tray tray{};                                                           ///< of a layer
  BedRecipe bed{.rest = {.moving = 0.01}};                               ///< how the tray is filled
  RestCriterion rest{.unbalanced = 0.02, .speed = 0.01, .moving = 0.02}; ///< before it is tilted
  double rate = 1.0;                                                     ///< degrees/s, above 0
  double steepest = 60.0;     ///< degrees, where the test ends, above 0 to 90
  double moved = 0.5;         ///< times its size must a rock move, or half of the upper half; above 0
  double onset_speed = 0.001; ///< m/s, up to which a rock, or half of the upper half, has not begun
  double rolled = 20.0;       ///< degrees; a rock that has turned by more did not slide, above 0 to 180
  std::size_t points = 300;   ///< of the curve up to the steepest angle, 10 or more
  std::uint64_t seed = 1;
  unsigned threads = 0; ///< 0: one for each processor

  /// \throws Error for a value out of its range.
  void check() const {
    require("tilt test rocks", static_cast<double>(rocks), {2.0, 1e6});
    tray.check();
    bed.check();
    rest.check();
    require_positive("tilt test rate", rate, "degrees/s");
    require_positive("tilt test steepest", steepest, "degrees");
    require("tilt test steepest", steepest, {0.0, 90.0, "degrees"});
    require_positive("tilt test moved", moved);
    require_positive("tilt test onset_speed", onset_speed, "m/s");
    require_positive("tilt test rolled", rolled, "degrees");
    require("tilt test rolled", rolled, {0.0, 180.0, "degrees"});
    require("tilt test points", static_cast<double>(points), {10.0, 1e6});
  }
};

/// The desk version: fewer, larger and softer grains, tilted faster. All ours.
inline TiltTestSetup desk_tilt_test(TiltMethod method = TiltMethod::single) {
  return {.sample = desk_rock(),
          .method = method,
          .rocks = 50,
          .tray = {.length = 0.4, .width = 0.2, .depth = 0.08},
          .rate = 3.0};
}

/// One rock on the plate.
struct TiltedRock {
  DrawnClump rock{};          ///< which shape of the assembly, how large
  bool sphere = false;        ///< a lone one, which no face holds
  bool moved = false;         ///< as far as the setup asks, before the steepest angle
  bool rolled = false;        ///< whether it turned while it moved; a lone sphere always
  double angle = 0.0;         ///< degrees, at which it began to move; 0 where it did not
  double failure_angle = 0.0; ///< degrees, at which it had moved that far; 0 where it did not
};

/// A row of the curve.
struct TiltPoint {
  double time = 0.0;         ///< s, since the tilting began
  double angle = 0.0;        ///< degrees
  double share = 0.0;        ///< of the rocks, or of the grains of the upper half, that have moved so far
  double displacement = 0.0; ///< m, mean of the rocks, median of the grains
};

struct TiltTestResult {
  double angle = 0.0;         ///< degrees, at which the layer began to move; of rocks the mean
  double failure_angle = 0.0; ///< degrees, at which it had moved as far as the setup asks; of rocks the mean
  bool failed = false;        ///< whether the layer moved that far; of rocks, whether all did

  // Of rocks on a plate. Lone spheres are not among them but for their own count and the list.
  double error = 0.0;      ///< degrees, standard error of the mean angle
  double spread = 0.0;     ///< degrees, standard deviation of the angles
  double median = 0.0;     ///< degrees
  double slid_angle = 0.0; ///< degrees, mean of those that slid
  std::size_t slid = 0, rolled = 0, held = 0;
  std::size_t spheres = 0;
  std::vector<TiltedRock> rocks{}; ///< in the order in which they were drawn

  // Of a layer.
  BedReport bed{};
  double grain_size = 0.0;         ///< m, mean bounding diameter of the upper half
  std::size_t glued = 0, free = 0; ///< grains held to the floor, and the others

  Unrest unrest{}; ///< before tilting
  std::vector<TiltPoint> curve{};
};

} // namespace scree
