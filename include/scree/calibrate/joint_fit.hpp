#pragma once
/// \file
/// Finds any set of parameters from any set of observables at once.

#include "scree/calibrate/measured.hpp"
#include "scree/calibrate/parameter.hpp"
#include "scree/calibrate/posterior.hpp"
#include "scree/calibrate/response_surface.hpp"
#include "scree/calibrate/run_batch.hpp"
#include "scree/calibrate/run_log.hpp"
#include "scree/core/random.hpp"

#include <boost/math/distributions/students_t.hpp>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace scree {

/// How a joint fit goes about it. All numbers are ours.
struct JointFitSetup {
  std::size_t first_runs = 0;  ///< over the whole space; 0: five for each parameter and five more
  std::size_t batch = 0;       ///< runs of each refinement; 0: four for each parameter
  std::size_t most_runs = 100; ///< in all
  double first_reach = 0.6;    ///< of the first refinement around the estimate, in shares of the space
  double shrink = 0.6;         ///< of the reach from one refinement to the next, in (0, 1)
  double least_signal =
      6.0;                 ///< a batch spreads so far that observables change by this many times their noise
  double confidence = 0.9; ///< of the intervals, in (0, 1)
  /// The fit ends when the simulations' own noise makes no more than this share of each parameter's variance;
  /// 0: all runs are spent.
  double negligible = 0.0;
  std::vector<double>
      precision{}; ///< wanted half-widths of the intervals, in units; none: all runs are spent
  std::uint64_t seed = 1;
};

struct Estimate {
  double value = 0.0;
  double low = 0.0, high = 0.0; ///< interval, within the bounds
  bool at_bound = false;        ///< the data would have the value beyond a bound, as far as runs tell
  bool determined = true;       ///< whether the data narrow it to less than half of its range
  double simulated_share = 0.0; ///< of its variance, that comes from the simulations' own noise
};

struct JointFit {
  std::vector<Estimate> parameters{}; ///< in the order of the space
  Eigen::MatrixXd correlation{};      ///< between the parameters
  /// Directions in the space, in shares, along which the data say next to nothing; columns.
  Eigen::MatrixXd undetermined{};
  double misfit = 0.0;             ///< sum of squared residuals over their variances at the estimate
  std::vector<double> residuals{}; ///< measured less simulated over the standard error of that, by observable
  std::size_t runs = 0, failed = 0;
  std::vector<std::string> failures{}; ///< reasons, each once
};

/// Runs the model over the whole space, then again and again around the best guess so far; in between,
/// surfaces through all runs (kriging) say where measured and simulated agree, weighted by both noises. It
/// needs no derivatives, runs may be noisy, and those that fail are left out and counted. The intervals have
/// the noise of both sides.
class JointCalibration {
public:
  /// \throws Error for a space, observable or setup that makes no sense.
  JointCalibration(std::vector<Parameter> space, std::vector<Measured> measured, JointFitSetup setup = {})
      : space_{std::move(space)}, measured_{std::move(measured)}, setup_{std::move(setup)} {
    if (space_.empty() || measured_.empty()) {
      throw Error("calibration: needs a parameter and an observable at least");
    }
    for (const Parameter& p : space_) {
      p.check();
    }
    for (const Measured& m : measured_) {
      m.check();
    }
    const std::size_t p = space_.size();
    setup_.first_runs = setup_.first_runs == 0 ? 5 * (p + 1) : setup_.first_runs;
    setup_.batch = setup_.batch == 0 ? 4 * p : setup_.batch;
    require("calibration first_runs", static_cast<double>(setup_.first_runs),
            {static_cast<double>(p + 2), 1e9});
    require("calibration most_runs", static_cast<double>(setup_.most_runs),
            {static_cast<double>(setup_.first_runs), 1e9});
    require("calibration first_reach", setup_.first_reach, {0.05, 2.0});
    require("calibration shrink", setup_.shrink, {0.1, 0.99});
    require_positive("calibration least_signal", setup_.least_signal);
    require("calibration confidence", setup_.confidence, {0.01, 0.999});
    require("calibration negligible", setup_.negligible, {0.0, 1.0});
    if (!setup_.precision.empty() && setup_.precision.size() != p) {
      throw Error(
          message("calibration precision: ", setup_.precision.size(), " numbers for ", p, " parameters"));
    }
  }

  /// \throws Error where too few runs come to an end.
  JointFit fit(const RunBatch& batch) {
    Random random{setup_.seed, "calibration"};
    RunLog log{space_, measured_};
    log.make(spread_over_space(random), batch, random);
    Eigen::VectorXd estimate = Eigen::VectorXd::Constant(dimension(), 0.5);
    double reach = setup_.first_reach;
    while (true) {
      const ResponseSurface response{log.runs(), {}, reach_of(space_, measured_)};
      estimate = most_probable(measured_, response, prior_, estimate);
      JointFit result = judged(log, response, estimate);
      if (result.runs + setup_.batch > setup_.most_runs || precise(result) || settled(result)) {
        return result;
      }
      reach = std::max(setup_.shrink * reach, worthwhile_reach(response, estimate));
      log.make(spread_around(estimate, 0.7 * reach, random), batch, random);
    }
  }

  [[nodiscard]] const std::vector<Parameter>& space() const { return space_; }

private:
  [[nodiscard]] Eigen::Index dimension() const { return static_cast<Eigen::Index>(space_.size()); }

  /// A Latin hypercube: each parameter takes each of n even steps once.
  [[nodiscard]] std::vector<Eigen::VectorXd> spread_over_space(Random& random) const {
    const std::size_t n = setup_.first_runs;
    std::vector<Eigen::VectorXd> points(n, Eigen::VectorXd(dimension()));
    for (Eigen::Index k = 0; k < dimension(); ++k) {
      std::vector<std::size_t> steps(n);
      for (std::size_t i = 0; i < n; ++i) {
        steps[i] = i;
      }
      random.shuffle(std::span{steps});
      for (std::size_t i = 0; i < n; ++i) {
        points[i][k] = (static_cast<double>(steps[i]) + random.uniform()) / static_cast<double>(n);
      }
    }
    return points;
  }

  /// Pairs on opposite sides of the estimate, within the bounds.
  [[nodiscard]] std::vector<Eigen::VectorXd> spread_around(const Eigen::VectorXd& estimate, double radius,
                                                           Random& random) const {
    std::vector<Eigen::VectorXd> points;
    while (points.size() < setup_.batch) {
      Eigen::VectorXd aside(dimension());
      for (Eigen::Index k = 0; k < dimension(); ++k) {
        aside[k] = radius * random.uniform(-1.0, 1.0);
      }
      for (const double side : {1.0, -1.0}) {
        if (points.size() < setup_.batch) {
          points.emplace_back((estimate + side * aside).cwiseMax(0.0).cwiseMin(1.0));
        }
      }
    }
    return points;
  }

  /// The reach below which runs would show more noise than answer.
  [[nodiscard]] double worthwhile_reach(const ResponseSurface& response, const Eigen::VectorXd& at) const {
    const Eigen::MatrixXd slopes = response.slopes(at);
    double reach = 0.0;
    for (Eigen::Index k = 0; k < dimension(); ++k) {
      double best_signal = 0.0; // over noise, of a step of one share
      for (Eigen::Index i = 0; i < slopes.rows(); ++i) {
        best_signal =
            std::max(best_signal, std::abs(slopes(i, k)) / std::sqrt(std::max(1e-300, response.noise()[i])));
      }
      reach =
          std::max(reach, std::min(setup_.first_reach, setup_.least_signal / std::max(1e-9, best_signal)));
    }
    return reach;
  }

  [[nodiscard]] JointFit judged(const RunLog& log, const ResponseSurface& response,
                                const Eigen::VectorXd& at) const {
    const Posterior posterior{measured_, response, prior_, at};
    JointFit out;
    for (Eigen::Index k = 0; k < dimension(); ++k) {
      const Parameter& parameter = space_[static_cast<std::size_t>(k)];
      const boost::math::students_t_distribution<double> student{posterior.freedom(k)};
      const double half =
          quantile(student, 0.5 + 0.5 * setup_.confidence) * std::sqrt(posterior.covariance()(k, k));
      out.parameters.push_back({.value = parameter.value(at[k]),
                                .low = parameter.value(std::max(0.0, at[k] - half)),
                                .high = parameter.value(std::min(1.0, at[k] + half)),
                                .at_bound = at[k] <= 0.0 || at[k] >= 1.0,
                                .determined = half < 0.25,
                                .simulated_share = posterior.simulated_share(k)});
    }
    out.correlation = posterior.correlation();
    out.undetermined = posterior.undetermined();
    out.misfit = posterior.misfit();
    const Eigen::VectorXd residuals = posterior.standardised_residuals();
    out.residuals.assign(residuals.begin(), residuals.end());
    out.runs = log.asked();
    out.failed = log.failed();
    out.failures = log.failures();
    return out;
  }

  /// Whether more runs would gain little.
  [[nodiscard]] bool settled(const JointFit& fit) const {
    return std::all_of(fit.parameters.begin(), fit.parameters.end(),
                       [&](const Estimate& e) { return e.simulated_share <= setup_.negligible; });
  }

  [[nodiscard]] bool precise(const JointFit& fit) const {
    if (setup_.precision.empty()) {
      return false;
    }
    for (std::size_t k = 0; k < space_.size(); ++k) {
      if (0.5 * (fit.parameters[k].high - fit.parameters[k].low) > setup_.precision[k]) {
        return false;
      }
    }
    return true;
  }

  std::vector<Parameter> space_;
  std::vector<Measured> measured_;
  JointFitSetup setup_;
  Prior prior_ = Prior::even(dimension());
};

} // namespace scree
