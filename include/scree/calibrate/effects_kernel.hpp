#pragma once
/// \file
/// How far places of a parameter space go together.

#include <Eigen/Core>

#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace scree {

/// Covariance of a Gaussian process over shares of parameters, over the variance of single runs. The last
/// coordinates may be effects, each nothing at a null value of its own: then the process is the product of
/// one over the first coordinates and of 1 + an effect for each of the last, so all places tell of what they
/// share, and those with an effect, of this effect, alone and with others (the idea of ANOVA kernels:
/// Durrande, Ginsbourger, Roustant & Carraro, J. Multivariate Analysis 115, 57, 2013).
class EffectsKernel {
public:
  /// Lengths are in shares.
  struct Shape {
    double length;              ///< over which the process bends along the first coordinates, above 0
    double ratio;               ///< standard deviation of the process over that of single runs, 0 or above
    double effect_length = 1.0; ///< over which an effect bends along its own coordinate, above 0
    double strength = 0.0;      ///< standard deviation of a full effect over that of the process, 0 or above
  };

  /// \param null of the last coordinates; empty: there are no effects
  /// \param at places, a row each
  EffectsKernel(Shape shape, const Eigen::VectorXd& null, const Eigen::MatrixXd& at)
      : shape_{shape}, first_{at.leftCols(at.cols() - null.size())} {
    for (Eigen::Index c = 0; c < null.size(); ++c) {
      Effect effect{.null = null[c]};
      for (Eigen::Index row = 0; row < at.rows(); ++row) {
        if (const double from_null = at(row, first_.cols() + c) - null[c]; from_null != 0.0) {
          effect.active.push_back({row, from_null, bell(from_null)});
        }
      }
      effects_.push_back(std::move(effect));
    }
  }

  /// Of the process at one place.
  [[nodiscard]] double variance(const Eigen::VectorXd& there) const {
    double out = shape_.ratio * shape_.ratio;
    for (std::size_t c = 0; c < effects_.size(); ++c) {
      const double u = from_null(there, c);
      out *= factor(u, bell(u), u, bell(u));
    }
    return out;
  }
  /// Of each of the places with `there`.
  [[nodiscard]] Eigen::VectorXd covariance(const Eigen::VectorXd& there) const {
    return without(effects_.size(), there);
  }
  /// Places by coordinates: change of the covariance along some of the coordinates of `there`.
  [[nodiscard]] Eigen::MatrixXd slopes(const Eigen::VectorXd& there,
                                       std::span<const Eigen::Index> along) const {
    Eigen::MatrixXd out = Eigen::MatrixXd::Zero(first_.rows(), static_cast<Eigen::Index>(along.size()));
    const Eigen::VectorXd all = covariance(there);
    for (std::size_t a = 0; a < along.size(); ++a) {
      auto column = out.col(static_cast<Eigen::Index>(a));
      if (const Eigen::Index k = along[a]; k < first_.cols()) {
        column =
            all.cwiseProduct((first_.col(k).array() - there[k]).matrix()) / (shape_.length * shape_.length);
      } else {
        add_slope(static_cast<std::size_t>(k - first_.cols()), there, all, column);
      }
    }
    return out;
  }

private:
  struct Active {
    Eigen::Index row;
    double from_null;
    double bell; ///< of that
  };
  struct Effect {
    double null;
    std::vector<Active> active{}; ///< places where it is not nothing
  };

  [[nodiscard]] double from_null(const Eigen::VectorXd& there, std::size_t effect) const {
    return there[first_.cols() + static_cast<Eigen::Index>(effect)] - effects_[effect].null;
  }
  [[nodiscard]] double bell(double x) const {
    const double in_lengths = x / shape_.effect_length;
    return std::exp(-0.5 * in_lengths * in_lengths);
  }
  /// By which an effect multiplies the covariance of two places, so far from its null value.
  [[nodiscard]] double factor(double u, double bell_u, double v, double bell_v) const {
    return 1.0 + shape_.strength * shape_.strength * (bell(v - u) - bell_v * bell_u);
  }

  /// Along one effect, into a column of zeros. \param all the covariance
  void add_slope(std::size_t effect, const Eigen::VectorXd& there, const Eigen::VectorXd& all,
                 Eigen::Ref<Eigen::VectorXd> column) const {
    const double strength = shape_.strength / shape_.effect_length;
    const double u = from_null(there, effect), bell_u = bell(u);
    const Eigen::VectorXd others = u == 0.0 ? all : without(effect, there);
    for (const auto& [row, v, bell_v] : effects_[effect].active) {
      const double between = u == 0.0 ? bell_v : bell(v - u); // most effects are null, and known already
      column[row] = strength * strength * ((v - u) * between + u * bell_v * bell_u) * others[row];
    }
  }

  /// The covariance without the factor of one effect.
  [[nodiscard]] Eigen::VectorXd without(std::size_t left_out, const Eigen::VectorXd& there) const {
    // Coordinate by coordinate: there may be none, and then the places have no storage to point into.
    Eigen::VectorXd distance2 = Eigen::VectorXd::Zero(first_.rows());
    for (Eigen::Index k = 0; k < first_.cols(); ++k) {
      distance2.array() += (first_.col(k).array() - there[k]).square();
    }
    Eigen::VectorXd out =
        shape_.ratio * shape_.ratio * (distance2.array() * (-0.5 / (shape_.length * shape_.length))).exp();
    for (std::size_t c = 0; c < effects_.size(); ++c) {
      if (const double u = from_null(there, c); u != 0.0 && c != left_out) {
        const double bell_u = bell(u);
        for (const auto& [row, v, bell_v] : effects_[c].active) {
          out[row] *= factor(u, bell_u, v, bell_v);
        }
      }
    }
    return out;
  }

  Shape shape_;
  Eigen::MatrixXd first_; // coordinates of the places
  std::vector<Effect> effects_;
};

} // namespace scree
