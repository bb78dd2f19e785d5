#pragma once
/// \file
/// Planes that cut a scene open, and where they pass through rays and triangles.

#include "scree/core/error.hpp"
#include "scree/core/linear.hpp"
#include "scree/io/camera.hpp"

#include <array>
#include <cstddef>
#include <optional>

namespace scree {

/// A plane that cuts a scene open: what lies on the side that `normal` points to is left out.
struct CutPlane {
  Vector point = Vector::Zero();    ///< m, any point of the plane
  Vector normal = -Vector::UnitY(); ///< of any length above 0
};

namespace detail {

/// The half space that is kept, in view coordinates: where `distance` is not above 0.
struct KeptHalf {
  Vector normal;
  double offset;
  [[nodiscard]] double distance(const Vector& place) const { return normal.dot(place) - offset; }
  [[nodiscard]] double crossing(const Vector& origin, const Vector& step) const {
    return (offset - normal.dot(origin)) / normal.dot(step);
  }
};

/// What a cut keeps. \throws Error for a plane without a direction.
inline KeptHalf kept_half(const CutPlane& plane, const View& view) {
  if (!(plane.normal.norm() > 0.0) || !plane.normal.allFinite() || !plane.point.allFinite()) {
    throw Error("the normal of a cut must be a finite vector of length above 0");
  }
  const Vector normal = view.direction_to_view(plane.normal.normalized());
  return {normal, normal.dot(view.to_view(plane.point))};
}

/// The ends of the line in which a cut passes through a triangle, or nothing where it does not.
inline std::optional<std::array<Vector, 2>> cut_section(const std::array<Vector, 3>& corners,
                                                        const KeptHalf& kept) {
  std::array<Vector, 2> ends;
  std::size_t found = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector& a = corners[i];
    const Vector& b = corners[(i + 1) % 3];
    const double da = kept.distance(a);
    const double db = kept.distance(b);
    if ((da <= 0.0) != (db <= 0.0)) { // true for none or two of the three edges
      ends[found++] = a + da / (da - db) * (b - a);
    }
  }
  return found == 2 ? std::optional{ends} : std::nullopt;
}

} // namespace detail

} // namespace scree
