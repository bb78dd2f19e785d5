#include "support/models.hpp"

template class scree::Simulation<scree::test::RollingHertzian>;
