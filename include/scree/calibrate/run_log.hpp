#pragma once
/// \file
/// Runs that were made, as fits look at them.

#include "scree/calibrate/measured.hpp"
#include "scree/calibrate/parameter.hpp"
#include "scree/calibrate/response_surface.hpp"
#include "scree/calibrate/run_batch.hpp"
#include "scree/core/error.hpp"
#include "scree/core/random.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace scree {

/// Asks for runs, each with a seed of its own, and keeps what they show, as it is compared. Those that fail,
/// in whole or in part, are counted, with their reasons.
class RunLog {
public:
  RunLog(std::vector<Parameter> space, std::vector<Measured> measured)
      : space_{std::move(space)}, measured_{std::move(measured)} {}

  /// \param points shares of the space
  /// \param seeds where those of the runs come from
  /// \throws Error where the batch gives other than one outcome for each run.
  void make(const std::vector<Eigen::VectorXd>& points, const RunBatch& batch, Random& seeds) {
    std::vector<RunRequest> requests;
    for (const Eigen::VectorXd& at : points) {
      RunRequest request;
      for (std::size_t k = 0; k < space_.size(); ++k) {
        request.parameters.push_back(space_[k].value(at[static_cast<Eigen::Index>(k)]));
      }
      request.seed = seeds.index(std::size_t{1} << 53U);
      requests.push_back(std::move(request));
    }
    const std::vector<RunOutcome> outcomes = batch(requests);
    if (outcomes.size() != requests.size()) {
      throw Error(message("runs: ", outcomes.size(), " outcomes of ", requests.size(), " runs"));
    }
    for (std::size_t r = 0; r < outcomes.size(); ++r) {
      ++asked_;
      if (auto observed = compared(outcomes[r])) {
        runs_.push_back({points[r], std::move(*observed)});
      }
    }
  }

  [[nodiscard]] const std::vector<Run>& runs() const { return runs_; }
  [[nodiscard]] std::size_t asked() const { return asked_; }
  /// In whole or in part.
  [[nodiscard]] std::size_t failed() const { return failed_; }
  /// Reasons, each once.
  [[nodiscard]] const std::vector<std::string>& failures() const { return failures_; }

private:
  /// The observables as they are compared, not a number where the run does not show one; nothing for a run
  /// that shows none.
  [[nodiscard]] std::optional<Eigen::VectorXd> compared(const RunOutcome& outcome) {
    Eigen::VectorXd out(static_cast<Eigen::Index>(measured_.size()));
    out.setConstant(std::numeric_limits<double>::quiet_NaN());
    std::string failure = outcome.failure;
    bool any = false;
    if (outcome.observed.size() == measured_.size()) {
      for (std::size_t k = 0; k < measured_.size(); ++k) {
        const double value = measured_[k].compared(outcome.observed[k]);
        if (std::isfinite(value)) {
          out[static_cast<Eigen::Index>(k)] = value;
          any = true;
        } else if (failure.empty()) {
          failure = message(measured_[k].name, " = ", outcome.observed[k], " cannot be compared");
        }
      }
    } else if (failure.empty()) {
      failure = message("it has ", outcome.observed.size(), " observables where ", measured_.size(),
                        " were measured");
    }
    if (!failure.empty()) {
      ++failed_;
      if (std::find(failures_.begin(), failures_.end(), failure) == failures_.end()) {
        failures_.push_back(failure);
      }
    }
    return any ? std::optional{out} : std::nullopt;
  }

  std::vector<Parameter> space_;
  std::vector<Measured> measured_;
  std::vector<Run> runs_;
  std::size_t asked_ = 0, failed_ = 0;
  std::vector<std::string> failures_;
};

} // namespace scree
