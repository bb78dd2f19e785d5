#pragma once
/// \file
/// How observables answer to parameters: kriging through noisy runs.

#include "scree/calibrate/kriging.hpp"
#include "scree/core/error.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace scree {

/// One run: where in the parameters' shares, and what came out, as it is compared. What the run did not show
/// is not a number.
struct Run {
  Eigen::VectorXd at;
  Eigen::VectorXd observed;
};

/// For each observable, a surface over the parameters' shares. How far it bends and how much runs scatter is
/// averaged over many pairs of length and ratio, each counting as much as the runs speak for it, so few runs
/// give a plane and many runs any smooth shape.
class ResponseSurface {
public:
  /// \param runs for each observable, at least three more that show it than there are parameters
  /// \throws Error for too few runs.
  explicit ResponseSurface(const std::vector<Run>& runs) {
    const Eigen::Index parameters = runs.empty() ? 0 : runs.front().at.size();
    const Eigen::Index m = runs.empty() ? 0 : runs.front().observed.size();
    const auto n = static_cast<Eigen::Index>(runs.size());
    require_enough(n, parameters);
    noise_.resize(m);
    freedom_ = static_cast<double>(n - parameters - 1);
    Eigen::MatrixXd left_out = Eigen::MatrixXd::Zero(n, m); // 0 where a run does not show the observable
    for (Eigen::Index k = 0; k < m; ++k) {
      std::vector<Eigen::Index> shown;
      for (Eigen::Index r = 0; r < n; ++r) {
        if (std::isfinite(runs[static_cast<std::size_t>(r)].observed[k])) {
          shown.push_back(r);
        }
      }
      const auto count = static_cast<Eigen::Index>(shown.size());
      require_enough(count, parameters);
      Eigen::MatrixXd at(count, parameters);
      Eigen::VectorXd observed(count);
      for (Eigen::Index r = 0; r < count; ++r) {
        const Run& run = runs[static_cast<std::size_t>(shown[static_cast<std::size_t>(r)])];
        at.row(r) = run.at.transpose();
        observed[r] = run.observed[k];
      }
      surfaces_.push_back({at, likely(at, observed)});
      noise_[k] = averaged(k, [](const Kriging& one) { return one.noise(); });
      const double numbers = averaged(k, [](const Kriging& one) { return one.numbers(); });
      freedom_ = std::min(freedom_, std::max(1.0, static_cast<double>(count) - numbers));
      left_out(shown, k) = surfaces_.back().candidates.front().surface.left_out();
    }
    const Eigen::VectorXd size = left_out.colwise().norm().cwiseMax(1e-300);
    correlation_ = (size.cwiseInverse().asDiagonal() * (left_out.transpose() * left_out) *
                    size.cwiseInverse().asDiagonal());
    correlation_.diagonal().setOnes();
  }

  /// Degrees of freedom of the noise.
  [[nodiscard]] double freedom() const { return freedom_; }
  /// Variance of each observable in single runs.
  [[nodiscard]] const Eigen::VectorXd& noise() const { return noise_; }
  /// Between the observables of single runs.
  [[nodiscard]] const Eigen::MatrixXd& correlation() const { return correlation_; }

  /// Means of the observables, and the variances of these means.
  struct Prediction {
    Eigen::VectorXd mean, variance;
  };
  [[nodiscard]] Prediction predicted(const Eigen::VectorXd& at) const {
    const auto m = static_cast<Eigen::Index>(surfaces_.size());
    Prediction out{Eigen::VectorXd::Zero(m), Eigen::VectorXd::Zero(m)};
    for (Eigen::Index k = 0; k < m; ++k) {
      double square = 0.0;
      const Surface& surface = surfaces_[static_cast<std::size_t>(k)];
      for (const Candidate& c : surface.candidates) {
        const auto [mean, variance] = c.surface.predicted(surface.at, at);
        out.mean[k] += c.weight * mean;
        square += c.weight * mean * mean;
        out.variance[k] += c.weight * variance;
      }
      out.variance[k] += std::max(0.0, square - out.mean[k] * out.mean[k]);
    }
    return out;
  }
  /// Observables by parameters: change per share.
  [[nodiscard]] Eigen::MatrixXd slopes(const Eigen::VectorXd& at) const {
    Eigen::MatrixXd out = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(surfaces_.size()), at.size());
    for (Eigen::Index k = 0; k < out.rows(); ++k) {
      const Surface& surface = surfaces_[static_cast<std::size_t>(k)];
      for (const Candidate& c : surface.candidates) {
        out.row(k) += c.weight * c.surface.slope(surface.at, at).transpose();
      }
    }
    return out;
  }

private:
  struct Candidate {
    Kriging surface;
    double weight;
  };
  /// Of one observable, with the runs that show it, a row each.
  struct Surface {
    Eigen::MatrixXd at;
    std::vector<Candidate> candidates;
  };

  static void require_enough(Eigen::Index runs, Eigen::Index parameters) {
    if (runs < parameters + 3) {
      throw Error(message("response surface: ", runs, " runs came to an end, too few for ", parameters,
                          " parameters"));
    }
  }

  /// The surfaces that the runs speak for, the best first, with weights that sum to 1.
  [[nodiscard]] static std::vector<Candidate> likely(const Eigen::MatrixXd& at,
                                                     const Eigen::VectorXd& observed) {
    static constexpr std::array lengths{0.4, 0.8, 1.6};
    static constexpr std::array ratios{0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 64.0, 256.0};
    std::vector<Candidate> out{{Kriging{at, observed, 1.0, 0.0}, 0.0}}; // a plane
    for (const double length : lengths) {
      for (const double ratio : ratios) {
        out.push_back({Kriging{at, observed, length, ratio}, 0.0});
      }
    }
    const auto better = [](const Candidate& a, const Candidate& b) {
      return a.surface.log_likelihood() > b.surface.log_likelihood();
    };
    std::stable_sort(out.begin(), out.end(), better);
    const double most = out.front().surface.log_likelihood();
    const auto unlikely = [most](const Candidate& c) { return c.surface.log_likelihood() < most - 5.0; };
    out.erase(std::find_if(out.begin(), out.end(), unlikely), out.end());
    double sum = 0.0;
    for (Candidate& c : out) {
      c.weight = std::exp(c.surface.log_likelihood() - most);
      sum += c.weight;
    }
    for (Candidate& c : out) {
      c.weight /= sum;
    }
    return out;
  }

  template <class Of>
  [[nodiscard]] double averaged(Eigen::Index observable, Of of) const {
    double sum = 0.0;
    for (const Candidate& c : surfaces_[static_cast<std::size_t>(observable)].candidates) {
      sum += c.weight * of(c.surface);
    }
    return sum;
  }

  std::vector<Surface> surfaces_;
  Eigen::VectorXd noise_;
  Eigen::MatrixXd correlation_;
  double freedom_ = 1.0;
};

} // namespace scree
