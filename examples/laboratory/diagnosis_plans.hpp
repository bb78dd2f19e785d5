#pragma once
/// \file
/// Experiments that tell causes apart, as texts of calibration.toml.

#include "laboratory/measurements.hpp"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace scree::examples {

inline constexpr std::array diagnosis_plan_names{"desk", "mini", "micro", "drag"};

struct DiagnosisPlan {
  std::string name;
  std::string toml;
  std::vector<Reading> readings; ///< of each of its experiments
};

/// "desk": rock, a few seconds for all experiments once. "mini": some tens of softer grains. "micro": most of
/// them round and no heaps, a second, for those who diagnose hundreds of data sets. "drag": coarser grains of
/// these, and a bucket dragged through them, which shows its rig as well. \throws Error for another name.
DiagnosisPlan diagnosis_plan(const std::string& name, std::size_t replicates);

} // namespace scree::examples
