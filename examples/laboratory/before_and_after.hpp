#pragma once
/// \file
/// Plots of experiments with two sets of parameters, beside what was measured.

#include "laboratory/plan.hpp"
#include "laboratory/trials.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace scree::examples {

/// Every experiment before and after, beside what was measured: `folder`/before and after hold the curve of
/// one run, fit_NAME.svg and .png show it with the observables of all replicates.
/// \returns what could not be drawn; empty where all was.
std::string draw_before_and_after(const Plan& plan, Trials& trials, const std::vector<double>& before,
                                  const std::vector<double>& after, const std::filesystem::path& folder);

} // namespace scree::examples
