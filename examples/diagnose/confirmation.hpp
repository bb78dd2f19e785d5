#pragma once
/// \file
/// What an extended model gains on held-out data, by runs of it instead of surfaces.

#include "laboratory/plan.hpp"
#include "laboratory/trials.hpp"

#include "scree/diagnose/diagnosis.hpp"

#include <cstddef>
#include <optional>

namespace diagnose {

/// Surfaces know what was held out only roughly, as the runs they come from are spread over all causes.
struct Confirmation {
  std::size_t base_runs = 0, extended_runs = 0; ///< in which all that was held out could be seen
  std::optional<scree::Gain> gain{};            ///< none for less than two runs of either
};

/// Simulates all that was held out with the base model and with what is named first, each at its best point.
/// \param diagnosis names something, and has a held-out gain
/// \param replicates of each, two or more
Confirmation confirm(const scree::examples::Plan& plan, scree::examples::Trials& trials,
                     const scree::Diagnostician& diagnostician, const scree::Diagnosis& diagnosis,
                     std::size_t replicates);

} // namespace diagnose
