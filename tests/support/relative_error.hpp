#pragma once
/// \file
/// Comparison of small and large numbers alike.

#include <doctest/doctest.h>

#include <cmath>

namespace scree::test {

/// |value - expected| / |expected|.
inline double relative_error(double value, double expected) {
  return std::abs(value - expected) / std::abs(expected);
}

/// Equal to a share of the larger of the two, for what is not zero. doctest's own Approx(x).epsilon(e) allows
/// e (1 + |x|), which for a contact time or an overlap is no test at all.
inline doctest::Approx about(double expected, double tolerance = 1e-9) {
  return doctest::Approx(expected).scale(0.0).epsilon(tolerance);
}

} // namespace scree::test
