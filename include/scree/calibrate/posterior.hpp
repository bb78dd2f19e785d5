#pragma once
/// \file
/// What measured and simulated runs say together of the parameters.

#include "scree/calibrate/measured.hpp"
#include "scree/calibrate/response_surface.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <span>
#include <string>

namespace scree {

/// The parameters near one point of their space, in shares of it: a normal distribution, from the surfaces
/// straightened at that point, the noise of both sides, and a weak prior as wide as the bounds, so that it
/// stays finite where data say nothing.
class Posterior {
public:
  /// 1 over the prior's variance, which is that of an even distribution over the bounds.
  static constexpr double prior_precision = 12.0;

  Posterior(std::span<const Measured> measured, const ResponseSurface& response, const Eigen::VectorXd& at)
      : measured_{measured}, at_{at}, freedom_{response.freedom()} {
    const auto m = static_cast<Eigen::Index>(measured.size());
    const auto simulated = response.predicted(at);
    residual_.resize(m);
    Eigen::VectorXd scatter(m);
    for (Eigen::Index k = 0; k < m; ++k) {
      const Measured& one = measured[static_cast<std::size_t>(k)];
      residual_[k] = one.mean() - simulated.mean[k];
      // The least is for data without any scatter.
      scatter[k] = std::max({std::sqrt(one.variance_of_mean()), 1e-6 * std::abs(one.mean()), 1e-12});
    }
    const Eigen::VectorXd error = simulated.variance.cwiseSqrt();
    const Eigen::MatrixXd together = correlation_of_noise(response);
    of_measured_ = scatter.asDiagonal() * together * scatter.asDiagonal();
    of_simulated_ = error.asDiagonal() * together * error.asDiagonal();

    const Eigen::MatrixXd slopes = response.slopes(at);
    weight_ = (of_measured_ + of_simulated_).inverse();
    covariance_ = (slopes.transpose() * weight_ * slopes +
                   prior_precision * Eigen::MatrixXd::Identity(at.size(), at.size()))
                      .inverse();
    gain_ = covariance_ * slopes.transpose() * weight_;
  }

  /// From the point to the most probable one.
  [[nodiscard]] Eigen::VectorXd step() const {
    const Eigen::VectorXd to_middle = Eigen::VectorXd::Constant(at_.size(), 0.5) - at_;
    return gain_ * residual_ + covariance_ * (prior_precision * to_middle);
  }

  [[nodiscard]] const Eigen::MatrixXd& covariance() const { return covariance_; }
  [[nodiscard]] Eigen::MatrixXd correlation() const {
    const Eigen::VectorXd scale = covariance_.diagonal().cwiseSqrt().cwiseInverse();
    return scale.asDiagonal() * covariance_ * scale.asDiagonal();
  }

  /// Directions of which the data leave more than half of the prior's variance; columns.
  [[nodiscard]] Eigen::MatrixXd undetermined() const {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> directions{covariance_}; // in ascending order
    const auto open = (directions.eigenvalues().array() * prior_precision > 0.5).count();
    return directions.eigenvectors().rightCols(open);
  }

  /// Of the variance of a parameter, what comes from the simulations' own noise.
  [[nodiscard]] double simulated_share(Eigen::Index parameter) const {
    const Eigen::VectorXd g = gain_.row(parameter).transpose();
    return g.dot(of_simulated_ * g) / covariance_(parameter, parameter);
  }

  /// Degrees of freedom behind the variance of a parameter, from those behind its parts (Satterthwaite,
  /// Biometrics Bull. 2:110, 1946).
  [[nodiscard]] double freedom(Eigen::Index parameter) const {
    struct Part {
      Eigen::VectorXd gain;
      double freedom;
    };
    std::map<std::string, Part> parts; // by specimens
    for (std::size_t k = 0; k < measured_.size(); ++k) {
      const Measured& one = measured_[k];
      Part& part =
          parts.try_emplace(one.specimens, Part{Eigen::VectorXd::Zero(residual_.size()), one.freedom()})
              .first->second;
      const auto at = static_cast<Eigen::Index>(k);
      part.gain[at] = gain_(parameter, at);
      part.freedom = std::min(part.freedom, one.freedom());
    }
    double sum = 0.0; // of squares over their freedom
    for (const auto& [specimens, part] : parts) {
      sum += std::pow(part.gain.dot(of_measured_ * part.gain), 2) / part.freedom;
      sum += std::pow(part.gain.dot(of_simulated_ * part.gain), 2) / freedom_;
    }
    return std::clamp(std::pow(covariance_(parameter, parameter), 2) / std::max(1e-300, sum), 1.0, 1e6);
  }

  /// Measured less simulated over the standard error of that, for each observable.
  [[nodiscard]] Eigen::VectorXd standardised_residuals() const {
    return residual_.cwiseQuotient((of_measured_ + of_simulated_).diagonal().cwiseSqrt());
  }
  /// Sum of squared residuals through the inverse of their covariance.
  [[nodiscard]] double misfit() const { return residual_.dot(weight_ * residual_); }

private:
  /// A handful of replicates tells how far measurements scatter; how those of the same specimens do so
  /// together is taken from the simulated ones, shrunk as few runs know it badly. Different specimens have
  /// nothing in common.
  [[nodiscard]] Eigen::MatrixXd correlation_of_noise(const ResponseSurface& response) const {
    Eigen::MatrixXd out = response.correlation();
    const double trust = freedom_ / (freedom_ + static_cast<double>(measured_.size()));
    for (Eigen::Index i = 0; i < out.rows(); ++i) {
      for (Eigen::Index j = 0; j < out.cols(); ++j) {
        const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
        const bool same = measured_[a].specimens == measured_[b].specimens;
        out(i, j) *= i == j ? 1.0 : same ? trust : 0.0;
      }
    }
    return out;
  }

  std::span<const Measured> measured_;
  Eigen::VectorXd at_;
  double freedom_; // of the simulated noise
  Eigen::VectorXd residual_;
  Eigen::MatrixXd of_measured_, of_simulated_; // covariances of the means
  Eigen::MatrixXd weight_, covariance_, gain_;
};

} // namespace scree
