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
#include <utility>

namespace scree {

/// What is known of parameters beforehand, in shares of their space: independent normal distributions.
struct Prior {
  Eigen::VectorXd centre;
  Eigen::VectorXd precision; ///< 1 over the variance, above 0

  /// As wide as even distributions over the bounds, so that estimates stay finite where data say nothing.
  static Prior even(Eigen::Index parameters) {
    return {Eigen::VectorXd::Constant(parameters, 0.5), Eigen::VectorXd::Constant(parameters, 12.0)};
  }
  /// Leaves one parameter where it is.
  void fix(Eigen::Index parameter, double share) {
    centre[parameter] = share;
    precision[parameter] = 1e12;
  }
};

/// The parameters near one point of their space, in shares of it: a normal distribution, from the surfaces
/// straightened at that point, the noise of both sides, and the prior.
class Posterior {
public:
  Posterior(std::span<const Measured> measured, const ResponseSurface& response, Prior prior,
            const Eigen::VectorXd& at)
      : measured_{measured}, prior_{std::move(prior)}, at_{at}, freedom_{response.freedom()} {
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
    Eigen::MatrixXd precision = slopes.transpose() * weight_ * slopes;
    precision.diagonal() += prior_.precision;
    covariance_ = precision.inverse();
    gain_ = covariance_ * slopes.transpose() * weight_;
  }

  /// From the point to the most probable one.
  [[nodiscard]] Eigen::VectorXd step() const {
    return gain_ * residual_ + covariance_ * prior_.precision.cwiseProduct(prior_.centre - at_);
  }

  [[nodiscard]] const Eigen::MatrixXd& covariance() const { return covariance_; }
  [[nodiscard]] Eigen::MatrixXd correlation() const {
    const Eigen::VectorXd scale = covariance_.diagonal().cwiseSqrt().cwiseInverse();
    return scale.asDiagonal() * covariance_ * scale.asDiagonal();
  }

  /// Directions of which the data leave more than half of the prior's variance; columns.
  [[nodiscard]] Eigen::MatrixXd undetermined() const {
    // In units of the prior's widths.
    const Eigen::VectorXd narrow = prior_.precision.cwiseSqrt();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> directions{
        narrow.asDiagonal() * covariance_ * narrow.asDiagonal()}; // in ascending order
    const auto open = (directions.eigenvalues().array() > 0.5).count();
    return (narrow.cwiseInverse().asDiagonal() * directions.eigenvectors().rightCols(open))
        .colwise()
        .normalized();
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
  Prior prior_;
  Eigen::VectorXd at_;
  double freedom_; // of the simulated noise
  Eigen::VectorXd residual_;
  Eigen::MatrixXd of_measured_, of_simulated_; // covariances of the means
  Eigen::MatrixXd weight_, covariance_, gain_;
};

/// The most probable parameters, in shares, within the bounds: Gauss and Newton on the surfaces.
inline Eigen::VectorXd most_probable(std::span<const Measured> measured, const ResponseSurface& response,
                                     const Prior& prior, Eigen::VectorXd from) {
  for (int iteration = 0; iteration < 50; ++iteration) {
    const Eigen::VectorXd step =
        Posterior{measured, response, prior, from}.step().cwiseMax(-0.2).cwiseMin(0.2);
    const Eigen::VectorXd next = (from + step).cwiseMax(0.0).cwiseMin(1.0);
    const double moved = (next - from).cwiseAbs().maxCoeff();
    from = next;
    if (moved < 1e-9) {
      break;
    }
  }
  return from;
}

} // namespace scree
