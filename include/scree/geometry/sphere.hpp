#pragma once
/// \file
/// A sphere.

#include "scree/core/linear.hpp"

namespace scree {

struct Sphere {
  Vector centre = Vector::Zero(); ///< m
  double radius = 0.0;            ///< m, above 0
};

} // namespace scree
