#pragma once
/// \file
/// A tube.

#include "scree/core/error.hpp"
#include "scree/geometry/surface_contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace scree {

/// The mantle of a circular cylinder, open at its ends: a container seen from inside or a roller seen from
/// outside. Beyond its ends a sphere touches the rim.
struct Cylinder {
  enum class Side { inside, outside };

  Vector base = Vector::Zero();  ///< m, centre of one end
  Vector axis = Vector::UnitZ(); ///< towards the other end; made a unit vector by `checked`
  double radius = 0.0;           ///< m, above 0
  double length = std::numeric_limits<double>::infinity(); ///< m, above 0
  Side side = Side::inside;                                ///< on which the grains are

  /// Appends the contact, if there is one. Returns the gap [m], below 0 where there is.
  double touch(const Vector& centre, double sphere_radius, SurfaceContacts& contacts) const {
    const Vector from_base = centre - base;
    const double along = from_base.dot(axis);
    const Vector radial = from_base - along * axis;
    const double off_axis = radial.norm();
    // On the axis every direction is the nearest; a sphere as wide as the tube would need all of them at
    // once.
    const Vector outward = off_axis > 0.0 ? Vector(radial / off_axis) : Vector(axis.unitOrthogonal());
    const double at =
        std::clamp(along, std::isinf(length) ? along : 0.0, std::isinf(length) ? along : length);
    const Vector point = base + at * axis + radius * outward;
    if (at == along) {
      const double distance = side == Side::inside ? radius - off_axis : off_axis - radius;
      if (distance < sphere_radius) {
        contacts.push_back(
            {side == Side::inside ? Vector(-outward) : outward, sphere_radius - distance, point});
      }
      return distance - sphere_radius;
    }
    const Vector to_centre = centre - point;
    const double distance = to_centre.norm();
    if (distance < sphere_radius && distance > 0.0) {
      contacts.push_back({to_centre / distance, sphere_radius - distance, point});
    }
    return distance - sphere_radius;
  }

  [[nodiscard]] bool near(const Vector& centre, double reach) const {
    const Vector from_base = centre - base;
    const double along = from_base.dot(axis);
    if (!std::isinf(length) && (along < -reach || along > length + reach)) {
      return false;
    }
    const double off_axis = (from_base - along * axis).norm();
    return side == Side::inside ? off_axis > radius - reach : off_axis < radius + reach;
  }
};

/// \throws Error for an axis without a direction, a radius or a length of 0 or below.
inline Cylinder checked(Cylinder cylinder) {
  require_positive("cylinder radius", cylinder.radius, "m");
  if (!(cylinder.length > 0.0)) {
    throw Error(message("cylinder length = ", cylinder.length, " m must be above 0"));
  }
  if (!(cylinder.axis.norm() > 0.0) || !cylinder.base.allFinite()) {
    throw Error("cylinder: axis must have a direction and base must be finite");
  }
  cylinder.axis.normalize();
  return cylinder;
}

} // namespace scree
