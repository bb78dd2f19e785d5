#pragma once
/// \file
/// A few causes that may act together, and how well readings speak for them.

#include "scree/calibrate/posterior.hpp"
#include "scree/diagnose/cause.hpp"
#include "scree/diagnose/local_model.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace scree {

/// What readings say of a hypothesis.
struct Judgement {
  double log_evidence = 0.0; ///< with all parameters integrated over their prior
  double deviance = 0.0;     ///< at the best point
  std::size_t best = 0;      ///< point with the greatest share of the evidence
  Eigen::VectorXd weights;   ///< of the points, sum 1
};

/// The base model with some causes free, or none. It is straightened in the base parameters, but not in
/// those of the causes: these stand on a grid, denser around what suits the measured data and around null,
/// and at each point of it the base parameters are near those that suit best then. The same grid judges the
/// measured data and data that are drawn again.
class Hypothesis {
public:
  struct Point {
    Eigen::VectorXd shares;  ///< of the causes' parameters
    double log_weight = 0.0; ///< of the even prior over their ranges
    LocalModel local;
  };

  /// What suits the measured data best, all free parameters at once, and how surely they are known.
  struct Suitable {
    Eigen::VectorXd at, width; ///< shares of the whole space
  };

  /// \param start base parameters that are about right, in shares
  static Suitable most_suitable(const ModelSpace& space, const std::vector<std::size_t>& causes,
                                std::span<const Measured> measured, const ResponseSurface& response,
                                const Eigen::VectorXd& start) {
    Eigen::VectorXd from = space.null();
    from.head(space.base()) = start;
    return most_suitable(space.parameters_of(causes), measured, response, prior_of(space, causes), from);
  }

  /// \param suitable of the same causes
  Hypothesis(const ModelSpace& space, std::vector<std::size_t> causes, std::span<const Measured> measured,
             const ResponseSurface& response, const Suitable& suitable, double form_tolerance)
      : causes_{std::move(causes)}, free_{space.parameters_of(causes_)} {
    const Eigen::VectorXd null = space.null();
    const auto& [best, width] = suitable;
    std::vector<std::vector<double>> axes;
    for (const Eigen::Index k : free_) {
      axes.push_back(axis(best[k], width[k], null[k], free_.size()));
    }
    std::vector<std::size_t> at(free_.size(), 0);
    while (true) {
      Eigen::VectorXd shares(static_cast<Eigen::Index>(free_.size()));
      double log_weight = 0.0;
      for (std::size_t a = 0; a < free_.size(); ++a) {
        shares[static_cast<Eigen::Index>(a)] = axes[a][at[a]];
        log_weight += std::log(span_of(axes[a], at[a]));
      }
      // A neighbour's base parameters are near, mostly.
      const Eigen::VectorXd near = points_.empty() ? best.head(space.base()) : points_.back().local.base;
      Point point = point_at(space, measured, response, std::move(shares), near, form_tolerance);
      point.log_weight = log_weight;
      points_.push_back(std::move(point));
      std::size_t a = 0;
      while (a < free_.size() && ++at[a] == axes[a].size()) {
        at[a++] = 0;
      }
      if (a == free_.size()) {
        break;
      }
    }
  }

  /// Any point, with the base parameters that suit the measured data best there; without a weight.
  /// \param shares of the causes' parameters
  /// \param near base parameters that are about right, in shares
  [[nodiscard]] Point point_at(const ModelSpace& space, std::span<const Measured> measured,
                               const ResponseSurface& response, Eigen::VectorXd shares,
                               const Eigen::VectorXd& near, double form_tolerance) const {
    Prior fixed = prior_of(space, causes_);
    Eigen::VectorXd from(space.size());
    from << near, space.null().tail(space.size() - space.base());
    for (std::size_t a = 0; a < free_.size(); ++a) {
      const double share = shares[static_cast<Eigen::Index>(a)];
      fixed.fix(free_[a], share);
      from[free_[a]] = share;
    }
    LocalModel local =
        local_at(space, nearly_most_probable(measured, response, fixed, from), response, form_tolerance);
    return {std::move(shares), 0.0, std::move(local)};
  }

  /// Numbers of the causes; none: the base model.
  [[nodiscard]] const std::vector<std::size_t>& causes() const { return causes_; }
  /// Places of the causes' parameters in the space.
  [[nodiscard]] const std::vector<Eigen::Index>& free() const { return free_; }
  [[nodiscard]] const std::vector<Point>& points() const { return points_; }

  /// \param base prior of the base parameters
  [[nodiscard]] Judgement judge(const Noise& noise, const Readings& readings, const Prior& base) const {
    const auto n = static_cast<Eigen::Index>(points_.size());
    Judgement out{.weights = Eigen::VectorXd(n)};
    Eigen::VectorXd deviance(n);
    for (Eigen::Index j = 0; j < n; ++j) {
      const Point& point = points_[static_cast<std::size_t>(j)];
      const LocalFit fit = fitted(noise, readings, point.local, base);
      out.weights[j] = point.log_weight + fit.log_evidence;
      deviance[j] = fit.deviance;
    }
    const double most = out.weights.maxCoeff();
    out.weights = (out.weights.array() - most).exp();
    out.log_evidence = most + std::log(out.weights.sum());
    out.weights /= out.weights.sum();
    Eigen::Index best = 0;
    out.deviance = deviance.minCoeff(&best);
    out.best = static_cast<std::size_t>(best);
    return out;
  }

  /// The share below which `probability` of one of the causes' parameters lies.
  [[nodiscard]] double quantile(const Judgement& judgement, std::size_t parameter, double probability) const {
    // Density at the values of the axis, straight in between.
    std::vector<std::pair<double, double>> mass;
    for (std::size_t j = 0; j < points_.size(); ++j) {
      mass.emplace_back(points_[j].shares[static_cast<Eigen::Index>(parameter)],
                        judgement.weights[static_cast<Eigen::Index>(j)]);
    }
    std::sort(mass.begin(), mass.end());
    std::vector<double> axis, density;
    for (const auto& [share, weight] : mass) {
      if (axis.empty() || share > axis.back()) {
        axis.push_back(share);
        density.push_back(0.0);
      }
      density.back() += weight;
    }
    for (std::size_t k = 0; k < axis.size(); ++k) {
      density[k] /= span_of(axis, k);
    }
    std::vector<double> below{0.0};
    for (std::size_t k = 1; k < axis.size(); ++k) {
      below.push_back(below.back() + 0.5 * (density[k] + density[k - 1]) * (axis[k] - axis[k - 1]));
    }
    const double wanted = probability * below.back();
    for (std::size_t k = 1; k < axis.size(); ++k) {
      if (below[k] >= wanted) {
        // The parabola of a straight density, by the share of the area.
        const double step = axis[k] - axis[k - 1], a = density[k - 1], slope = (density[k] - a) / step;
        const double area = wanted - below[k - 1];
        const double root = std::sqrt(std::max(0.0, a * a + 2.0 * slope * area));
        return axis[k - 1] + (a + root > 0.0 ? std::clamp(2.0 * area / (a + root), 0.0, step) : 0.0);
      }
    }
    return axis.back();
  }

  /// The model at one point of the space, in shares.
  static LocalModel local_at(const ModelSpace& space, const Eigen::VectorXd& at,
                             const ResponseSurface& response, double form_tolerance) {
    const auto [mean, variance] = response.predicted(at);
    return {at.head(space.base()), mean, variance + form_variance(space, at, mean, response, form_tolerance),
            response.slopes(at, space.base())};
  }

  /// What `form_tolerance` (`DiagnosisSetup`) makes of the variances of what is simulated at one point.
  /// \param mean of each observable there
  static Eigen::VectorXd form_variance(const ModelSpace& space, const Eigen::VectorXd& at,
                                       const Eigen::VectorXd& mean, const ResponseSurface& response,
                                       double form_tolerance) {
    Eigen::VectorXd without = space.null();
    without.head(space.base()) = at.head(space.base());
    return (form_tolerance * (mean - response.mean(without))).cwiseAbs2();
  }

private:
  /// All other causes are null.
  static Prior prior_of(const ModelSpace& space, const std::vector<std::size_t>& causes) {
    const std::vector<Eigen::Index> free = space.parameters_of(causes);
    Prior prior = Prior::even(space.size());
    const Eigen::VectorXd null = space.null();
    for (Eigen::Index k = space.base(); k < space.size(); ++k) {
      if (std::find(free.begin(), free.end(), k) == free.end()) {
        prior.fix(k, null[k]);
      }
    }
    return prior;
  }

  /// The most probable of all free parameters, from several starts.
  static Suitable most_suitable(const std::vector<Eigen::Index>& free, std::span<const Measured> measured,
                                const ResponseSurface& response, const Prior& prior,
                                const Eigen::VectorXd& from) {
    std::vector<double> starts{0.15, 0.5, 0.85};
    if (free.empty()) {
      starts = {0.5}; // of nothing
    }
    Suitable out;
    double least = HUGE_VAL;
    const auto attempt = [&](const Eigen::VectorXd& start) {
      const Eigen::VectorXd there = nearly_most_probable(measured, response, prior, start);
      const Eigen::VectorXd at = nearly_most_probable(measured, response, prior, there);
      const Posterior posterior{measured, response, prior, at};
      const double misfit = posterior.misfit();
      if (misfit < least) {
        least = misfit;
        out = {at, posterior.covariance().diagonal().cwiseSqrt()};
      }
    };
    for (const double first : starts) {
      Eigen::VectorXd start = from;
      if (!free.empty()) {
        start[free[0]] = first;
      }
      for (const double second : starts) {
        if (free.size() > 1) {
          start[free[1]] = second;
        }
        attempt(start);
        if (free.size() < 2) {
          break;
        }
      }
    }
    return out;
  }

  /// Values of one parameter, ascending from 0 to 1.
  /// \param axes of the grid: the more there are, the coarser is each
  static std::vector<double> axis(double best, double width, double null, std::size_t axes) {
    std::vector<double> out{0.0, 1.0, null, best};
    if (axes < 3) {
      out.push_back(0.5);
    }
    for (const double aside : axes > 2   ? std::vector{1.5}
                              : axes > 1 ? std::vector{1.0, 2.0}
                                         : std::vector{0.5, 1.0, 1.5, 2.0, 3.0}) {
      out.push_back(best + aside * width);
      out.push_back(best - aside * width);
    }
    if (axes == 1) {
      for (const double aside : {0.25, 0.75}) {
        out.push_back(aside);
      }
      for (const double aside : {1.0, 2.0}) {
        out.push_back(null + aside * width);
        out.push_back(null - aside * width);
      }
    }
    for (double& share : out) {
      share = std::clamp(share, 0.0, 1.0);
    }
    std::sort(out.begin(), out.end());
    std::vector<double> apart;
    for (const double share : out) {
      if (apart.empty() || share > apart.back() + 0.2 * std::min(width, 0.1)) {
        apart.push_back(share);
      }
    }
    apart.back() = 1.0;
    return apart;
  }
  /// How much of an axis one of its values stands for.
  static double span_of(const std::vector<double>& axis, std::size_t k) {
    const double before = k == 0 ? axis[k] : axis[k - 1];
    const double after = k + 1 == axis.size() ? axis[k] : axis[k + 1];
    return 0.5 * (after - before);
  }

  std::vector<std::size_t> causes_;
  std::vector<Eigen::Index> free_;
  std::vector<Point> points_;
};

} // namespace scree
