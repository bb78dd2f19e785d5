#pragma once
/// \file
/// How far simulated means are from measured ones, and how surely.

#include "scree/calibrate/measured.hpp"
#include "scree/calibrate/response_surface.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

namespace scree {

/// How the observables of single specimens scatter together: as the simulated ones do, shrunk as few runs
/// know it badly. Different specimens have nothing in common.
inline Eigen::MatrixXd correlation_of_noise(std::span<const Measured> measured,
                                            const ResponseSurface& response) {
  Eigen::MatrixXd out = response.correlation();
  const double trust = response.freedom() / (response.freedom() + static_cast<double>(measured.size()));
  for (Eigen::Index i = 0; i < out.rows(); ++i) {
    for (Eigen::Index j = 0; j < out.cols(); ++j) {
      const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
      const bool same = measured[a].specimens == measured[b].specimens;
      out(i, j) *= i == j ? 1.0 : same ? trust : 0.0;
    }
  }
  return out;
}

/// Square of the standard error of what was measured, as compared; above 0 for data without any scatter too.
inline double variance_of(const Measured& one) {
  return std::max({one.variance_of_mean(), std::pow(1e-6 * one.mean(), 2), 1e-24});
}

/// Measured less simulated means at one point of the space.
struct Discrepancy {
  Eigen::VectorXd residual;
  Eigen::MatrixXd of_measured, of_simulated; ///< covariances of the means

  /// \param simulated of the response at that point
  Discrepancy(std::span<const Measured> measured, const ResponseSurface& response,
              const ResponseSurface::Prediction& simulated) {
    const auto m = static_cast<Eigen::Index>(measured.size());
    residual.resize(m);
    Eigen::VectorXd scatter(m);
    for (Eigen::Index k = 0; k < m; ++k) {
      const Measured& one = measured[static_cast<std::size_t>(k)];
      residual[k] = one.mean() - simulated.mean[k];
      scatter[k] = std::sqrt(variance_of(one));
    }
    const Eigen::VectorXd error = simulated.variance.cwiseSqrt();
    const Eigen::MatrixXd together = correlation_of_noise(measured, response);
    of_measured = scatter.asDiagonal() * together * scatter.asDiagonal();
    of_simulated = error.asDiagonal() * together * error.asDiagonal();
  }
};

} // namespace scree
