#pragma once
/// \file
/// Pieces to build closed shells from: strips, grids, caps and their mirror images. Pieces are soups, each
/// facet with vertices of its own; weld() joins them where they meet.

#include "scree/core/linear.hpp"
#include "scree/geometry/mesh_weld.hpp"
#include "scree/geometry/triangle_mesh.hpp"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace scree::tessellation {

using Polyline = std::vector<Vector>;
/// Rows of equally many points.
using Grid = std::vector<Polyline>;

/// Adds all facets of `part`, which stay unconnected to those already there.
inline void append(TriangleMesh& mesh, const TriangleMesh& part) {
  const auto offset = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), part.vertices.begin(), part.vertices.end());
  for (const auto& f : part.facets) {
    mesh.facets.push_back({f[0] + offset, f[1] + offset, f[2] + offset});
  }
}

inline void add_triangle(TriangleMesh& mesh, const Vector& a, const Vector& b, const Vector& c) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), {a, b, c});
  mesh.facets.push_back({first, first + 1, first + 2});
}

/// Two facets, split along the shorter diagonal.
inline void add_quad(TriangleMesh& mesh, const Vector& a, const Vector& b, const Vector& c, const Vector& d) {
  if ((c - a).squaredNorm() <= (d - b).squaredNorm()) {
    add_triangle(mesh, a, b, c);
    add_triangle(mesh, a, c, d);
  } else {
    add_triangle(mesh, a, b, d);
    add_triangle(mesh, b, c, d);
  }
}

/// Quads between two lines of equally many points. The normal is (along the line) x (from `from` to `to`).
inline void add_strip(TriangleMesh& mesh, const Polyline& from, const Polyline& to) {
  for (std::size_t i = 0; i + 1 < from.size(); ++i) {
    add_quad(mesh, from[i], from[i + 1], to[i + 1], to[i]);
  }
}

/// Quads between neighbouring rows. The normal is (along a row) x (from row to row).
inline void add_grid(TriangleMesh& mesh, const Grid& rows) {
  for (std::size_t i = 0; i + 1 < rows.size(); ++i) {
    add_strip(mesh, rows[i], rows[i + 1]);
  }
}

/// Triangles from `centre` to every side of a closed polygon, counter-clockwise about the normal.
inline void add_fan(TriangleMesh& mesh, const Vector& centre, const Polyline& polygon) {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    add_triangle(mesh, centre, polygon[i], polygon[(i + 1) % polygon.size()]);
  }
}

/// The same surface seen from the other side.
inline TriangleMesh turned(TriangleMesh mesh) {
  for (auto& f : mesh.facets) {
    std::swap(f[1], f[2]);
  }
  return mesh;
}

/// The mirror image at the plane y = 0, with its normals mirrored too.
inline TriangleMesh mirrored(TriangleMesh mesh) {
  for (auto& v : mesh.vertices) {
    v.y() = -v.y();
  }
  return turned(std::move(mesh));
}

/// Joins the half of a shell at y >= 0 with its mirror image, so that the shell is symmetric facet by facet.
/// \param tolerance m, far below the smallest side of a facet.
inline TriangleMesh symmetric_shell(TriangleMesh half, double tolerance) {
  append(half, mirrored(half));
  return weld(half, tolerance);
}

/// A surface through four lines (Coons 1967). `bottom` and `top` have equally many points, as have `left` and
/// `right`, and neighbouring lines share their end points. The rows run as `bottom` does, from `bottom` to
/// `top`.
inline Grid coons_patch(const Polyline& bottom, const Polyline& top, const Polyline& left,
                        const Polyline& right) {
  Grid rows{bottom};
  for (std::size_t j = 1; j + 1 < left.size(); ++j) {
    const double v = static_cast<double>(j) / static_cast<double>(left.size() - 1);
    Polyline row{left[j]};
    for (std::size_t i = 1; i + 1 < bottom.size(); ++i) {
      const double u = static_cast<double>(i) / static_cast<double>(bottom.size() - 1);
      row.push_back((1.0 - v) * bottom[i] + v * top[i] + (1.0 - u) * left[j] + u * right[j] -
                    (1.0 - v) * ((1.0 - u) * bottom.front() + u * bottom.back()) -
                    v * ((1.0 - u) * top.front() + u * top.back()));
    }
    row.push_back(right[j]);
    rows.push_back(std::move(row));
  }
  rows.push_back(top);
  return rows;
}

/// `count` equal steps from `from` to `to`, both included.
inline Polyline line(const Vector& from, const Vector& to, std::size_t count) {
  Polyline points;
  for (std::size_t i = 0; i <= count; ++i) {
    const double s = static_cast<double>(i) / static_cast<double>(count);
    points.push_back((1.0 - s) * from + s * to);
  }
  return points;
}

/// `points` and the points of `more`, whose first point is the last of `points`.
inline Polyline joined(Polyline points, const Polyline& more) {
  points.insert(points.end(), more.begin() + 1, more.end());
  return points;
}

} // namespace scree::tessellation
