#pragma once
/// \file
/// What an oblique impact of a sphere on a plane comes to.

#include "impact.hpp"

#include <cmath>
#include <numbers>

namespace validation {

inline constexpr double degree = std::numbers::pi / 180.0;

/// What an oblique impact comes to, in the terms of the papers.
struct Oblique {
  double tangential_restitution; ///< of the centre
  double spin;                   ///< rad/s, above 0 as friction makes it
  double patch_angle;            ///< degrees, of the contact patch's rebound from the normal
};

template <class Law>
Oblique oblique_impact(const scree::Material& material, const scree::Material& plane, double radius,
                       double normal, double tangential, double duration, scree::Stiffness stiffness) {
  const Ball ball{material, radius, {tangential, 0.0, -normal}};
  const auto after = impact<Law>({ball}, &plane, duration, 2000, stiffness).after[0];
  const double vt = after.velocity.x(), w = after.angular_velocity.y();
  return {vt / tangential, w, std::atan2(vt - radius * w, after.velocity.z()) / degree};
}

} // namespace validation
