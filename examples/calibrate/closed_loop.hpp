#pragma once
/// \file
/// Data made by simulations with parameters that are then to be found again.

#include "scree/laboratory/campaign.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace calibrate {

/// A parameter and what the data were made with.
using Truth = std::vector<std::pair<std::string, double>>;

/// Draws particle density, normal stiffness and friction at random, does every experiment of the closed loop
/// a few times with them, adds noise, and writes a folder that `read_plan` reads. Nothing in it says what was
/// drawn. Seeds are none that a calibration takes.
/// \param folder new; what is measured goes there
/// \param limit s of simulated time of one run
/// \throws Error where the runs of an experiment fail.
Truth make_measurements(const std::filesystem::path& folder, std::uint64_t seed,
                        const scree::Campaign& campaign, double limit, bool show_progress);

} // namespace calibrate
