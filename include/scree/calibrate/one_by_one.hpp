#pragma once
/// \file
/// Finds parameters one after another, each from an observable of its own (Coetzee et al. 2010, section 4).

#include "scree/calibrate/measured.hpp"
#include "scree/calibrate/parameter.hpp"
#include "scree/calibrate/run_batch.hpp"
#include "scree/core/random.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace scree {

/// One parameter is changed until one observable is met.
struct FitStep {
  std::size_t parameter = 0;       ///< in the space
  std::size_t observable = 0;      ///< in what was measured
  double tolerance = 1e-3;         ///< relative for an observable compared by its logarithm, else in its unit
  std::size_t most_iterations = 4; ///< runs of it, with other values of the parameter, 1 or more
};

/// All numbers are ours but for the rounds (the paper, section 4.6).
struct OneByOneSetup {
  std::size_t rounds = 2;     ///< over all steps, 1 or more
  std::size_t replicates = 4; ///< of each run, whose mean counts, 1 or more
  std::uint64_t seed = 1;
};

/// One value of a parameter that was tried.
struct FitIteration {
  std::size_t round = 0, step = 0, iteration = 0; ///< from 0
  double value = 0.0;                             ///< of the step's parameter
  double observed = 0.0;  ///< mean of the replicates; of their logarithms where these are compared, undone
  double deviation = 0.0; ///< of that from what was measured, in terms of the tolerance's unit
  double error = 0.0;     ///< standard error of that mean, in the same unit; 0 for a single replicate
};

struct OneByOneFit {
  std::vector<double> parameters{}; ///< in the order of the space
  std::vector<FitIteration> history{};
  bool converged = false; ///< whether every step of the last round met its tolerance
  std::size_t runs = 0, failed = 0;
};

/// Steps go in the order given, and all of them again in each round. The replicates of a step have the same
/// seeds in every iteration: the first guess changes the parameter in proportion (or by a tenth of its space
/// where the observable is not compared by its logarithm), the next go by the secant. Few iterations are
/// enough where a seed gives the same packing at other parameters too. Poured grains do not quite: they are
/// chaotic, and another density moves them otherwise. A tolerance below the standard error of the replicates'
/// mean is then met by chance only, and takes more replicates.
///
/// The result says nothing of its own uncertainty; `JointCalibration` does.
class OneByOneCalibration {
public:
  /// \throws Error for a space, observable, step or setup that makes no sense.
  OneByOneCalibration(std::vector<Parameter> space, std::vector<Measured> measured,
                      std::vector<FitStep> steps, OneByOneSetup setup = {})
      : space_{std::move(space)}, measured_{std::move(measured)}, steps_{std::move(steps)}, setup_{setup} {
    for (const Parameter& p : space_) {
      p.check();
    }
    for (const Measured& m : measured_) {
      m.check();
    }
    require("one by one: rounds", static_cast<double>(setup_.rounds), {1.0, 100.0});
    require("one by one: replicates", static_cast<double>(setup_.replicates), {1.0, 1e6});
    if (steps_.empty()) {
      throw Error("one by one: there is no step");
    }
    for (const FitStep& step : steps_) {
      if (step.parameter >= space_.size() || step.observable >= measured_.size()) {
        throw Error(message("one by one: a step takes parameter ", step.parameter, " of ", space_.size(),
                            " and observable ", step.observable, " of ", measured_.size()));
      }
      require_positive("one by one: tolerance", step.tolerance);
      require("one by one: most_iterations", static_cast<double>(step.most_iterations), {1.0, 1000.0});
    }
  }

  /// \param start a value for every parameter, within its bounds
  /// \throws Error for a start out of bounds, or where all replicates of a run fail.
  OneByOneFit fit(const std::vector<double>& start, const RunBatch& batch) {
    if (start.size() != space_.size()) {
      throw Error(message("one by one: ", start.size(), " start values for ", space_.size(), " parameters"));
    }
    for (std::size_t k = 0; k < space_.size(); ++k) {
      const Parameter& p = space_[k];
      require(message("start of ", p.name), start[k], {p.least, p.most, p.unit});
    }
    OneByOneFit out;
    out.parameters = start;
    for (std::size_t round = 0; round < setup_.rounds; ++round) {
      out.converged = true;
      for (std::size_t s = 0; s < steps_.size(); ++s) {
        out.converged = search(out, round, s, batch) && out.converged;
      }
    }
    return out;
  }

private:
  struct Trial {
    double share, deviation;
  };
  static bool nearer(const Trial& a, const Trial& b) { return std::abs(a.deviation) < std::abs(b.deviation); }

  static double first_change(const Parameter& parameter, const Measured& measured, const Trial& trial) {
    return measured.logarithmic ? parameter.share(parameter.value(trial.share) * std::exp(-trial.deviation))
                                : trial.share + (trial.share < 0.5 ? 0.1 : -0.1);
  }
  /// Where the line through the two trials nearest to the target meets it, but not too far away.
  static double secant(std::vector<Trial> trials) {
    std::sort(trials.begin(), trials.end(), nearer);
    const double run = trials[1].share - trials[0].share, rise = trials[1].deviation - trials[0].deviation;
    return trials[0].share - (rise != 0.0 ? std::clamp(trials[0].deviation * run / rise, -0.3, 0.3) : 0.0);
  }

  /// Tries values of the step's parameter; the best of them stays. Returns whether the tolerance is met.
  bool search(OneByOneFit& out, std::size_t round, std::size_t s, const RunBatch& batch) const {
    const FitStep& step = steps_[s];
    const Parameter& parameter = space_[step.parameter];
    const Measured& measured = measured_[step.observable];
    const double target = measured.mean();
    double share = parameter.share(out.parameters[step.parameter]);
    std::vector<Trial> trials;
    for (std::size_t k = 0; k < step.most_iterations; ++k) {
      out.parameters[step.parameter] = parameter.value(share);
      const auto [seen, error] = observed(out, step, s, batch);
      trials.push_back({share, seen - target});
      out.history.push_back({round, s, k, out.parameters[step.parameter],
                             measured.logarithmic ? std::exp(seen) : seen, seen - target, error});
      if (std::abs(seen - target) <= step.tolerance) {
        return true;
      }
      // The space is where the parameter is looked for.
      const double next = std::clamp(
          trials.size() > 1 ? secant(trials) : first_change(parameter, measured, trials[0]), 0.0, 1.0);
      if (next == share) {
        break;
      }
      share = next;
    }
    const auto best = std::min_element(trials.begin(), trials.end(), nearer);
    out.parameters[step.parameter] = parameter.value(best->share);
    return false;
  }

  struct Seen {
    double mean, error;
  };
  /// Mean of the replicates, as compared, and its standard error.
  Seen observed(OneByOneFit& out, const FitStep& step, std::size_t s, const RunBatch& batch) const {
    Random random{setup_.seed, message("one by one, step ", s)};
    std::vector<RunRequest> requests;
    for (std::size_t k = 0; k < setup_.replicates; ++k) {
      requests.push_back({out.parameters, random.index(std::size_t{1} << 53U), {step.observable}});
    }
    const std::vector<RunOutcome> outcomes = batch(requests);
    std::vector<double> seen;
    std::string reason;
    for (const RunOutcome& outcome : outcomes) {
      ++out.runs;
      if (!outcome.failure.empty()) {
        ++out.failed;
        reason = outcome.failure;
        continue;
      }
      seen.push_back(measured_[step.observable].compared(outcome.observed.at(step.observable)));
    }
    if (seen.empty()) {
      throw Error(message("one by one: all ", outcomes.size(), " runs for ", measured_[step.observable].name,
                          " failed: ", reason));
    }
    const Measured again{.name = measured_[step.observable].name, .replicates = std::move(seen)};
    const bool scatter = again.replicates.size() > 1;
    return {again.mean(), scatter ? std::sqrt(again.variance_of_mean()) : 0.0};
  }

  std::vector<Parameter> space_;
  std::vector<Measured> measured_;
  std::vector<FitStep> steps_;
  OneByOneSetup setup_;
};

} // namespace scree
