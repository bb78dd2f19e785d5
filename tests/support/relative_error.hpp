#pragma once
/// \file
/// Comparison of small and large numbers alike.

#include <cmath>

namespace scree::test {

/// |value - expected| / |expected|. doctest's Approx(x).epsilon(e) allows e (1 + |x|), which for a contact
/// time or an overlap is no test at all.
inline double relative_error(double value, double expected) {
  return std::abs(value - expected) / std::abs(expected);
}

} // namespace scree::test
