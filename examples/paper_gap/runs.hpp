#pragma once
/// \file
/// One drag of the paper's gap, and what is kept of it.

#include "design.hpp"
#include "laboratory/dragline.hpp"
#include "support/options.hpp"
#include "support/rock_options.hpp"

#include "scree/laboratory/bucket_path.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace paper_gap {

/// How the bucket moves: by itself, or along one of four paths made of the few pitches that the paper states.
/// What it states neither is the pitch after a third of the way, which goes to its end here or stays, nor any
/// depth, which is that of a bucket that rides on its heel (`digging_path`), or the one that a free bucket of
/// the same bed had.
enum class Motion { free, measured, measured_stays, simulated, measured_sinks };
inline constexpr std::array motions{Motion::free, Motion::measured, Motion::measured_stays, Motion::simulated,
                                    Motion::measured_sinks};
const char* name(Motion motion);

/// Places as shares of the drag distance, so that a run of another distance is looked at alike.
struct PathWords {
  double up = 2.9;          ///< degrees, "almost 3"
  double up_at = 0.08;      ///< ours
  double measured = -6.5;   ///< degrees, at `down_at`
  double simulated = -10.0; ///< degrees, likewise
  double down_at = 0.3;     ///< one bucket length in a metre
  double end = 0.0;         ///< degrees, at the end, where the pitch does not stay; ours
  double heel = 0.08;       ///< m, of the flat floor's rear end in the bucket's frame; ours
  double lip = 0.30;        ///< m, of its front end
};

/// All that every run shares.
struct Base {
  scree::examples::RockOptions rock;
  scree::Material rig;
  scree::examples::Dragline dragline;
  PathWords path{};
  double friction_low = 0.2, friction_high = 0.53; ///< of bucket and trough
  double damping = 0.7;                            ///< where it is on
  double dense_friction = 0.1;                     ///< times the rock's, while a dense bed is poured
  double interval = 0.01;                          ///< s, between two lines of the record
  double limit = 60.0;                             ///< s, simulated, beyond which a run counts as failed

  explicit Base(bool desk);
  void bind(scree::examples::Options& options);
};

/// One run.
struct Case {
  Levels levels;
  Motion motion = Motion::free; ///< in place of that of the levels where these are free
  std::uint64_t seed = 1;
  std::vector<double> free_depth{}; ///< m, over pieces of the way; where the motion asks for it
};

/// The path of a motion that is not free.
/// \throws Error for words that make no path.
scree::BucketPath path_of(const Base& base, const Case& of);

/// Number of equal pieces of the way over which curves are means.
inline constexpr std::size_t pieces = 20;

/// What is kept of a run; curves are means over pieces of the way.
struct Outcome {
  std::vector<double> force, pitch, depth, mass, lift; ///< N, degrees, m, kg, N
  double porosity, bulk_density, grains;

  [[nodiscard]] std::vector<double> values() const;
  static Outcome from(const std::vector<double>& values);

  /// About a third of the way, and over its last tenth.
  [[nodiscard]] static double near(const std::vector<double>& curve) { return 0.5 * (curve[5] + curve[6]); }
  [[nodiscard]] static double end(const std::vector<double>& curve) {
    return 0.5 * (curve[pieces - 2] + curve[pieces - 1]);
  }
};

/// \param dense_density of the particles of a dense bed over those of a loose one
/// \throws Error where the run fails.
Outcome dragged(const Base& base, Case of, double dense_density);

/// kg/m3, of a bed alone. \throws Error where it cannot be made.
double bulk_density(const Base& base, bool dense, std::uint64_t seed);

/// The depth at a place that a bucket would have by `digging_path` with the pitch that a run had.
double depth_by_pitch(const Base& base, const Outcome& run, double share);

} // namespace paper_gap
