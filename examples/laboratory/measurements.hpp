#pragma once
/// \file
/// Simulations in place of a laboratory: tables of what it would have measured.

#include "laboratory/plan.hpp"
#include "laboratory/trials.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace scree::examples {

/// How often an experiment is done, and how well it is read off.
struct Reading {
  std::string experiment; ///< its name in the plan
  std::size_t replicates; ///< 2 or more
  double relative;        ///< standard deviation of a reading over its value
  double absolute;        ///< and in its unit, beside that
  /// Of observables that are read off too high by a factor, unknown to the laboratory.
  std::map<std::string, double> gains{};
};

/// Does the experiments with `parameters` on specimens of their own and writes `folder`/NAME.csv for each:
/// one replicate a row, a column for each observable. Seeds are none that a fit takes.
/// \param plan without data; that of `trials`
/// \param seed of specimens and readings
/// \throws Error naming the experiment where one of its runs fails, or for a gain of no observable.
void write_measurements(const std::filesystem::path& folder, const Plan& plan, Trials& trials,
                        const std::vector<double>& parameters, const std::vector<Reading>& readings,
                        std::uint64_t seed);

} // namespace scree::examples
