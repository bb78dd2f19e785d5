#pragma once
/// \file
/// Area, volume, mass and inertia of a mesh, and whether a point lies inside it.

#include "scree/core/error.hpp"
#include "scree/core/linear.hpp"
#include "scree/geometry/mass_properties.hpp"
#include "scree/geometry/triangle_mesh.hpp"

#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace scree {

/// The smallest box along the axes that holds all facets, m. Empty for a mesh without facets.
inline Eigen::AlignedBox3d bounding_box(const TriangleMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const auto& f : mesh.facets) {
    for (const auto v : f) {
      box.extend(mesh.vertices[v]);
    }
  }
  return box;
}

/// Area of all facets, m2.
inline double area(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (std::size_t i = 0; i < mesh.facets.size(); ++i) {
    const auto [a, b, c] = mesh.corners(i);
    sum += 0.5 * (b - a).cross(c - a).norm();
  }
  return sum;
}

namespace detail {

/// Where integrals are taken about, so that nothing is lost to rounding for a small body far from the origin.
inline Vector middle(const TriangleMesh& mesh) {
  if (mesh.facets.empty()) {
    return Vector::Zero();
  }
  return bounding_box(mesh).center();
}

/// Integrals of 1, x and x xᵀ, each times the density.
struct Moments {
  double mass = 0.0;
  Vector first = Vector::Zero();
  Matrix second = Matrix::Zero();

  /// Adds a simplex of uniform density from its mass and its corners: x xᵀ averages to
  /// (Σ v vᵀ + s sᵀ) / (n (n + 1)), with s = Σ v over the n corners.
  template <std::size_t n>
  void add(double simplex_mass, const std::array<Vector, n>& corners) {
    Vector sum = Vector::Zero();
    Matrix squares = Matrix::Zero();
    for (const auto& v : corners) {
      sum += v;
      squares += v * v.transpose();
    }
    constexpr auto count = static_cast<double>(n);
    mass += simplex_mass;
    first += simplex_mass / count * sum;
    second += simplex_mass / (count * (count + 1.0)) * (squares + sum * sum.transpose());
  }

  /// The mass properties, with `origin` added to the centre.
  [[nodiscard]] MassProperties about_centre(const Vector& origin) const {
    const Vector centre = first / mass;
    const Matrix central = second - mass * centre * centre.transpose();
    return {mass, origin + centre, central.trace() * Matrix::Identity() - central};
  }
};

} // namespace detail

/// Volume of a closed mesh with outward normals, m3; negative if they point inwards. Parts of overlapping
/// shells count as often as they are covered.
inline double volume(const TriangleMesh& closed) {
  const Vector origin = detail::middle(closed);
  double sum = 0.0;
  for (std::size_t i = 0; i < closed.facets.size(); ++i) {
    const auto [a, b, c] = closed.corners(i);
    sum += (a - origin).dot((b - origin).cross(c - origin)) / 6.0;
  }
  return sum;
}

/// Mass properties of the solid that a closed mesh with outward normals bounds, by the divergence theorem:
/// the sum over the tetrahedra from a common point to every facet, exact for the mesh.
/// \param density kg/m3, above 0.
/// \throws Error if density or volume is not positive (the mesh is open, empty or turned inside out).
inline MassProperties solid_properties(const TriangleMesh& closed, double density = 1.0) {
  require_positive("density", density, "kg/m3");
  const Vector origin = detail::middle(closed);
  detail::Moments moments;
  for (std::size_t i = 0; i < closed.facets.size(); ++i) {
    auto [a, b, c] = closed.corners(i);
    a -= origin;
    b -= origin;
    c -= origin;
    moments.add<4>(density / 6.0 * a.dot(b.cross(c)), {Vector::Zero(), a, b, c});
  }
  if (!(moments.mass > 0.0)) {
    throw Error(message("a solid's mesh must be closed with outward normals; its volume is ",
                        moments.mass / density, " m3"));
  }
  return moments.about_centre(origin);
}

/// Mass properties of a thin plate of uniform thickness bent along the mesh, which may be open.
/// \param thickness m, above 0.
/// \param density kg/m3, above 0.
/// \throws Error if thickness, density or the area is not positive.
inline MassProperties plate_properties(const TriangleMesh& mesh, double thickness, double density) {
  require_positive("thickness", thickness, "m");
  require_positive("density", density, "kg/m3");
  const Vector origin = detail::middle(mesh);
  detail::Moments moments;
  for (std::size_t i = 0; i < mesh.facets.size(); ++i) {
    auto [a, b, c] = mesh.corners(i);
    a -= origin;
    b -= origin;
    c -= origin;
    moments.add<3>(density * thickness * 0.5 * (b - a).cross(c - a).norm(), {a, b, c});
  }
  if (!(moments.mass > 0.0)) {
    throw Error("a plate's mesh must have an area above 0 m2");
  }
  return moments.about_centre(origin);
}

/// Generalised winding number of the mesh about a point (Jacobson, Kavan & Sorkine-Hornung 2013): the sum of
/// the facets' solid angles (van Oosterom & Strackee 1983, Eq. 8) over 4π. For a closed mesh with outward
/// normals it is the number of shells around the point; a small hole changes it by little.
inline double winding_number(const TriangleMesh& mesh, const Vector& point) {
  double half_angles = 0.0;
  for (std::size_t i = 0; i < mesh.facets.size(); ++i) {
    auto [a, b, c] = mesh.corners(i);
    a -= point;
    b -= point;
    c -= point;
    const double la = a.norm();
    const double lb = b.norm();
    const double lc = c.norm();
    half_angles +=
        std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return half_angles / (2.0 * std::numbers::pi);
}

/// Whether a point lies inside a closed mesh; for a point on the surface either answer may come. `box` is the
/// mesh's bounding_box(), for callers that ask for many points.
inline bool contains(const TriangleMesh& closed, const Eigen::AlignedBox3d& box, const Vector& point) {
  // The magnitude, so that a mesh turned inside out as a whole has the same inside.
  return box.contains(point) && std::abs(winding_number(closed, point)) > 0.5;
}

inline bool contains(const TriangleMesh& closed, const Vector& point) {
  return contains(closed, bounding_box(closed), point);
}

} // namespace scree
