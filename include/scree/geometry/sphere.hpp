#pragma once
/// \file
/// A sphere, and the mass properties of a solid.

#include "scree/geometry/mass_properties.hpp"

namespace scree {

struct Sphere {
  Vector centre = Vector::Zero(); ///< m
  double radius = 0.0;            ///< m, above 0
};

/// Mass properties of a solid. With unit density, `mass` is the volume in m3.
} // namespace scree
