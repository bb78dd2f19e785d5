#pragma once
/// \file
/// Angles as the papers give them.

#include "support/degree.hpp"

namespace validation {

using scree::examples::degree;

} // namespace validation
