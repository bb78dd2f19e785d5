#pragma once
/// \file
/// A dragline bucket from a few dimensions: its surface, its interior, its hitch points and its mass.

#include "scree/core/linear.hpp"
#include "scree/geometry/dragline_bucket_dimensions.hpp"
#include "scree/geometry/dragline_bucket_parts.hpp"
#include "scree/geometry/mass_properties.hpp"
#include "scree/geometry/mesh_measures.hpp"
#include "scree/geometry/tessellation.hpp"
#include "scree/geometry/triangle_mesh.hpp"

#include <array>
#include <cmath>
#include <utility>

namespace scree {

/// The bucket's surface: closed shells with outward normals, which overlap where teeth, ears, arch and rail
/// are set into the body, but share no vertices. Symmetric about y = 0 facet by facet.
///
/// With the default dimensions it has 516 facets simplified and 5100 detailed.
/// \throws Error if a dimension is out of range.
inline TriangleMesh make_dragline_bucket(const DraglineBucket& bucket = {},
                                         BucketDetail level = BucketDetail::simplified) {
  require_valid(bucket);
  const auto cells = detail::bucket_tessellation(level);
  TriangleMesh mesh = detail::bucket_body(bucket, cells);
  const auto tooth = detail::bucket_tooth(bucket, cells);
  for (int i = 0; i < bucket.teeth; ++i) {
    TriangleMesh moved = tooth;
    const double y = bucket.width * ((i + 0.5) / bucket.teeth - 0.5);
    for (auto& v : moved.vertices) {
      v.y() += y;
    }
    tessellation::append(mesh, moved);
  }
  const auto ear = detail::bucket_ear(bucket, cells);
  tessellation::append(mesh, ear);
  tessellation::append(mesh, tessellation::mirrored(ear));
  if (level == BucketDetail::detailed) {
    tessellation::append(mesh, detail::bucket_arch(bucket));
    tessellation::append(mesh, detail::bucket_rail(bucket));
  }
  return mesh;
}

/// The volume inside the plates, struck off level at the rim and in the plane of the mouth, as a closed mesh
/// with outward normals. The corners between the plates are sharp, as in the simplified bucket.
/// \throws Error if a dimension is out of range.
inline TriangleMesh bucket_interior(const DraglineBucket& bucket = {}) {
  namespace tess = tessellation;
  require_valid(bucket);
  const auto cells = detail::bucket_tessellation(BucketDetail::simplified);
  const auto inside =
      detail::bucket_skin(bucket, cells, 1.0, 0.5 * bucket.width - bucket.plate_thickness, 0.0);
  const auto across = [&cells](const Vector& at_cheek) {
    return tess::line({at_cheek.x(), 0.0, at_cheek.z()}, at_cheek, cells.half_width);
  };
  tess::Grid lid;
  for (const auto& point : tess::joined(inside.mouth, inside.rim)) {
    lid.push_back(across(point));
  }
  TriangleMesh half = inside.surface;
  tess::add_grid(half, lid);
  return tess::symmetric_shell(std::move(half), detail::weld_tolerance(bucket));
}

/// Where the drag ropes are hitched: the foremost points of the left and the right ear, m, bucket frame.
/// \throws Error if a dimension is out of range.
inline std::array<Vector, 2> hitch_points(const DraglineBucket& bucket = {}) {
  require_valid(bucket);
  const double x = bucket.length - bucket.hitch_height * std::tan(bucket.mouth_rake) + bucket.hitch_reach;
  const double y = 0.5 * (bucket.width - bucket.plate_thickness);
  return {Vector{x, y, bucket.hitch_height}, Vector{x, -y, bucket.hitch_height}};
}

/// Mass, centre and inertia of the detailed bucket as solid steel, with its hitch mass at the hitch points.
/// Steel where two parts overlap counts twice, which adds about 3 % with the default dimensions.
/// \param steel_density kg/m3, above 0.
/// \throws Error if a dimension is out of range or the density is not positive.
inline MassProperties estimated_from_plates(const DraglineBucket& bucket = {},
                                            double steel_density = 7850.0) {
  MassProperties body = solid_properties(make_dragline_bucket(bucket, BucketDetail::detailed), steel_density);
  for (const Vector& hitch : hitch_points(bucket)) {
    body = with_point_mass(body, bucket.hitch_mass, hitch);
  }
  return body;
}

} // namespace scree
