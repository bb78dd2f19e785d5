#pragma once
/// \file
/// What the runs say of the paper's gap.

#include "design.hpp"
#include "runs.hpp"

#include "support/mean.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace paper_gap {

/// What the text of the paper states (section 7).
struct Stated {
  double force_near = 150.0;     ///< N, a third of the way on, measured and simulated
  double force_end = 500.0;      ///< N, measured
  double simulated_end = 1500.0; ///< N, "almost three times"
  double pitch_near = -6.5;      ///< degrees, measured
  double simulated_near = -10.0; ///< degrees
};
inline constexpr Stated stated{};

/// A run that was done, in the design or with all factors low.
struct Done {
  Case of;
  std::size_t run; ///< of the design
  bool in_design;
  std::optional<Outcome> outcome; ///< none: it failed
  std::string failure;
};

using scree::examples::Mean;

/// A number that is read off a run.
struct Reading {
  const char* name; ///< with its unit, as in the head of a table
  double (*of)(const Outcome&);
};
inline constexpr std::array readings{
    Reading{"force_near_N", [](const Outcome& o) { return Outcome::near(o.force); }},
    Reading{"force_end_N", [](const Outcome& o) { return Outcome::end(o.force); }},
    Reading{"pitch_near_deg", [](const Outcome& o) { return Outcome::near(o.pitch); }},
    Reading{"pitch_end_deg", [](const Outcome& o) { return Outcome::end(o.pitch); }},
    Reading{"depth_near_m", [](const Outcome& o) { return Outcome::near(o.depth); }},
    Reading{"depth_end_m", [](const Outcome& o) { return Outcome::end(o.depth); }},
    Reading{"mass_end_kg", [](const Outcome& o) { return Outcome::end(o.mass); }},
    Reading{"lift_near_N", [](const Outcome& o) { return Outcome::near(o.lift); }},
    Reading{"lift_end_N", [](const Outcome& o) { return Outcome::end(o.lift); }},
    Reading{"porosity", [](const Outcome& o) { return o.porosity; }},
    Reading{"bulk_density_kg_m3", [](const Outcome& o) { return o.bulk_density; }},
    Reading{"grains", [](const Outcome& o) { return o.grains; }}};
enum ReadingIndex : std::size_t {
  force_near,
  force_end,
  pitch_near,
  pitch_end,
  depth_near,
  depth_end,
  mass_end,
  lift_near,
  lift_end,
  porosity,
  bulk_density_kg_m3,
  grains
};

/// All factors low, moved in one of the ways.
struct MotionFinding {
  Motion motion;
  std::size_t runs = 0;
  std::array<Mean, readings.size()> mean{};
};

/// How well depth follows from pitch where the bucket was free: m, root mean square over runs.
struct DepthCheck {
  std::size_t runs = 0;
  Mean found_near{}, by_pitch_near{}, found_end{}, by_pitch_end{};
};

/// A run of the design beside what is stated: whether it agrees, as far as noise and tolerance let one say.
struct Agreement {
  std::size_t run;
  Mean force_near, force_end, pitch_near;
  bool with_measured, with_simulated;
};

struct Findings {
  std::vector<MotionFinding> motions;
  Analysis log_force_near, log_force_end, pitch_near;
  DepthCheck depth;
  std::vector<Agreement> agreements; ///< of the runs of the design that were done
  std::size_t failed = 0;
};

/// Forces may differ from what is stated by this factor, and pitches by so many degrees, and still agree;
/// both ours: what is stated is read off curves that swing.
inline constexpr double force_tolerance = 1.3, pitch_tolerance = 2.0;

Findings found(const Base& base, std::span<const Done> runs);

} // namespace paper_gap
