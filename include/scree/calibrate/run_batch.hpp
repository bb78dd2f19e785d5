#pragma once
/// \file
/// What a calibration asks to be run.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace scree {

/// A run that is asked for.
struct RunRequest {
  std::vector<double> parameters; ///< in their units, in the order of the space
  std::uint64_t seed = 0;
  std::vector<std::size_t> wanted{}; ///< observables; none: all
};

/// What came of it: the observables in their order, those not wanted with any value, or the reason why there
/// are none.
struct RunOutcome {
  std::vector<double> observed{};
  std::string failure{};
};

/// Does all runs of a batch, in any order and on any number of workers, and answers in the order asked.
using RunBatch = std::function<std::vector<RunOutcome>(const std::vector<RunRequest>&)>;

} // namespace scree
