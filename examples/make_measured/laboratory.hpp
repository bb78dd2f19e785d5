#pragma once
/// \file
/// Simulations as a laboratory, with effects in its rock that a base model does not have.

#include "scree/laboratory/campaign.hpp"

#include <cstdint>
#include <filesystem>
#include <string>

namespace make_measured {

/// What is to be measured. Lists have commas between their items.
struct Order {
  std::string plan = "desk"; ///< desk, mini, micro or drag, or a folder with calibration.toml
  std::string effects{};     ///< NAME=VALUE or NAME=auto, NAME:FORM in another form than that of the causes
  std::string misread{};     ///< EXPERIMENT.OBSERVABLE=FACTOR: read off wrong
  std::string misstated{};   ///< KEY=VALUE: as it was, where calibration.toml says otherwise
  std::uint64_t seed = 1;    ///< of the rock, of specimens, readings and sizes of effects
  std::uint64_t replicates = 6;
  double reading_error = 5e-3; ///< relative, of a folder's experiments
  double limit = 300.0;        ///< s of simulated time of one run
  double step_safety = 0.5;    ///< share of the critical time step; less than that of those who diagnose
};

/// Writes `folder`/measured with calibration.toml and tables, and apart from it `folder`/truth.json.
/// \throws Error for an order that makes no sense, or naming the experiment where one of its runs fails.
void measure(const Order& order, const std::filesystem::path& folder, const scree::Campaign& campaign,
             bool show_progress);

} // namespace make_measured
