#pragma once
/// \file
/// What a calibration leaves: tables, plots and numbers.

#include "laboratory/plan.hpp"

#include "scree/calibrate/joint_fit.hpp"
#include "scree/calibrate/one_by_one.hpp"

#include <nlohmann/json.hpp>

#include <filesystem>

namespace calibrate {

/// Estimates, intervals, correlation, and what the data do not determine.
nlohmann::ordered_json described(const scree::examples::Plan& plan, const scree::JointFit& fit);

/// The same for the paper's sequence, whose iterations go to `folder`/one_by_one.csv.
nlohmann::ordered_json described(const scree::examples::Plan& plan, const scree::OneByOneFit& fit,
                                 const std::filesystem::path& folder);

} // namespace calibrate
