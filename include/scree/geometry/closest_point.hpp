#pragma once
/// \file
/// The point of a triangle that is nearest to a given point.

#include "scree/core/linear.hpp"

#include <array>
#include <cstdint>

namespace scree {

/// Which part of a triangle a point lies on, as a set of its corners: all three for the face, two for an
/// edge, one for a vertex (bit k for corner k).
using TriangleFeature = std::uint8_t;
inline constexpr TriangleFeature triangle_face = 7;

struct ClosestPoint {
  Vector point;            ///< m
  TriangleFeature feature; ///< on which it lies
};

/// By the Voronoi regions of corners and edges (Ericson, Real-Time Collision Detection, 2005, section 5.1.5).
inline ClosestPoint closest_point(const std::array<Vector, 3>& t, const Vector& p) {
  const Vector ab = t[1] - t[0], ac = t[2] - t[0], ap = p - t[0];
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0.0 && d2 <= 0.0) {
    return {t[0], 1};
  }
  const Vector bp = p - t[1];
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0.0 && d4 <= d3) {
    return {t[1], 2};
  }
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) {
    return {Vector(t[0] + d1 / (d1 - d3) * ab), 3};
  }
  const Vector cp = p - t[2];
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0.0 && d5 <= d6) {
    return {t[2], 4};
  }
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) {
    return {Vector(t[0] + d2 / (d2 - d6) * ac), 5};
  }
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
    const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {Vector(t[1] + w * (t[2] - t[1])), 6};
  }
  const double scale = 1.0 / (va + vb + vc);
  return {Vector(t[0] + vb * scale * ab + vc * scale * ac), triangle_face};
}

} // namespace scree
