#pragma once
/// \file
/// How a result goes with a parameter, from a few runs at each of a few values.

#include "scree/core/error.hpp"
#include "support/mean.hpp"

#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace scree::examples {

/// Runs that differ in nothing but their seed.
struct Level {
  double parameter = 0.0;         ///< above 0
  std::vector<double> observed{}; ///< 2 or more, each above 0
};

/// \throws Error for fewer than two runs.
inline Mean mean_of_runs(std::span<const double> observed) {
  require("runs of a mean", static_cast<double>(observed.size()), {2.0, 1e9});
  return Mean{observed};
}

/// observed ~ parameter^exponent. An exponent of 1 means in proportion, one of 0.1 that twice the parameter
/// adds 7 %.
struct Trend {
  double exponent = 0.0;
  double error = 0.0;  ///< standard error, from how runs of one level differ; bends do not count as scatter
  double change = 0.0; ///< from the first level to the last, over the first
  double change_error = 0.0; ///< its standard error
};

/// The straight line in logarithms through all runs.
/// \throws Error for fewer than two levels, one of fewer than two runs, all at one parameter, or values that
/// are not above 0.
inline Trend trend(std::span<const Level> levels) {
  require("levels of a trend", static_cast<double>(levels.size()), {2.0, 1e9});
  double runs = 0.0, mean_x = 0.0, scatter = 0.0;
  for (const Level& level : levels) {
    require_positive("parameter of a trend", level.parameter);
    const auto n = static_cast<double>(level.observed.size());
    runs += n;
    mean_x += n * std::log(level.parameter);
    std::vector<double> logarithms;
    for (const double v : level.observed) {
      require_positive("value of a trend", v);
      logarithms.push_back(std::log(v));
    }
    scatter += n * (n - 1.0) * std::pow(mean_of_runs(logarithms).error, 2);
  }
  mean_x /= runs;
  const double variance = scatter / (runs - static_cast<double>(levels.size()));
  double sxx = 0.0, sxy = 0.0;
  for (const Level& level : levels) {
    const double x = std::log(level.parameter) - mean_x;
    for (const double v : level.observed) {
      sxx += x * x;
      sxy += x * std::log(v);
    }
  }
  require_positive("spread of the parameters of a trend", sxx);
  const Mean first = mean_of_runs(levels.front().observed), last = mean_of_runs(levels.back().observed);
  const double ratio = last.value / first.value;
  const auto ends = [&](const Level& level) { return variance / static_cast<double>(level.observed.size()); };
  return {.exponent = sxy / sxx,
          .error = std::sqrt(variance / sxx),
          .change = ratio - 1.0,
          .change_error = ratio * std::sqrt(ends(levels.front()) + ends(levels.back()))};
}

} // namespace scree::examples
