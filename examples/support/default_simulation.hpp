#pragma once
/// \file
/// The default simulation, compiled once for all programs that include this.

#include "scree/simulation/simulation.hpp"

extern template class scree::Simulation<>;
