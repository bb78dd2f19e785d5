/// \file
/// What nearly every test includes, read by the compiler once.

#include "scree/simulation/simulation.hpp"

#include <Eigen/Dense>
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numeric>
#include <optional>
#include <random>
#include <span>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

// Compiled once, in support/default_simulation.cpp.
extern template class scree::Simulation<>;
