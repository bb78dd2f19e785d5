#pragma once
/// \file
/// Six suspects in sixteen runs, and what each of them does.

#include <array>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace paper_gap {

/// Stands where the responses do not determine a number.
inline constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// What may differ between the laboratory and its simulation, and the two ways in which it is done here.
struct Factor {
  const char *name, *low, *high;
};
inline constexpr std::array factors{Factor{"bed", "trimmed", "full"},
                                    Factor{"packing", "loose", "dense at the same bulk density"},
                                    Factor{"wall friction", "low", "high"},
                                    Factor{"local damping", "none", "on"},
                                    Factor{"clump mass", "sum of spheres", "union of spheres"},
                                    Factor{"motion", "free on ropes", "replayed"}};
inline constexpr std::size_t factor_count = factors.size();

/// Of each factor, -1 for low and 1 for high.
using Levels = std::array<int, factor_count>;

/// A quarter of all 64 combinations, of resolution IV: the fifth factor goes as the product of the first
/// three, the sixth as that of the second to fourth. No main effect is mixed with one of two factors, but
/// those of two factors are with each other. The first is all low.
std::vector<Levels> design();

/// Effects of two factors that the design cannot tell apart: the column that they share, and the names of all
/// of them.
struct AliasGroup {
  std::vector<int> column; ///< by runs of the design
  std::string name;
};
std::vector<AliasGroup> alias_groups();

/// What a run of the design came to.
struct Response {
  std::size_t run; ///< of the design
  double value;
};

/// The change of a response from low to high, with its standard error.
struct Effect {
  std::string name;
  double value, error;
};

struct Analysis {
  double mean = 0.0;    ///< of the response over the design
  double scatter = 0.0; ///< standard deviation of a single run
  double freedom = 0.0; ///< degrees of freedom of the scatter
  /// Whether the scatter is that of replicates about their mean. Without replicates it is what main effects
  /// leave, and holds effects of several factors together too.
  bool replicated = false;
  std::vector<Effect> main{};         ///< by factor; empty where runs of the design are lacking for them
  std::vector<Effect> interactions{}; ///< by alias group; empty likewise
};

/// By least squares, each replicate counting once. Values that are no numbers are left out.
Analysis analysed(const std::vector<Response>& responses);

} // namespace paper_gap
