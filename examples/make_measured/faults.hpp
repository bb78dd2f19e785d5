#pragma once
/// \file
/// What a laboratory may do wrong without knowing it, which no cause of a simulation's can make good.

#include "laboratory/measurements.hpp"

#include <string>
#include <vector>

namespace make_measured {

/// Reads "EXPERIMENT.OBSERVABLE=FACTOR,..." and lets the laboratory read these off too high by the factor.
/// \throws Error for what cannot be read, or an experiment that is none of the plan's; `write_measurements`
/// throws for an observable that is none.
void misread(const std::string& text, std::vector<scree::examples::Reading>& readings);

/// The text of calibration.toml as things were, where that of `stated` is wrong in some places:
/// "KEY=VALUE,...", a key being like experiments.tamped.fill.packing_friction, a value a number or a word.
/// \throws Error for what cannot be read, or a key on the way to which there is no table.
std::string as_it_was(const std::string& stated, const std::string& misstated);

} // namespace make_measured
