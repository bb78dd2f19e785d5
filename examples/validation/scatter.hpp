#pragma once
/// \file
/// Means and their standard errors.

#include <cmath>
#include <vector>

namespace validation {

/// A mean with its standard error.
struct Mean {
  double value = 0.0, error = 0.0;
};

/// Of independent values, at least two.
inline Mean mean_of(const std::vector<double>& values) {
  Mean mean;
  const auto n = static_cast<double>(values.size());
  for (const double v : values) {
    mean.value += v / n;
  }
  for (const double v : values) {
    mean.error += std::pow(v - mean.value, 2) / (n * (n - 1.0));
  }
  mean.error = std::sqrt(mean.error);
  return mean;
}

} // namespace validation
