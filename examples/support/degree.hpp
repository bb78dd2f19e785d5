#pragma once
/// \file
/// Angles as people give them.

#include <numbers>

namespace scree::examples {

inline constexpr double degree = std::numbers::pi / 180.0; // rad

} // namespace scree::examples
