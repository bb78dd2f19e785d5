#pragma once
/// \file
/// From a folder of measurements to a verdict.

#include "diagnose/confirmation.hpp"
#include "laboratory/plan.hpp"
#include "laboratory/trials.hpp"

#include "scree/calibrate/run_log.hpp"
#include "scree/diagnose/diagnosis.hpp"
#include "scree/laboratory/campaign.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace diagnose {

/// What is asked for.
struct Request {
  std::string measured{};        ///< folder with calibration.toml and the tables that it names
  std::string causes{};          ///< to be considered, with commas between them; empty: all
  std::uint64_t runs = 96;       ///< of all experiments at most
  std::uint64_t first_runs = 72; ///< of these, spread over all causes; the others go where the likeliest are
  /// Of all experiments beyond those, only where held-out data would refuse what explains all others: it may
  /// be that the surfaces are poor there.
  std::uint64_t second_look = 24;
  std::uint64_t confirm = 8;  ///< runs of what was held out by base and extended model each; below 2: none
  std::uint64_t active = 2;   ///< causes at work in each of the first runs
  std::uint64_t fit_seed = 1; ///< of the runs
  double limit = 300.0;       ///< s of simulated time, beyond which a run counts as failed
  /// Share of the critical time step: at 0.8 the restitution of a rock is 0.7 % below that at 0.3, which four
  /// replicates do notice; at 0.6 it is 0.2 %.
  double step_safety = 0.6;
  scree::DiagnosisSetup setup{};
};

/// A diagnosis, and all that led to it.
struct Diagnosed {
  scree::ModelSpace space;
  std::vector<scree::Measured> fitted, held_out;
  scree::RunLog log;
  std::unique_ptr<scree::Diagnostician> diagnostician; ///< to be asked further
  scree::Diagnosis diagnosis;                          ///< what it said
  std::optional<Confirmation> confirmation{};          ///< where it names something, and predicts
};

/// A folder of measurements as it is read, and its simulations.
class Diagnosing {
public:
  /// \throws Error for a request that makes no sense, or a folder that cannot be read.
  Diagnosing(const Request& request, const scree::Campaign& campaign, bool show_progress);

  /// \throws Error as the campaign does, or for too few runs that show anything.
  Diagnosed operator()();

  /// Its parameters are the whole space.
  [[nodiscard]] const scree::examples::Plan& plan() const { return plan_; }
  [[nodiscard]] scree::examples::Trials& trials() { return trials_; }

private:
  Request request_;
  scree::examples::Plan plan_;
  scree::ModelSpace space_;
  scree::examples::Trials trials_;
};

} // namespace diagnose
