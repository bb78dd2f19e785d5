#pragma once
/// \file
/// What a calibration leaves: tables, plots and numbers.

#include "laboratory/plan.hpp"
#include "laboratory/trials.hpp"

#include "scree/calibrate/joint_fit.hpp"
#include "scree/calibrate/one_by_one.hpp"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace calibrate {

/// Estimates, intervals, correlation, and what the data do not determine.
nlohmann::ordered_json described(const scree::examples::Plan& plan, const scree::JointFit& fit);

/// The same for the paper's sequence, whose iterations go to `folder`/one_by_one.csv.
nlohmann::ordered_json described(const scree::examples::Plan& plan, const scree::OneByOneFit& fit,
                                 const std::filesystem::path& folder);

/// Every experiment before and after, beside what was measured: `folder`/before and after hold the curve of
/// one run, fit_NAME.svg and .png show it with the observables of all replicates.
/// \returns what could not be drawn; empty where all was.
std::string draw_before_and_after(const scree::examples::Plan& plan, scree::examples::Trials& trials,
                                  const std::vector<double>& before, const std::vector<double>& after,
                                  const std::filesystem::path& folder);

} // namespace calibrate
