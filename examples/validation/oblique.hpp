#pragma once
/// \file
/// What an oblique impact of a sphere on a plane comes to.

#include "degree.hpp"
#include "impact.hpp"

#include <cmath>

namespace validation {

/// The spheres of Kharaz, Gorham & Salman (2001), by Chung & Ooi (2011), table 2.
namespace kharaz {

inline constexpr double radius = 0.0025, speed = 3.9, friction = 0.092, restitution = 0.98; // m, m/s

/// The linear stiffnesses are those of MFiX's DEM05, N/m at the contact.
inline scree::Material aluminium_oxide(double restitution_of) {
  return {.density = 4000,
          .normal_stiffness = 1.72e7,
          .shear_stiffness = 1.48e7,
          .youngs_modulus = 3.8e11,
          .poisson_ratio = 0.23,
          .friction = friction,
          .restitution = restitution_of};
}

} // namespace kharaz

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
