/// \file
/// The simulation types that several cases use, compiled once.

#include "ball_bed.hpp"
#include "law.hpp"

#include "scree/simulation/simulation.hpp"

template class scree::Simulation<>;
template class scree::Simulation<validation::With<scree::HertzMindlin<>>>;
template class scree::Simulation<validation::Quiet>;
