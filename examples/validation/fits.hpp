#pragma once
/// \file
/// Straight lines with their standard errors.

#include "scatter.hpp"

#include <cmath>
#include <cstddef>
#include <vector>

namespace validation {

/// Slope of a line through equally spaced values and its standard error.
struct Trend {
  double slope = 0.0, error = 0.0; ///< over the whole range

  explicit Trend(const std::vector<double>& values) {
    const auto n = static_cast<double>(values.size());
    const double mean = Mean{values}.value;
    double sxx = 0.0, sxy = 0.0, residual = 0.0;
    const auto place = [n](std::size_t k) { return (static_cast<double>(k) + 0.5) / n - 0.5; };
    for (std::size_t k = 0; k < values.size(); ++k) {
      sxx += place(k) * place(k);
      sxy += place(k) * (values[k] - mean);
    }
    slope = sxy / sxx;
    for (std::size_t k = 0; k < values.size(); ++k) {
      const double off = values[k] - mean - slope * place(k);
      residual += off * off;
    }
    error = std::sqrt(residual / (n - 2.0) / sxx);
  }
};

/// A straight line y = intercept + slope x through scattered points. What each is in doubt by is known up to
/// a common factor, which the scatter about the line gives.
struct Fit {
  double slope = 0.0, slope_error = 0.0;
  double root = 0.0, root_error = 0.0; ///< x where the line meets 0, by first-order propagation
  std::size_t freedom = 0;             ///< of Student's t, for both errors

  /// \param doubt relative to each other
  Fit(const std::vector<double>& x, const std::vector<double>& y, const std::vector<double>& doubt)
      : freedom{x.size() - 2} {
    // Line through the centre of weights: there, height and slope are independent.
    double weight = 0.0, middle = 0.0, height = 0.0, sxx = 0.0, sxy = 0.0, residual = 0.0;
    const auto w = [&](std::size_t k) { return 1.0 / (doubt[k] * doubt[k]); };
    for (std::size_t k = 0; k < x.size(); ++k) {
      weight += w(k);
      middle += w(k) * x[k];
      height += w(k) * y[k];
    }
    middle /= weight;
    height /= weight;
    for (std::size_t k = 0; k < x.size(); ++k) {
      sxx += w(k) * (x[k] - middle) * (x[k] - middle);
      sxy += w(k) * (x[k] - middle) * (y[k] - height);
    }
    slope = sxy / sxx;
    for (std::size_t k = 0; k < x.size(); ++k) {
      const double off = y[k] - height - slope * (x[k] - middle);
      residual += w(k) * off * off;
    }
    const double scale = std::sqrt(residual / static_cast<double>(freedom));
    slope_error = scale / std::sqrt(sxx);
    root = middle - height / slope;
    root_error = std::hypot(scale / std::sqrt(weight) / slope, height * slope_error / (slope * slope));
  }

  /// How far the true slope or root may be away, with the confidence `level`.
  [[nodiscard]] double slope_margin(double level) const {
    return Mean::student(static_cast<double>(freedom), level) * slope_error;
  }
  [[nodiscard]] double root_margin(double level) const {
    return Mean::student(static_cast<double>(freedom), level) * root_error;
  }
};

} // namespace validation
