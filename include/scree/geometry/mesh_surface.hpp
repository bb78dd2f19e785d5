#pragma once
/// \file
/// How a sphere touches a triangle mesh.

#include "scree/core/error.hpp"
#include "scree/geometry/closest_point.hpp"
#include "scree/geometry/surface_contact.hpp"
#include "scree/geometry/triangle_mesh.hpp"

#include <boost/container/small_vector.hpp>
#include <boost/geometry/core/cs.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace scree {

/// A mesh made ready for contact.
///
/// A sphere touches a surface where the distance from its centre to the surface has a local minimum below its
/// radius: once on a face, on a convex edge or at a convex vertex, whichever facets meet there, and never at
/// the seam of two facets of one plane. So a sphere on a tessellated plane moves as on the plane itself.
/// Minima whose normals agree within ten degrees (concave seams of a tessellated curve) count once, at the
/// deepest.
class MeshSurface {
public:
  /// \throws Error for an empty mesh, an index out of range, a coordinate that is not a number or a facet
  /// without area.
  explicit MeshSurface(TriangleMesh mesh) : mesh_{std::move(mesh)} {
    if (mesh_.facets.empty()) {
      throw Error("mesh surface: the mesh has no facets");
    }
    std::vector<Indexed> boxes;
    boxes.reserve(mesh_.facets.size());
    for (std::size_t f = 0; f < mesh_.facets.size(); ++f) {
      for (const auto vertex : mesh_.facets[f]) {
        if (vertex >= mesh_.vertices.size() || !mesh_.vertices[vertex].allFinite()) {
          throw Error(message("mesh surface: facet ", f, " has vertex ", vertex,
                              ", which is not in the mesh or not finite"));
        }
      }
      const auto t = mesh_.corners(f);
      const Vector cross = (t[1] - t[0]).cross(t[2] - t[0]);
      if (!(cross.norm() > 0.0)) {
        throw Error(message("mesh surface: facet ", f, " has no area"));
      }
      normals_.push_back(cross.normalized());
      const Vector low = t[0].cwiseMin(t[1]).cwiseMin(t[2]), high = t[0].cwiseMax(t[1]).cwiseMax(t[2]);
      boxes.emplace_back(Box{point(low), point(high)}, static_cast<std::uint32_t>(f));
      bounds_.extend(low).extend(high);
    }
    tree_ = Tree{boxes};
  }

  [[nodiscard]] const TriangleMesh& mesh() const { return mesh_; }
  [[nodiscard]] const Eigen::AlignedBox3d& bounds() const { return bounds_; }

  /// Appends, in ascending order, the facets that come within `reach` [m] of `centre`.
  void facets_near(const Vector& centre, double reach, std::vector<std::uint32_t>& facets) const {
    if (bounds_.squaredExteriorDistance(centre) > reach * reach) {
      return;
    }
    const auto before = static_cast<std::ptrdiff_t>(facets.size());
    const Vector r = Vector::Constant(reach);
    const Box query{point(centre - r), point(centre + r)};
    for (auto hit = tree_.qbegin(boost::geometry::index::intersects(query)); hit != tree_.qend(); ++hit) {
      const Vector nearest = closest_point(mesh_.corners(hit->second), centre).point;
      if ((nearest - centre).squaredNorm() <= reach * reach) {
        facets.push_back(hit->second);
      }
    }
    std::sort(facets.begin() + before, facets.end());
  }

  /// Appends the contacts of a sphere with the given facets, which must hold all that are within its radius.
  /// Returns a gap [m] that there is at least to any of them, 0 where there are contacts.
  double touch(std::span<const std::uint32_t> facets, const Vector& centre, double radius,
               SurfaceContacts& contacts) const {
    boost::container::small_vector<Minimum, 16> minima;
    double off_plane = std::numeric_limits<double>::infinity(), apart2 = off_plane;
    for (const std::uint32_t f : facets) {
      const auto corners = mesh_.corners(f);
      const Vector to_plane_point = centre - corners[0];
      const double height = to_plane_point.dot(normals_[f]);
      if (std::abs(height) >= radius) {
        off_plane = std::min(off_plane, std::abs(height));
        continue;
      }
      const ClosestPoint nearest = closest_point(corners, centre);
      if (nearest.feature == triangle_face) {
        // The distance to the plane, and not to the computed foot: exactly what an analytic plane gives.
        minima.push_back({height * height, f, nearest.feature, Vector(centre - height * normals_[f])});
      } else if (const double d2 = (centre - nearest.point).squaredNorm(); d2 < radius * radius) {
        minima.push_back({d2, f, nearest.feature, nearest.point});
      } else {
        apart2 = std::min(apart2, d2);
      }
    }
    if (minima.empty()) {
      return std::max(0.0, std::min(off_plane, std::sqrt(apart2)) - radius);
    }
    std::sort(minima.begin(), minima.end(), [](const Minimum& a, const Minimum& b) {
      return a.squared_distance != b.squared_distance ? a.squared_distance < b.squared_distance
                                                      : a.facet < b.facet;
    });
    const std::size_t before = contacts.size();
    for (const Minimum& minimum : minima) {
      if (minimum.feature != triangle_face && closer_across(minimum, minima)) {
        continue;
      }
      const SurfaceContact contact = made(minimum, centre, radius);
      const bool counted = std::any_of(
          contacts.begin() + static_cast<std::ptrdiff_t>(before), contacts.end(),
          [&](const SurfaceContact& deeper) { return deeper.normal.dot(contact.normal) > same_direction; });
      if (!counted) {
        contacts.push_back(contact);
      }
    }
    return 0.0;
  }

private:
  static constexpr double same_direction = 0.9848; // cos 10 degrees; ours

  struct Minimum {
    double squared_distance;
    std::uint32_t facet;
    TriangleFeature feature;
    Vector point;
  };

  using Point = boost::geometry::model::point<double, 3, boost::geometry::cs::cartesian>;
  using Box = boost::geometry::model::box<Point>;
  using Indexed = std::pair<Box, std::uint32_t>;
  using Tree = boost::geometry::index::rtree<Indexed, boost::geometry::index::rstar<16>>;

  static Point point(const Vector& v) { return {v.x(), v.y(), v.z()}; }

  /// Whether another facet that shares the edge or vertex comes closer: then this is no minimum of the
  /// surface.
  template <class Minima>
  [[nodiscard]] bool closer_across(const Minimum& minimum, const Minima& minima) const {
    const double much_closer = minimum.squared_distance * (1.0 - 1e-12);
    for (const Minimum& other : minima) {
      if (other.squared_distance > minimum.squared_distance * (1.0 + 1e-12)) {
        break; // sorted: no other is closer
      }
      // At a seam a face and its edge are equally near up to rounding: the face has the better normal.
      if ((other.feature == triangle_face || other.squared_distance < much_closer) &&
          shares(minimum, other.facet)) {
        return true;
      }
    }
    return false;
  }

  [[nodiscard]] bool shares(const Minimum& minimum, std::uint32_t facet) const {
    const auto& own = mesh_.facets[minimum.facet];
    const auto& others = mesh_.facets[facet];
    for (unsigned k = 0; k < 3; ++k) {
      if ((minimum.feature >> k & 1U) != 0 &&
          std::find(others.begin(), others.end(), own[k]) == others.end()) {
        return false;
      }
    }
    return true;
  }

  [[nodiscard]] SurfaceContact made(const Minimum& minimum, const Vector& centre, double radius) const {
    const Vector& facet_normal = normals_[minimum.facet];
    if (minimum.feature == triangle_face) {
      const double height = (centre - mesh_.vertices[mesh_.facets[minimum.facet][0]]).dot(facet_normal);
      return {height < 0.0 ? Vector(-facet_normal) : facet_normal, radius - std::abs(height), minimum.point};
    }
    const double distance = std::sqrt(minimum.squared_distance);
    const Vector normal = distance > 0.0 ? Vector((centre - minimum.point) / distance) : facet_normal;
    return {normal, radius - distance, minimum.point};
  }

  TriangleMesh mesh_;
  std::vector<Vector> normals_;
  Eigen::AlignedBox3d bounds_;
  Tree tree_;
};

} // namespace scree
