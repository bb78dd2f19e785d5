#include "support/default_simulation.hpp"

template class scree::Simulation<>;
