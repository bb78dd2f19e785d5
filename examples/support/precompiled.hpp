/// \file
/// What nearly every program of the laboratory includes, read by the compiler once.

#include "support/options.hpp"
#include "support/workbench.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>
