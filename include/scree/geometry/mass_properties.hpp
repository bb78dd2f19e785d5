#pragma once
/// \file
/// Mass, centre and inertia of a body.

#include "scree/core/linear.hpp"

namespace scree {

/// Of a solid. With unit density, `mass` is the volume in m3.
struct MassProperties {
  double mass = 0.0;               ///< kg
  Vector centre = Vector::Zero();  ///< m, centre of mass
  Matrix inertia = Matrix::Zero(); ///< kg m2, about the centre of mass, in the axes of `centre`
};

/// The body with a point of `mass` [kg, 0 or above] fixed to it `at` [m].
inline MassProperties with_point_mass(const MassProperties& body, double mass, const Vector& at) {
  const double total = body.mass + mass;
  if (!(total > 0.0)) {
    return body;
  }
  // Two points at the distance d turn about their common centre as their reduced mass at d does.
  const Vector d = at - body.centre;
  const double reduced = body.mass * mass / total;
  return {total, body.centre + mass / total * d,
          body.inertia + reduced * (d.squaredNorm() * Matrix::Identity() - d * d.transpose())};
}

} // namespace scree
