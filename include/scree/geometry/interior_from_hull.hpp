#pragma once
/// \file
/// The interior of a bucket of which only the surface is known.

#include "scree/core/error.hpp"
#include "scree/geometry/mesh_measures.hpp"
#include "scree/geometry/tessellation.hpp"
#include "scree/geometry/triangle_mesh.hpp"

#include <boost/geometry/algorithms/centroid.hpp>
#include <boost/geometry/algorithms/convex_hull.hpp>
#include <boost/geometry/geometries/multi_point.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>
#include <boost/geometry/strategies/strategies.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace scree {

namespace detail {

/// The y at which the line along y through (x, z) meets a facet; nothing (NaN) where it passes by or runs
/// within it.
inline double crossing_along_y(const std::array<Vector, 3>& corners, double x, double z) {
  const auto& [a, b, c] = corners;
  const auto twice_area = [](double ux, double uz, double vx, double vz) { return ux * vz - uz * vx; };
  const double whole = twice_area(b.x() - a.x(), b.z() - a.z(), c.x() - a.x(), c.z() - a.z());
  const double at_a = twice_area(b.x() - x, b.z() - z, c.x() - x, c.z() - z) / whole;
  const double at_b = twice_area(c.x() - x, c.z() - z, a.x() - x, a.z() - z) / whole;
  const double at_c = 1.0 - at_a - at_b;
  // A little outside still counts, so that no gap opens along the sides that facets share.
  constexpr double slack = -1e-9;
  if (!(std::isfinite(at_a) && at_a >= slack && at_b >= slack && at_c >= slack)) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  return at_a * a.y() + at_b * b.y() + at_c * c.y();
}

} // namespace detail

/// The interior of a user's bucket when none is given: the convex hull of the side view (x, z), extruded over
/// the inner width. The inner width is where a line along y through the hull's centroid first meets the
/// bucket left and right of its middle plane.
///
/// Assumes the bucket frame (x to the teeth, y to the left, z up) and cheeks that are near flat and parallel.
/// Limits: all that the mesh holds counts, so teeth and an arch make the hull larger, as does the thickness
/// of floor and back; leave such parts out of the mesh, or give the interior as a mesh, where the struck
/// volume matters.
/// \throws Error if the mesh has no side view or no cheek on one of the sides.
inline TriangleMesh interior_from_hull(const TriangleMesh& bucket) {
  namespace bg = boost::geometry;
  using Point = bg::model::d2::point_xy<double>;
  if (bucket.facets.empty()) {
    throw Error("bucket interior: the mesh is empty");
  }
  const auto box = bounding_box(bucket);
  bg::model::multi_point<Point> shadow;
  for (const auto& f : bucket.facets) {
    for (const auto v : f) {
      shadow.push_back({bucket.vertices[v].x(), bucket.vertices[v].z()});
    }
  }
  constexpr bool clockwise = false;
  bg::model::polygon<Point, clockwise> hull;
  bg::convex_hull(shadow, hull);
  if (hull.outer().size() < 4 || !(box.sizes().x() > 0.0 && box.sizes().z() > 0.0)) {
    throw Error("bucket interior: the mesh has no area in the side view (x, z)");
  }
  Point centroid{0.0, 0.0};
  bg::centroid(hull, centroid);

  const double middle = box.center().y();
  constexpr double none = std::numeric_limits<double>::infinity();
  double left = none;
  double right = -none;
  for (std::size_t i = 0; i < bucket.facets.size(); ++i) {
    const double y = detail::crossing_along_y(bucket.corners(i), centroid.x(), centroid.y());
    if (y > middle) {
      left = std::min(left, y);
    } else if (y <= middle) {
      right = std::max(right, y);
    }
  }
  if (left == none || right == -none) {
    throw Error(message("bucket interior: no cheek ", left == none ? "left" : "right", " of (x, y, z) = (",
                        centroid.x(), ", ", middle, ", ", centroid.y(), ") m"));
  }

  tessellation::Polyline on_left;
  tessellation::Polyline on_right;
  // Boost closes its rings with the first point once more.
  for (const auto& p : hull.outer()) {
    on_left.push_back({p.x(), left, p.y()});
    on_right.push_back({p.x(), right, p.y()});
  }
  TriangleMesh interior;
  tessellation::add_strip(interior, on_left, on_right);
  on_left.pop_back();
  on_right.pop_back();
  tessellation::add_fan(interior, {centroid.x(), right, centroid.y()}, on_right);
  TriangleMesh cap;
  tessellation::add_fan(cap, {centroid.x(), left, centroid.y()}, on_left);
  tessellation::append(interior, tessellation::turned(std::move(cap)));
  return weld(interior, 0.0);
}

} // namespace scree
