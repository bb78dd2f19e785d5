#pragma once
/// \file
/// Means beside each other.

#include "support/mean.hpp"

#include <cmath>

namespace validation {

using scree::examples::Mean;

/// How far two means of the same may be apart, with the confidence `level`: Student's t times the standard
/// error of their difference.
inline double margin_of_difference(const Mean& a, const Mean& b, double level) {
  return Mean::student(static_cast<double>(a.count + b.count) - 2.0, level) * std::hypot(a.error, b.error);
}

} // namespace validation
