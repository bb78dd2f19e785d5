#pragma once
/// \file
/// Where a diagnosis draws its lines.

#include "scree/core/error.hpp"

#include <cstddef>
#include <cstdint>

namespace scree {

/// Where judgement draws its lines. All numbers are ours.
struct DiagnosisSetup {
  double false_alarms = 0.03;   ///< share of faultless simulations that are doubted, in (0, 0.5)
  double least_adequacy = 0.02; ///< probability by chance, below which a hypothesis does not suffice
  double clear_odds = 10.0;     ///< over the next best hypothesis, for one to be named alone; and of the base
                                ///< model on held-out data, for a hypothesis to be worse there
  double kept_odds = 30.0;      ///< within which hypotheses remain in what is returned
  double odds_against_pair = 30.0; ///< by which two causes are less likely beforehand than one
  double confidence = 0.9;         ///< of all intervals
  /// Share by which what a cause does to each observable may be off (one standard deviation), 0 to 1: the
  /// real one is hardly of the very form that the model gives it.
  double form_tolerance = 0.1;
  double least_power = 0.5;      ///< with which half-way effects must be seen for "no discrepancy" to mean it
  std::size_t draws = 400;       ///< of each bootstrap
  std::size_t pair_partners = 4; ///< causes that are tried together with all others
  std::uint64_t seed = 1;

  /// \throws Error for a value out of its range.
  void check() const {
    require("diagnosis false_alarms", false_alarms, {1e-3, 0.5});
    require("diagnosis least_adequacy", least_adequacy, {0.0, 0.5});
    require("diagnosis clear_odds", clear_odds, {1.0, 1e12});
    require("diagnosis kept_odds", kept_odds, {clear_odds, 1e12});
    require("diagnosis odds_against_pair", odds_against_pair, {1.0, 1e12});
    require("diagnosis confidence", confidence, {0.01, 0.999});
    require("diagnosis form_tolerance", form_tolerance, {0.0, 1.0});
    require("diagnosis least_power", least_power, {0.0, 1.0});
    require("diagnosis draws", static_cast<double>(draws), {20.0, 1e6});
  }
};

} // namespace scree
