#pragma once
/// \file
/// A folder of measurements: calibration.toml and the tables that it names.

#include "laboratory/plan.hpp"

#include <filesystem>

namespace scree::examples {

/// Whether the tables of what was measured are read too.
enum class Data { all, none };

/// Reads `folder`/calibration.toml and the tables that it names; examples/calibrate/README.md has the format.
/// Experiments that are held out come last.
/// \throws Error with file and line for whatever cannot be.
Plan read_plan(const std::filesystem::path& folder, Data data = Data::all);

} // namespace scree::examples
