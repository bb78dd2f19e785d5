#pragma once
/// \file
/// A number that was measured more than once.

#include "scree/core/error.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace scree {

/// A scalar observable with its replicates.
struct Measured {
  std::string name;
  std::string unit{};
  std::vector<double> replicates{}; ///< one or more
  double error = 0.0; ///< standard error of their mean, where it is known beforehand; 0: from their scatter
  bool logarithmic = false; ///< compared as its logarithm, for what answers in proportion; all above 0
  /// Observables that name the same specimens were measured on these together and scatter together; those
  /// that name others scatter by themselves.
  std::string specimens{};
  /// Kind of experiment that it comes from; empty: one whose results any parameter may change.
  std::string kind{};
  /// Curve that this is a point of, next to those points before and after it; empty: none.
  std::string curve{};

  /// \throws Error for no replicates, one without an error, or a value that cannot be compared.
  void check() const {
    if (replicates.empty()) {
      throw Error(message("observable ", name, ": no replicate"));
    }
    if (replicates.size() == 1 && !(error > 0.0)) {
      throw Error(message("observable ", name, ": a single replicate needs an error above 0"));
    }
    require(message("observable ", name, ": error"), error, {0.0, 1e300, unit});
    for (const double value : replicates) {
      if (!std::isfinite(value) || (logarithmic && !(value > 0.0))) {
        throw Error(message("observable ", name, ": replicate ", value, " ", unit,
                            logarithmic ? " must be above 0" : " must be a number"));
      }
    }
  }

  /// As it is compared: itself, or its logarithm.
  [[nodiscard]] double compared(double value) const { return logarithmic ? std::log(value) : value; }

  /// Of the replicates, as they are compared.
  [[nodiscard]] double mean() const {
    double sum = 0.0;
    for (const double value : replicates) {
      sum += compared(value);
    }
    return sum / static_cast<double>(replicates.size());
  }
  /// Square of the standard error of that mean, as compared.
  [[nodiscard]] double variance_of_mean() const {
    if (error > 0.0) {
      const double middle = logarithmic ? std::exp(mean()) : 1.0;
      return std::pow(error / middle, 2);
    }
    const double middle = mean();
    double sum = 0.0;
    for (const double value : replicates) {
      sum += std::pow(compared(value) - middle, 2);
    }
    const auto n = static_cast<double>(replicates.size());
    return sum / (n - 1.0) / n;
  }
  /// Degrees of freedom behind that; infinite where the error was given.
  [[nodiscard]] double freedom() const {
    return error > 0.0 ? HUGE_VAL : static_cast<double>(replicates.size()) - 1.0;
  }
};

} // namespace scree
