#pragma once
/// \file
/// A folder of measurements: calibration.toml and the tables that it names.

#include "laboratory/plan.hpp"

#include <filesystem>

namespace calibrate {

/// Whether the tables of what was measured are read too.
enum class Data { all, none };

/// Reads `folder`/calibration.toml and the tables that it names; README.md beside this file has the format.
/// \throws Error with file and line for whatever cannot be.
scree::examples::Plan read_plan(const std::filesystem::path& folder, Data data = Data::all);

} // namespace calibrate
