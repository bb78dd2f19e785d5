#pragma once
/// \file
/// A smooth surface through noisy numbers.

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace scree {

/// Universal kriging: a plane, plus a Gaussian process that wanders from it, plus the noise of single runs
/// (Rasmussen & Williams, Gaussian Processes for Machine Learning, 2006, section 2.7).
class Kriging {
public:
  /// \param at a row for each run, a column for each coordinate; they do not lie on a plane
  /// \param observed of each run
  /// \param length over which the process wanders, in the unit of the coordinates, above 0
  /// \param ratio standard deviation of the process over that of the noise, 0 or above
  Kriging(const Eigen::MatrixXd& at, const Eigen::VectorXd& observed, double length, double ratio)
      : length_{length}, ratio2_{ratio * ratio} {
    const Eigen::Index n = at.rows(), terms = at.cols() + 1;
    plane_.resize(n, terms);
    plane_ << Eigen::VectorXd::Ones(n), at;
    Eigen::MatrixXd covariance = Eigen::MatrixXd::Identity(n, n);
    for (Eigen::Index i = 0; i < n; ++i) {
      covariance.col(i) += process(at, at.row(i).transpose());
    }
    const Eigen::LLT<Eigen::MatrixXd> factor{covariance};
    inverse_ = factor.solve(Eigen::MatrixXd::Identity(n, n));
    const Eigen::MatrixXd across = inverse_ * plane_;
    const Eigen::LDLT<Eigen::MatrixXd> information{plane_.transpose() * across};
    of_plane_ = information.solve(Eigen::MatrixXd::Identity(terms, terms));
    without_plane_ = inverse_ - across * of_plane_ * across.transpose();
    trend_ = of_plane_ * (across.transpose() * observed);
    left_ = without_plane_ * observed;
    const auto freedom = static_cast<double>(n - terms);
    noise_ = std::max(1e-300, observed.dot(left_) / freedom);
    log_likelihood_ = -factor.matrixLLT().diagonal().array().log().sum() -
                      0.5 * information.vectorD().array().abs().log().sum() -
                      0.5 * freedom * std::log(noise_);
  }

  /// Restricted to what the plane leaves, with the noise that suits best, but for a constant.
  [[nodiscard]] double log_likelihood() const { return log_likelihood_; }
  /// Variance of single runs.
  [[nodiscard]] double noise() const { return noise_; }
  /// How many numbers the runs are described with.
  [[nodiscard]] double numbers() const {
    return static_cast<double>(inverse_.rows()) - without_plane_.trace();
  }

  struct Prediction {
    double mean = 0.0, variance = 0.0; ///< of the mean
  };
  /// \param at as given to the constructor
  [[nodiscard]] Prediction predicted(const Eigen::MatrixXd& at, const Eigen::VectorXd& there) const {
    const Eigen::VectorXd shared = process(at, there);
    Eigen::VectorXd basis(there.size() + 1);
    basis << 1.0, there;
    const Eigen::VectorXd weights = inverse_ * shared;
    const Eigen::VectorXd rest = basis - plane_.transpose() * weights;
    return {basis.dot(trend_) + shared.dot(left_),
            noise_ * std::max(0.0, ratio2_ - shared.dot(weights) + rest.dot(of_plane_ * rest))};
  }

  /// Of the mean, along each coordinate.
  [[nodiscard]] Eigen::VectorXd slope(const Eigen::MatrixXd& at, const Eigen::VectorXd& there) const {
    const Eigen::VectorXd pull = process(at, there).cwiseProduct(left_) / (length_ * length_);
    return trend_.tail(there.size()) + at.transpose() * pull - pull.sum() * there;
  }

  /// Of each run from what all others say of it, in units of its standard deviation.
  [[nodiscard]] Eigen::VectorXd left_out() const {
    return (left_.array() / (without_plane_.diagonal().array() * noise_).max(1e-300).sqrt()).matrix();
  }

private:
  /// Covariance of the process with that at one place, over the variance of the noise.
  [[nodiscard]] Eigen::VectorXd process(const Eigen::MatrixXd& at, const Eigen::VectorXd& there) const {
    const Eigen::VectorXd distance2 = (at.rowwise() - there.transpose()).rowwise().squaredNorm();
    return (ratio2_ * (distance2 * (-0.5 / (length_ * length_))).array().exp()).matrix();
  }

  double length_, ratio2_;
  Eigen::MatrixXd plane_, inverse_, of_plane_, without_plane_;
  Eigen::VectorXd trend_, left_;
  double noise_ = 0.0, log_likelihood_ = 0.0;
};

} // namespace scree
