#pragma once
/// \file
/// Angles as the papers give them.

#include <numbers>

namespace validation {

inline constexpr double degree = std::numbers::pi / 180.0; // rad

} // namespace validation
