#pragma once
/// \file
/// Analytic surfaces and how a sphere touches them.

#include "scree/core/error.hpp"
#include "scree/geometry/surface_contact.hpp"

#include <algorithm>
#include <limits>

namespace scree {

/// A half space: solid on the side away from `normal`.
struct Plane {
  Vector point = Vector::Zero();   ///< m
  Vector normal = Vector::UnitZ(); ///< out of the solid; any length above 0, made a unit vector by `checked`

  /// Appends the contact, if there is one. Returns the gap [m], below 0 where there is.
  double touch(const Vector& centre, double radius, SurfaceContacts& contacts) const {
    const double distance = (centre - point).dot(normal);
    if (distance < radius) {
      contacts.push_back({normal, radius - distance, Vector(centre - distance * normal)});
    }
    return distance - radius;
  }
  /// Whether a sphere could touch; m.
  [[nodiscard]] bool near(const Vector& centre, double reach) const {
    return (centre - point).dot(normal) < reach;
  }
};

/// \throws Error for a normal without a direction.
inline Plane checked(Plane plane) {
  if (!(plane.normal.norm() > 0.0) || !plane.point.allFinite()) {
    throw Error("plane: normal must have a direction and point must be finite");
  }
  plane.normal.normalize();
  return plane;
}

} // namespace scree
