#pragma once
/// \file
/// Means and what they are worth.

#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

namespace scree::examples {

/// Mean of independent values with its standard error.
struct Mean {
  double value = 0.0;
  double error = 0.0; ///< not a number for fewer than two values
  std::size_t count = 0;

  Mean() = default;
  /// Not a number for no values.
  explicit Mean(std::span<const double> values) : count{values.size()} {
    const auto n = static_cast<double>(count);
    for (const double v : values) {
      value += v / n;
    }
    double squares = 0.0;
    for (const double v : values) {
      squares += (v - value) * (v - value);
    }
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    error = count < 2 ? none : std::sqrt(squares / (n - 1.0) / n);
    value = count < 1 ? none : value;
  }

  /// Of the values times a factor.
  [[nodiscard]] Mean scaled(double factor) const {
    Mean out{*this};
    out.value *= factor;
    out.error *= std::abs(factor);
    return out;
  }

  /// How far the true mean may be away, with the confidence `level`: Student's t times the standard error.
  [[nodiscard]] double margin(double level) const {
    return student(static_cast<double>(count) - 1.0, level) * error;
  }

  /// Student's t of both sides. \param freedom above 0
  [[nodiscard]] static double student(double freedom, double level);
};

} // namespace scree::examples
