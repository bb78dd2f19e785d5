#pragma once
/// \file
/// Runs the experiments of a plan as a campaign.

#include "laboratory/plan.hpp"

#include "scree/calibrate/run_batch.hpp"
#include "scree/laboratory/campaign.hpp"
#include "support/progress.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace scree::examples {

/// Answers the requests of a fit with simulations, each kept when it ends.
class Trials {
public:
  /// \param limit s of simulated time, beyond which a run counts as failed
  /// \param expected runs in all, for the estimate of the end
  /// \param step_safety share of the critical time step
  Trials(const Plan& plan, Campaign campaign, double limit, std::size_t expected, bool show_progress,
         double step_safety = 0.8);

  [[nodiscard]] std::vector<RunOutcome> operator()(const std::vector<RunRequest>& requests);

  /// One experiment at some parameters.
  struct Replicate {
    const PlannedExperiment& experiment;
    const std::vector<double>& parameters;
    std::uint64_t seed;
  };
  /// All observables of each, measured or not, and why there are none.
  [[nodiscard]] std::vector<RunOutcome> replicates(const std::vector<Replicate>& wanted);

  [[nodiscard]] std::size_t done() const { return done_; }
  [[nodiscard]] std::size_t kept() const { return kept_; }
  /// Ends the line of the progress, so that other output starts on a new one.
  void close() {
    if (progress_) {
      progress_->close();
    }
  }

private:
  [[nodiscard]] Job job(const PlannedExperiment& experiment, const std::vector<double>& parameters,
                        std::uint64_t seed) const;
  [[nodiscard]] std::vector<JobOutcome> run(const std::vector<Job>& jobs);

  const Plan& plan_;
  Campaign campaign_;
  double limit_, step_safety_;
  std::size_t expected_, done_ = 0, kept_ = 0, failed_ = 0;
  std::optional<Progress> progress_;
};

} // namespace scree::examples
