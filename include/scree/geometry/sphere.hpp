#pragma once
/// \file
/// A sphere, and the mass properties of a solid.

#include "scree/core/linear.hpp"

namespace scree {

struct Sphere {
  Vector centre = Vector::Zero(); ///< m
  double radius = 0.0;            ///< m, above 0
};

/// Mass properties of a solid. With unit density, `mass` is the volume in m3.
struct MassProperties {
  double mass = 0.0;               ///< kg
  Vector centre = Vector::Zero();  ///< m, centre of mass
  Matrix inertia = Matrix::Zero(); ///< kg m2, about the centre of mass, in the axes of `centre`
};

} // namespace scree
