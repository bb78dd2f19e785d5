#pragma once
/// \file
/// How well readings fit a model that is straightened at one point of its base parameters.

#include "scree/calibrate/posterior.hpp"
#include "scree/diagnose/noise.hpp"

#include <boost/math/special_functions/gamma.hpp>

#include <Eigen/Dense>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace scree {

/// Simulated observables near one point, at fixed parameters of the causes.
struct LocalModel {
  Eigen::VectorXd base;     ///< the point, in shares of the base parameters
  Eigen::VectorXd mean;     ///< of each observable, as compared
  Eigen::VectorXd variance; ///< of that, as runs are few
  Eigen::MatrixXd slopes;   ///< observables by base parameters
};

struct LocalFit {
  /// Of the readings, with the base parameters integrated over their prior.
  double log_evidence = 0.0;
  /// Twice what the log likelihood lacks to its best, prior included.
  double deviance = 0.0;
  Eigen::VectorXd base;      ///< most probable, in shares
  Eigen::MatrixXd precision; ///< inverse of its covariance
};

namespace detail {

/// One group of observables: multivariate Student, as its variances are estimates.
struct StudentPart {
  Eigen::MatrixXd inverse; // of the scale
  double log_determinant = 0.0, freedom = 0.0;
  Eigen::VectorXd residual;
  Eigen::MatrixXd slopes;

  StudentPart(const Noise::Group& group, const Readings& readings, const LocalModel& local,
              double simulated_freedom) {
    const auto m = static_cast<Eigen::Index>(group.members.size());
    residual = readings.mean(group.members) - local.mean(group.members);
    slopes = local.slopes(group.members, Eigen::indexing::all);
    const Eigen::VectorXd seen = readings.variance(group.members), run = local.variance(group.members);
    const Eigen::VectorXd a = seen.cwiseSqrt(), b = run.cwiseSqrt();
    const Eigen::MatrixXd scale = group.correlation.cwiseProduct(a * a.transpose() + b * b.transpose());
    const Eigen::LLT<Eigen::MatrixXd> factor{scale};
    inverse = factor.solve(Eigen::MatrixXd::Identity(m, m));
    log_determinant = 2.0 * factor.matrixLLT().diagonal().array().log().sum();
    // Satterthwaite for the sum of the two variances.
    const double share = (seen.array() / (seen + run).array()).mean();
    freedom = 1.0 / (share * share / group.freedom + (1.0 - share) * (1.0 - share) / simulated_freedom);
  }

  [[nodiscard]] double size() const { return static_cast<double>(residual.size()); }
  [[nodiscard]] double distance2(const Eigen::VectorXd& shift) const {
    const Eigen::VectorXd left = residual - slopes * shift;
    return left.dot(inverse * left);
  }
  [[nodiscard]] double weight(double distance2) const { return (freedom + size()) / (freedom + distance2); }
  [[nodiscard]] double deviance(double distance2) const {
    return (freedom + size()) * std::log1p(distance2 / freedom);
  }
  [[nodiscard]] double log_density(double distance2) const {
    // Judged thousands of times, where a double is precise enough.
    using InDouble = boost::math::policies::policy<boost::math::policies::promote_double<false>>;
    return boost::math::lgamma(0.5 * (freedom + size()), InDouble{}) -
           boost::math::lgamma(0.5 * freedom, InDouble{}) -
           0.5 * size() * std::log(freedom * std::numbers::pi) - 0.5 * log_determinant -
           0.5 * deviance(distance2);
  }
};

} // namespace detail

/// The most probable base parameters near the point of `local`, and the evidence by Laplace's method.
/// \param prior of the base parameters
inline LocalFit fitted(const Noise& noise, const Readings& readings, const LocalModel& local,
                       const Prior& prior) {
  std::vector<detail::StudentPart> parts;
  parts.reserve(noise.groups().size());
  for (const Noise::Group& group : noise.groups()) {
    parts.emplace_back(group, readings, local, noise.simulated_freedom());
  }
  const Eigen::VectorXd from_centre = prior.centre - local.base;
  Eigen::VectorXd shift = Eigen::VectorXd::Zero(local.base.size());
  LocalFit out;
  constexpr int iterations = 4; // of reweighting
  for (int i = 0; i < iterations; ++i) {
    out.precision = prior.precision.asDiagonal();
    Eigen::VectorXd pull = prior.precision.cwiseProduct(from_centre);
    for (const detail::StudentPart& part : parts) {
      const Eigen::MatrixXd weighted =
          part.weight(part.distance2(shift)) * (part.slopes.transpose() * part.inverse);
      out.precision += weighted * part.slopes;
      pull += weighted * part.residual;
    }
    shift = out.precision.llt().solve(pull);
  }
  const double of_prior = (from_centre - shift).cwiseAbs2().dot(prior.precision);
  out.deviance = of_prior;
  for (const detail::StudentPart& part : parts) {
    const double d2 = part.distance2(shift);
    out.deviance += part.deviance(d2);
    out.log_evidence += part.log_density(d2);
  }
  const double log_precision = 2.0 * out.precision.llt().matrixLLT().diagonal().array().log().sum();
  out.log_evidence += 0.5 * (prior.precision.array().log().sum() - log_precision - of_prior);
  out.base = local.base + shift;
  return out;
}

} // namespace scree
