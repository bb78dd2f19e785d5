/// \file
/// The default simulation, compiled once for all tests.

#include "scree/simulation/simulation.hpp"

template class scree::Simulation<>;
