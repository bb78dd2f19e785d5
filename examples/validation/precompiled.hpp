/// \file
/// What nearly every case includes, read by the compiler once.

#include "ball_bed.hpp"
#include "law.hpp"

#include "scree/simulation/run.hpp"
#include "scree/simulation/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

// Compiled once, in simulations.cpp.
extern template class scree::Simulation<>;
extern template class scree::Simulation<validation::With<scree::HertzMindlin<>>>;
extern template class scree::Simulation<validation::Quiet>;
