#pragma once
/// \file
/// A smooth surface through noisy numbers.

#include "scree/calibrate/effects_kernel.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

namespace scree {

/// Universal kriging: a plane, plus a Gaussian process that wanders from it, plus the noise of single runs
/// (Rasmussen & Williams, Gaussian Processes for Machine Learning, 2006, section 2.7). This is all of it that
/// does not depend on what the runs gave, so several observables of the same runs share it.
class KrigingFrame {
public:
  /// \param at a row for each run, a column for each coordinate; they do not lie on a plane
  /// \param null of coordinates that are effects, the last ones
  KrigingFrame(const Eigen::MatrixXd& at, EffectsKernel::Shape shape, const Eigen::VectorXd& null)
      : process_{shape, null, at} {
    const Eigen::Index n = at.rows(), terms = at.cols() + 1;
    plane_.resize(n, terms);
    plane_ << Eigen::VectorXd::Ones(n), at;
    const Eigen::MatrixXd places = at.transpose(); // whose columns are there even where no coordinate is
    Eigen::MatrixXd covariance = Eigen::MatrixXd::Identity(n, n);
    for (Eigen::Index i = 0; i < n; ++i) {
      covariance.col(i) += process_.covariance(places.col(i));
    }
    const Eigen::LLT<Eigen::MatrixXd> factor{covariance};
    inverse_ = factor.solve(Eigen::MatrixXd::Identity(n, n));
    const Eigen::MatrixXd across = inverse_ * plane_;
    const Eigen::LDLT<Eigen::MatrixXd> information{plane_.transpose() * across};
    of_plane_ = information.solve(Eigen::MatrixXd::Identity(terms, terms));
    to_trend_ = of_plane_ * across.transpose();
    without_plane_ = inverse_ - across * to_trend_;
    log_determinants_ = -factor.matrixLLT().diagonal().array().log().sum() -
                        0.5 * information.vectorD().array().abs().log().sum();
  }

  /// How many numbers the runs are described with.
  [[nodiscard]] double numbers() const {
    return static_cast<double>(inverse_.rows()) - without_plane_.trace();
  }

  /// A place, as seen from the runs.
  struct Place {
    Eigen::VectorXd basis;  ///< of the plane
    Eigen::VectorXd shared; ///< covariance with each run, over the variance of the noise
    double alone;           ///< variance of the process there, over that of the noise
  };
  [[nodiscard]] Place place(const Eigen::VectorXd& there) const {
    Place out{Eigen::VectorXd(there.size() + 1), process_.covariance(there), process_.variance(there)};
    out.basis << 1.0, there;
    return out;
  }
  /// Of the mean there, over the variance of the noise.
  [[nodiscard]] double variance(const Place& place) const {
    const Eigen::VectorXd weights = inverse_.selfadjointView<Eigen::Lower>() * place.shared;
    const Eigen::VectorXd rest = place.basis - plane_.transpose() * weights;
    return std::max(0.0, place.alone - place.shared.dot(weights) + rest.dot(of_plane_ * rest));
  }

  /// Runs by coordinates: change of what the place shares with each run, along some of the coordinates.
  [[nodiscard]] Eigen::MatrixXd slopes(const Eigen::VectorXd& there,
                                       std::span<const Eigen::Index> along) const {
    return process_.slopes(there, along);
  }

private:
  friend class Kriging;

  EffectsKernel process_;
  Eigen::MatrixXd plane_, inverse_, of_plane_, to_trend_, without_plane_;
  double log_determinants_ = 0.0;
};

/// What runs gave of one observable, as a surface on their frame.
class Kriging {
public:
  Kriging(const KrigingFrame& frame, const Eigen::VectorXd& observed)
      : trend_{frame.to_trend_ * observed}, left_{frame.without_plane_ * observed} {
    const auto freedom = static_cast<double>(observed.size() - trend_.size());
    noise_ = std::max(1e-300, observed.dot(left_) / freedom);
    log_likelihood_ = frame.log_determinants_ - 0.5 * freedom * std::log(noise_);
  }

  /// Restricted to what the plane leaves, with the noise that suits best, but for a constant.
  [[nodiscard]] double log_likelihood() const { return log_likelihood_; }
  /// Variance of single runs.
  [[nodiscard]] double noise() const { return noise_; }

  [[nodiscard]] double mean(const KrigingFrame::Place& place) const {
    return place.basis.dot(trend_) + place.shared.dot(left_);
  }

  /// Of the mean, along some of the coordinates. \param shared `KrigingFrame::slopes` of the place
  [[nodiscard]] Eigen::VectorXd slope(const Eigen::MatrixXd& shared,
                                      std::span<const Eigen::Index> along) const {
    Eigen::VectorXd out = shared.transpose() * left_;
    for (std::size_t a = 0; a < along.size(); ++a) {
      out[static_cast<Eigen::Index>(a)] += trend_[1 + along[a]];
    }
    return out;
  }

  /// Of each run from what all others say of it, in units of its standard deviation.
  [[nodiscard]] Eigen::VectorXd left_out(const KrigingFrame& frame) const {
    return (left_.array() / (frame.without_plane_.diagonal().array() * noise_).max(1e-300).sqrt()).matrix();
  }

private:
  Eigen::VectorXd trend_, left_;
  double noise_ = 0.0, log_likelihood_ = 0.0;
};

} // namespace scree
