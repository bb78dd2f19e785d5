#pragma once
/// \file
/// Means and what they are worth.

#include <cmath>
#include <cstddef>
#include <vector>

namespace validation {

/// Mean of independent values with its standard error.
struct Mean {
  double value = 0.0, error = 0.0;
  std::size_t count = 0;

  /// \param values at least two
  explicit Mean(const std::vector<double>& values) : count{values.size()} {
    const auto n = static_cast<double>(count);
    for (const double v : values) {
      value += v / n;
    }
    double squares = 0.0;
    for (const double v : values) {
      squares += (v - value) * (v - value);
    }
    error = std::sqrt(squares / (n - 1.0) / n);
  }

  /// How far the true mean may be away, with the confidence `level`: Student's t times the standard error.
  [[nodiscard]] double margin(double level) const { return student(count - 1, level) * error; }

  /// Student's t of both sides.
  [[nodiscard]] static double student(std::size_t freedom, double level);
};

/// How far two means of the same may be apart, with the confidence `level`: Student's t times the standard
/// error of their difference.
inline double margin_of_difference(const Mean& a, const Mean& b, double level) {
  return Mean::student(a.count + b.count - 2, level) * std::hypot(a.error, b.error);
}

} // namespace validation
