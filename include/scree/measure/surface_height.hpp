#pragma once
/// \file
/// The upper surface of a bed.

#include "scree/state/bodies.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace scree {

/// m, of the highest point of any sphere over a rectangle of the plan (x and y of `plan`); minus infinity
/// over none.
template <class Real>
double highest_point(const Bodies<Real>& bodies, const Eigen::AlignedBox2d& plan) {
  double most = -std::numeric_limits<double>::infinity();
  for (const auto& sphere : bodies.spheres()) {
    const Vector at = to_eigen(sphere.position);
    const double outside2 = plan.squaredExteriorDistance(Eigen::Vector2d(at.head<2>()));
    if (outside2 < sphere.radius * sphere.radius) {
      most = std::max(most, at.z() + std::sqrt(sphere.radius * sphere.radius - outside2));
    }
  }
  return most;
}

} // namespace scree
