/// \file
/// What nearly every case includes, read by the compiler once.

#include "scree/contact/hertz_mindlin.hpp"
#include "scree/contact/linear_spring.hpp"
#include "scree/simulation/run.hpp"
#include "scree/simulation/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>
