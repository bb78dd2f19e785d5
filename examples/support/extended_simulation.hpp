#pragma once
/// \file
/// The simulation with every extension, compiled once for all programs that include this.

#include "scree/laboratory/rock_model.hpp"
#include "scree/simulation/simulation.hpp"

extern template class scree::Simulation<scree::ExtendedModel>;
