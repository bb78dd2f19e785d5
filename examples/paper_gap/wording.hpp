#pragma once
/// \file
/// How effects and means are put into words and numbers.

#include "findings.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace paper_gap {

inline constexpr double gap = 3.0; ///< of the forces at the end, simulated over measured

/// "1.20 (1.05 to 1.38)": what a difference of logarithms says as a factor, with its 95 % interval.
struct Interval {
  double value, low, high;
};
inline Interval interval(const Effect& e, double freedom, bool as_factor) {
  const double reach = freedom > 0.0 ? Mean::student(freedom, 0.95) * e.error : std::nan("");
  if (as_factor) {
    return {std::exp(e.value), std::exp(e.value - reach), std::exp(e.value + reach)};
  }
  return {e.value, e.value - reach, e.value + reach};
}
inline std::string text(const Interval& i, const char* form) {
  const auto number = [&](double v) { return fmt::format(fmt::runtime(form), v); };
  if (!std::isfinite(i.low)) {
    return number(i.value) + " (no interval)";
  }
  return number(i.value) + " (" + number(i.low) + " to " + number(i.high) + ")";
}
inline std::string text(const Mean& m, const char* form) {
  const auto number = [&](double v) { return fmt::format(fmt::runtime(form), v); };
  return std::isfinite(m.error) ? number(m.value) + " ± " + number(m.error) : number(m.value);
}
inline bool clear(const Interval& i, double null) {
  return i.low > null || i.high < null;
}

/// Of the gap, in logarithms, so that shares of factors that multiply add up.
inline double share(const Effect& e) {
  return e.value / std::log(gap);
}

inline const char* scatter_of(const Analysis& a) {
  return a.replicated ? "replicates" : "what main effects leave, as there are no replicates";
}

} // namespace paper_gap
