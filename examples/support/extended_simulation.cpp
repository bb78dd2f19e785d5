#include "support/extended_simulation.hpp"

template class scree::Simulation<scree::ExtendedModel>;
