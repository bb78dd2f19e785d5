#pragma once
/// \file
/// How observables answer to parameters near a point: weighted polynomials through noisy runs.

#include "scree/core/error.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace scree {

/// One run: where in the parameters' shares, and what came out, as it is compared.
struct Run {
  Eigen::VectorXd at;
  Eigen::VectorXd observed;
};

/// For each observable a polynomial in the shares about a centre: linear, or with squares and products where
/// enough runs are near. Runs count less the farther they are (tricube weights, Cleveland 1979), and not at
/// all beyond the reach.
class LocalResponse {
public:
  /// \param runs at least one more than there are parameters within the reach
  /// \param reach in shares, above 0, along any parameter
  /// \throws Error where too few runs are within the reach.
  LocalResponse(const std::vector<Run>& runs, const Eigen::VectorXd& centre, double reach)
      : centre_{centre}, reach_{reach} {
    std::vector<const Run*> near;
    std::vector<double> weights;
    for (const Run& run : runs) {
      const double distance = (run.at - centre).cwiseAbs().maxCoeff() / reach;
      if (distance < 1.0) {
        near.push_back(&run);
        weights.push_back(std::pow(1.0 - std::pow(distance, 3), 3));
      }
    }
    const auto n = static_cast<Eigen::Index>(near.size());
    const Eigen::Index p = centre.size();
    // Half as many runs again as numbers to find keep the noise of a polynomial from running away.
    curved_ = 2 * n >= 3 * terms(p, true);
    if (n < terms(p, false) + 1) {
      throw Error(message("calibration: ", n, " runs came to an end near the estimate, too few for ", p,
                          " parameters"));
    }
    const Eigen::Index m = near.front()->observed.size(), t = terms(p, curved_);
    Eigen::MatrixXd x(n, t), y(n, m);
    Eigen::VectorXd w(n);
    for (Eigen::Index r = 0; r < n; ++r) {
      const auto k = static_cast<std::size_t>(r);
      x.row(r) = basis(near[k]->at).transpose();
      y.row(r) = near[k]->observed.transpose();
      w[r] = weights[k];
    }
    const Eigen::MatrixXd xw = x.transpose() * w.asDiagonal();
    // A trace of ridge, so that runs on a line leave no infinite slopes across it.
    const Eigen::MatrixXd normal = xw * x + 1e-9 * Eigen::MatrixXd::Identity(t, t);
    const Eigen::LDLT<Eigen::MatrixXd> solver{normal};
    coefficients_ = solver.solve(xw * y);
    // Of the mean of weighted runs: the sandwich, as their noise is alike while their weights are not.
    spread_ = solver.solve(xw * w.asDiagonal() * x) * solver.solve(Eigen::MatrixXd::Identity(t, t));
    const Eigen::MatrixXd misfit = y - x * coefficients_;
    const double total = w.sum(), lost = (solver.solve(xw * w.asDiagonal() * x)).trace();
    freedom_ = std::max(1.0, total * total / w.squaredNorm() - static_cast<double>(t));
    noise_ = misfit.transpose() * w.asDiagonal() * misfit / std::max(1e-300, total - lost);
  }

  [[nodiscard]] bool curved() const { return curved_; }
  /// Degrees of freedom of the noise.
  [[nodiscard]] double freedom() const { return freedom_; }
  /// Covariance of the observables of single runs.
  [[nodiscard]] const Eigen::MatrixXd& noise() const { return noise_; }

  [[nodiscard]] Eigen::VectorXd predicted(const Eigen::VectorXd& at) const {
    return coefficients_.transpose() * basis(at);
  }
  /// Covariance of the prediction of the mean.
  [[nodiscard]] Eigen::MatrixXd uncertainty(const Eigen::VectorXd& at) const {
    const Eigen::VectorXd b = basis(at);
    return b.dot(spread_ * b) * noise_;
  }
  /// Observables by parameters: change per share.
  [[nodiscard]] Eigen::MatrixXd slopes(const Eigen::VectorXd& at) const {
    const Eigen::Index p = centre_.size();
    Eigen::MatrixXd out(coefficients_.cols(), p);
    for (Eigen::Index k = 0; k < p; ++k) {
      Eigen::VectorXd ahead = at, behind = at;
      const double step = 0.01 * reach_; // exact for a polynomial of second order
      ahead[k] += step;
      behind[k] -= step;
      out.col(k) = (predicted(ahead) - predicted(behind)) / (2.0 * step);
    }
    return out;
  }

private:
  static Eigen::Index terms(Eigen::Index p, bool curved) { return curved ? 1 + p + p * (p + 1) / 2 : 1 + p; }
  [[nodiscard]] Eigen::VectorXd basis(const Eigen::VectorXd& at) const {
    const Eigen::VectorXd d = (at - centre_) / reach_;
    const Eigen::Index p = d.size();
    Eigen::VectorXd out(terms(p, curved_));
    out[0] = 1.0;
    out.segment(1, p) = d;
    if (curved_) {
      Eigen::Index k = 1 + p;
      for (Eigen::Index i = 0; i < p; ++i) {
        for (Eigen::Index j = i; j < p; ++j) {
          out[k++] = d[i] * d[j];
        }
      }
    }
    return out;
  }

  Eigen::VectorXd centre_;
  double reach_;
  bool curved_ = false;
  double freedom_ = 1.0;
  Eigen::MatrixXd coefficients_, spread_, noise_;
};

} // namespace scree
