#pragma once
/// \file
/// What measured and simulated runs say together of the parameters.

#include "scree/calibrate/discrepancy.hpp"
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
#include <vector>

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
    precision[parameter] = fixed;
  }
  [[nodiscard]] bool is_fixed(Eigen::Index parameter) const { return precision[parameter] == fixed; }

private:
  static constexpr double fixed = 1e12; ///< precision
};

/// The parameters near one point of their space, in shares of it: a normal distribution, from the surfaces
/// straightened at that point, the noise of both sides, and the prior.
class Posterior {
public:
  Posterior(std::span<const Measured> measured, const ResponseSurface& response, Prior prior,
            const Eigen::VectorXd& at)
      : Posterior{measured, response, std::move(prior), at, response.predicted(at)} {}

  /// \param simulated of the response at that point, or with variances from near it
  Posterior(std::span<const Measured> measured, const ResponseSurface& response, Prior prior,
            const Eigen::VectorXd& at, const ResponseSurface::Prediction& simulated)
      : measured_{measured},
        prior_{std::move(prior)},
        at_{at},
        freedom_{response.freedom()},
        seen_{measured, response, simulated},
        weight_{(seen_.of_measured + seen_.of_simulated).inverse()} {
    const Eigen::MatrixXd slopes = slopes_of(response, prior_, at);
    Eigen::MatrixXd precision = slopes.transpose() * weight_ * slopes;
    precision.diagonal() += prior_.precision;
    covariance_ = precision.inverse();
    gain_ = covariance_ * slopes.transpose() * weight_;
  }

  /// From the point to the most probable one.
  [[nodiscard]] Eigen::VectorXd step() const {
    return gain_ * seen_.residual + covariance_ * prior_.precision.cwiseProduct(prior_.centre - at_);
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
    return g.dot(seen_.of_simulated * g) / covariance_(parameter, parameter);
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
          parts.try_emplace(one.specimens, Part{Eigen::VectorXd::Zero(seen_.residual.size()), one.freedom()})
              .first->second;
      const auto at = static_cast<Eigen::Index>(k);
      part.gain[at] = gain_(parameter, at);
      part.freedom = std::min(part.freedom, one.freedom());
    }
    double sum = 0.0; // of squares over their freedom
    for (const auto& [specimens, part] : parts) {
      sum += std::pow(part.gain.dot(seen_.of_measured * part.gain), 2) / part.freedom;
      sum += std::pow(part.gain.dot(seen_.of_simulated * part.gain), 2) / freedom_;
    }
    return std::clamp(std::pow(covariance_(parameter, parameter), 2) / std::max(1e-300, sum), 1.0, 1e6);
  }

  /// Measured less simulated over the standard error of that, for each observable.
  [[nodiscard]] Eigen::VectorXd standardised_residuals() const {
    return seen_.residual.cwiseQuotient((seen_.of_measured + seen_.of_simulated).diagonal().cwiseSqrt());
  }
  /// Sum of squared residuals through the inverse of their covariance.
  [[nodiscard]] double misfit() const { return seen_.residual.dot(weight_ * seen_.residual); }

private:
  /// Observables by parameters; nothing along those that are fixed, as nothing comes of it.
  static Eigen::MatrixXd slopes_of(const ResponseSurface& response, const Prior& prior,
                                   const Eigen::VectorXd& at) {
    std::vector<Eigen::Index> along;
    for (Eigen::Index k = 0; k < at.size(); ++k) {
      if (!prior.is_fixed(k)) {
        along.push_back(k);
      }
    }
    Eigen::MatrixXd out = Eigen::MatrixXd::Zero(response.noise().size(), at.size());
    out(Eigen::indexing::all, along) = response.slopes(at, along);
    return out;
  }

  std::span<const Measured> measured_;
  Prior prior_;
  Eigen::VectorXd at_;
  double freedom_; // of the simulated noise
  Discrepancy seen_;
  Eigen::MatrixXd weight_, covariance_, gain_;
};

/// As far as from one point to the next, within the bounds.
inline Eigen::VectorXd stepped(const Eigen::VectorXd& from, const Eigen::VectorXd& step) {
  return (from + step.cwiseMax(-0.2).cwiseMin(0.2)).cwiseMax(0.0).cwiseMin(1.0);
}

/// The most probable parameters, in shares, within the bounds: Gauss and Newton on the surfaces.
inline Eigen::VectorXd most_probable(std::span<const Measured> measured, const ResponseSurface& response,
                                     const Prior& prior, Eigen::VectorXd from) {
  constexpr double tolerance = 1e-9; // of the last step
  for (int iteration = 0; iteration < 50; ++iteration) {
    const Eigen::VectorXd next = stepped(from, Posterior{measured, response, prior, from}.step());
    const double moved = (next - from).cwiseAbs().maxCoeff();
    from = next;
    if (moved < tolerance) {
      break;
    }
  }
  return from;
}

/// Nearly the same, for a start that is near or where near is enough: to the last step of 1e-3, and as surely
/// as the response is known at the start, which is most of the work.
inline Eigen::VectorXd nearly_most_probable(std::span<const Measured> measured,
                                            const ResponseSurface& response, const Prior& prior,
                                            Eigen::VectorXd from) {
  ResponseSurface::Prediction simulated = response.predicted(from);
  for (int iteration = 0; iteration < 50; ++iteration) {
    const Eigen::VectorXd next = stepped(from, Posterior{measured, response, prior, from, simulated}.step());
    const double moved = (next - from).cwiseAbs().maxCoeff();
    from = next;
    if (moved < 1e-3) {
      break;
    }
    simulated.mean = response.mean(from);
  }
  return from;
}

} // namespace scree
