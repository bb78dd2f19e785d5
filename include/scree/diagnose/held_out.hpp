#pragma once
/// \file
/// How well hypotheses predict what they were not fitted to.

#include "scree/core/error.hpp"
#include "scree/core/random.hpp"
#include "scree/diagnose/bootstrap.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace scree {

/// Observables that were held out, as a hypothesis predicts them, and how surely.
struct HeldOutPrediction {
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance; ///< of the mean
};

/// \param response of the held-out observables over the same space
inline HeldOutPrediction predicted(const Court& court, const Hypothesis& hypothesis, const Readings& readings,
                                   const Judgement& judgement, const ModelSpace& space,
                                   const ResponseSurface& response, double form_tolerance) {
  const Eigen::Index m = response.noise().size();
  HeldOutPrediction out{Eigen::VectorXd::Zero(m), Eigen::MatrixXd::Zero(m, m)};
  Eigen::MatrixXd second = Eigen::MatrixXd::Zero(m, m);
  for (std::size_t j = 0; j < hypothesis.points().size(); ++j) {
    const double weight = judgement.weights[static_cast<Eigen::Index>(j)];
    if (weight < 1e-4) {
      continue;
    }
    const Hypothesis::Point& point = hypothesis.points()[j];
    const LocalFit fit = fitted(court.noise, readings, point.local, court.base);
    Eigen::VectorXd at = space.null();
    at.head(fit.base.size()) = fit.base.cwiseMax(0.0).cwiseMin(1.0);
    for (std::size_t k = 0; k < hypothesis.free().size(); ++k) {
      at[hypothesis.free()[k]] = point.shares[static_cast<Eigen::Index>(k)];
    }
    const auto surface = response.predicted(at);
    const Eigen::MatrixXd slopes = response.slopes(at, fit.base.size());
    out.mean += weight * surface.mean;
    second += weight * (surface.mean * surface.mean.transpose());
    out.covariance += weight * (slopes * fit.precision.llt().solve(slopes.transpose()));
    out.covariance.diagonal() +=
        weight *
        (surface.variance + Hypothesis::form_variance(space, at, surface.mean, response, form_tolerance));
  }
  const double sum = judgement.weights.sum();
  out.mean /= sum;
  out.covariance += second - out.mean * out.mean.transpose();
  out.covariance.diagonal().array() += 1e-24; // so that it has a root without any noise too
  return out;
}

/// Observables that were held out, as runs of one model give them: the mean, as surely as they scatter.
/// \param runs each with these observables, as they are compared
/// \throws Error for less than two runs
inline HeldOutPrediction mean_of_runs(const Noise& noise, const std::vector<Eigen::VectorXd>& runs) {
  require("runs of what was held out", static_cast<double>(runs.size()), {2.0, 1e9});
  const auto count = static_cast<double>(runs.size());
  const Eigen::Index m = noise.readings().mean.size();
  HeldOutPrediction out{Eigen::VectorXd::Zero(m), Eigen::MatrixXd::Zero(m, m)};
  for (const Eigen::VectorXd& run : runs) {
    out.mean += run / count;
  }
  Eigen::VectorXd squares = Eigen::VectorXd::Zero(m);
  for (const Eigen::VectorXd& run : runs) {
    squares += (run - out.mean).cwiseAbs2();
  }
  const Eigen::VectorXd error = (squares / (count * (count - 1.0))).cwiseSqrt();
  for (const Noise::Group& group : noise.groups()) {
    const Eigen::VectorXd of_group = error(group.members);
    out.covariance(group.members, group.members) =
        group.correlation.cwiseProduct(of_group * of_group.transpose());
  }
  out.covariance.diagonal().array() += 1e-24; // so that it has a root without any scatter too
  return out;
}

/// Natural logarithm of the probability density with which readings were predicted, but for a constant:
/// multivariate Student, as their variances are estimates.
inline double log_density(const Noise& noise, const HeldOutPrediction& prediction) {
  const Readings& seen = noise.readings();
  Eigen::MatrixXd scale = prediction.covariance;
  double freedom = HUGE_VAL;
  for (const Noise::Group& group : noise.groups()) {
    const Eigen::VectorXd error = seen.variance(group.members).cwiseSqrt();
    scale(group.members, group.members) += group.correlation.cwiseProduct(error * error.transpose());
    freedom = std::min(freedom, group.freedom);
  }
  const Eigen::LLT<Eigen::MatrixXd> factor{scale};
  const Eigen::VectorXd off = seen.mean - prediction.mean;
  return -factor.matrixLLT().diagonal().array().log().sum() -
         0.5 * (freedom + static_cast<double>(off.size())) * std::log1p(off.dot(factor.solve(off)) / freedom);
}

/// What an extended model gains over the base model on held-out data.
struct Gain {
  /// Root mean square of predicted less measured, over the standard error of what was measured.
  double before = 0.0, after = 0.0;
  double share = 0.0;           ///< by which the error is smaller: 1 - after / before
  double low = 0.0, high = 0.0; ///< interval of that
};

/// What a hypothesis gains there with all that is not known of its parameters, so that chance can be spoken
/// of.
struct HeldOutGain {
  Gain gain;
  double p = 1.0;                                    ///< by which chance explains what is left
  double log_odds = 0.0;                             ///< natural logarithm of the odds over the base model
  Eigen::VectorXd residuals_before, residuals_after; ///< of each observable, over the same
};

/// \param noise of the held-out observables
inline HeldOutGain held_out_gain(const Noise& noise, const HeldOutPrediction& base,
                                 const HeldOutPrediction& extended, double confidence, std::size_t draws,
                                 Random& random) {
  const Readings& seen = noise.readings();
  const Eigen::ArrayXd error = seen.variance.array().sqrt();
  HeldOutGain out;
  out.residuals_before = ((seen.mean - base.mean).array() / error).matrix();
  out.residuals_after = ((seen.mean - extended.mean).array() / error).matrix();
  const auto rms = [](const Eigen::VectorXd& v) {
    return v.norm() / std::sqrt(static_cast<double>(v.size()));
  };
  const auto share = [&](const Eigen::VectorXd& before, const Eigen::VectorXd& after) {
    return 1.0 - rms(after) / std::max(1e-12, rms(before));
  };
  out.gain.before = rms(out.residuals_before);
  out.gain.after = rms(out.residuals_after);
  out.gain.share = share(out.residuals_before, out.residuals_after);

  // Whatever both sides know only roughly is drawn again: the measured means, and the predictions. What was
  // measured is off by chance already, and would be so twice if it were drawn about itself: it is drawn about
  // where it lies when as much of its distance from the better prediction is taken off as chance makes
  // (James & Stein 1961).
  const HeldOutPrediction& better = out.gain.after < out.gain.before ? extended : base;
  const Eigen::VectorXd off = seen.mean - better.mean;
  const double chance =
      static_cast<double>(off.size()) + (better.covariance.diagonal().array() / seen.variance.array()).sum();
  const double seen_squares = (off.array().square() / seen.variance.array()).sum();
  const Eigen::VectorXd centre =
      better.mean + off * std::sqrt(std::max(0.0, 1.0 - chance / std::max(1e-12, seen_squares)));
  const Eigen::MatrixXd root_base = Eigen::LLT<Eigen::MatrixXd>{base.covariance}.matrixL();
  const Eigen::MatrixXd root_extended = Eigen::LLT<Eigen::MatrixXd>{extended.covariance}.matrixL();
  const auto even = [&] {
    Eigen::VectorXd z(error.size());
    for (double& x : z) {
      x = random.normal();
    }
    return z;
  };
  std::vector<double> shares, left;
  for (std::size_t d = 0; d < draws; ++d) {
    const Eigen::VectorXd measured = centre + noise.normal(seen.variance, random);
    const Eigen::VectorXd of_base = base.mean + root_base * even();
    const Eigen::VectorXd of_extended = extended.mean + root_extended * even();
    shares.push_back(share(((measured - of_base).array() / error).matrix(),
                           ((measured - of_extended).array() / error).matrix()));
    const Readings again = noise.drawn(of_extended, random);
    left.push_back(rms(((again.mean - extended.mean).array() / again.variance.array().sqrt()).matrix()));
  }
  std::sort(shares.begin(), shares.end());
  const auto at = [&](double quantile) {
    return shares[static_cast<std::size_t>(quantile * static_cast<double>(shares.size() - 1))];
  };
  out.gain.low = at(0.5 * (1.0 - confidence));
  out.gain.high = at(0.5 * (1.0 + confidence));
  out.p = share_above(left, out.gain.after);
  out.log_odds = log_density(noise, extended) - log_density(noise, base);
  return out;
}

} // namespace scree
