#pragma once
/// \file
/// How stiff a bed is in confined compression, and how that depends on stress.

#include "scree/core/error.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace scree {

/// One branch of a curve, loading or unloading: rows in the order in which they were measured.
struct StressStrain {
  std::vector<double> stress; ///< Pa
  std::vector<double> strain; ///< positive in compression
};

/// The strain at which a branch first passes a stress, between two rows by a straight line.
/// \throws Error where it does not pass it.
inline double strain_at(const StressStrain& branch, double stress) {
  for (std::size_t k = 1; k < branch.stress.size(); ++k) {
    const double a = branch.stress[k - 1], b = branch.stress[k];
    if (a != b && std::min(a, b) <= stress && stress <= std::max(a, b)) {
      return branch.strain[k - 1] + (stress - a) / (b - a) * (branch.strain[k] - branch.strain[k - 1]);
    }
  }
  throw Error(message("the branch does not pass ", stress, " Pa"));
}

/// Pa, of the chord between two stresses.
/// \throws Error where the branch does not pass them, or does not strain in between.
inline double secant_modulus(const StressStrain& branch, double low, double high) {
  const double strain = strain_at(branch, high) - strain_at(branch, low);
  if (!(strain > 0.0)) {
    throw Error(message("the branch strains by ", strain, " between ", low, " and ", high, " Pa"));
  }
  return (high - low) / strain;
}

/// M = modulus (stress / reference)^exponent (Ohde 1939; Janbu 1963). The exponent is 0 for a stiffness that
/// does not depend on stress, 1/3 for a frozen packing of Hertz's spheres, and about 1/2 for sand.
struct PowerStiffness {
  double reference = 0.0; ///< Pa, stress
  double modulus = 0.0;   ///< Pa, at that stress
  double exponent = 0.0;
  double exponent_error = 0.0; ///< standard error, of the straight line in logarithms
};

/// Fits the power law to the chords between `levels` stresses, evenly spaced in their logarithm from `low` to
/// `high` [Pa]; each chord counts at the geometric mean of its ends.
/// \throws Error for a range that is none, fewer than 4 levels, or as `secant_modulus` does.
inline PowerStiffness power_stiffness(const StressStrain& branch, double low, double high, double reference,
                                      std::size_t levels = 8) {
  require_positive("stiffness: low", low, "Pa");
  require_positive("stiffness: reference", reference, "Pa");
  require("stiffness: levels", static_cast<double>(levels), {4.0, 1e4});
  if (!(high > low)) {
    throw Error(message("stiffness: high = ", high, " Pa must be above low = ", low, " Pa"));
  }
  std::vector<double> x, y;
  const double step = std::log(high / low) / static_cast<double>(levels - 1);
  for (std::size_t k = 0; k + 1 < levels; ++k) {
    const double a = low * std::exp(step * static_cast<double>(k)),
                 b = k + 2 < levels ? a * std::exp(step) : high;
    x.push_back(std::log(std::sqrt(a * b) / reference));
    y.push_back(std::log(secant_modulus(branch, a, b)));
  }
  const auto n = static_cast<double>(x.size());
  double mean_x = 0.0, mean_y = 0.0, sxx = 0.0, sxy = 0.0, misfit = 0.0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    mean_x += x[k] / n;
    mean_y += y[k] / n;
  }
  for (std::size_t k = 0; k < x.size(); ++k) {
    sxx += (x[k] - mean_x) * (x[k] - mean_x);
    sxy += (x[k] - mean_x) * (y[k] - mean_y);
  }
  PowerStiffness out{.reference = reference, .exponent = sxy / sxx};
  for (std::size_t k = 0; k < x.size(); ++k) {
    misfit += std::pow(y[k] - mean_y - out.exponent * (x[k] - mean_x), 2);
  }
  out.modulus = std::exp(mean_y - out.exponent * mean_x);
  out.exponent_error = std::sqrt(misfit / (n - 2.0) / sxx);
  return out;
}

} // namespace scree
