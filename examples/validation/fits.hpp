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

/// A straight line y = intercept + slope x through points with standard errors, by weighted least squares.
struct Fit {
  double intercept = 0.0, slope = 0.0, slope_error = 0.0;
  double middle = 0.0, at_middle = 0.0,
         middle_error = 0.0; ///< there its error does not depend on the slope's

  Fit(const std::vector<double>& x, const std::vector<double>& y, const std::vector<double>& error) {
    double weight = 0.0, sxx = 0.0, sxy = 0.0;
    for (std::size_t k = 0; k < x.size(); ++k) {
      const double w = 1.0 / (error[k] * error[k]);
      weight += w;
      middle += w * x[k];
      at_middle += w * y[k];
    }
    middle /= weight;
    at_middle /= weight;
    for (std::size_t k = 0; k < x.size(); ++k) {
      const double w = 1.0 / (error[k] * error[k]);
      sxx += w * (x[k] - middle) * (x[k] - middle);
      sxy += w * (x[k] - middle) * (y[k] - at_middle);
    }
    slope = sxy / sxx;
    slope_error = 1.0 / std::sqrt(sxx);
    middle_error = 1.0 / std::sqrt(weight);
    intercept = at_middle - slope * middle;
  }
};

} // namespace validation
