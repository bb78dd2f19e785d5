#pragma once
/// \file
/// Welds the vertices of a mesh, so that facets that meet share the vertices where they meet.

#include "scree/core/error.hpp"
#include "scree/geometry/triangle_mesh.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace scree {

namespace detail {

/// Three coordinates, or the three numbers of a grid cell. They stay doubles, because the cell of an outlying
/// vertex may have a number beyond any integer type.
using GridKey = std::array<double, 3>;

struct GridKeyHash {
  std::size_t operator()(const GridKey& key) const {
    std::uint64_t h = 0;
    for (const double number : key) {
      h = (h ^ std::bit_cast<std::uint64_t>(number)) * 0x9e3779b97f4a7c15ULL;
      h ^= h >> 32;
    }
    return static_cast<std::size_t>(h);
  }
};

/// Vertices in cells twice as wide as the tolerance, so that all that lie within the tolerance of a point are
/// in the eight cells nearest to it.
class WeldGrid {
public:
  explicit WeldGrid(double tolerance) : tolerance_{tolerance} {}

  /// The first of `vertices` within the tolerance of `point`; a vertex is added where there is none.
  std::uint32_t find_or_add(const Vector& point, std::vector<Vector>& vertices) {
    const Vector scaled = point / (2.0 * tolerance_);
    auto found = none;
    for (int corner = 0; corner < 8; ++corner) {
      GridKey cell;
      for (int axis = 0; axis < 3; ++axis) {
        // Adding 0.0 turns a negative zero, which has bits of its own, into zero.
        cell[static_cast<std::size_t>(axis)] = std::floor(scaled[axis] - 0.5) + ((corner >> axis) & 1) + 0.0;
      }
      const auto head = newest_in_cell_.find(cell);
      if (head == newest_in_cell_.end()) {
        continue;
      }
      for (auto v = head->second; v != none; v = older_in_cell_[v]) {
        if ((vertices[v] - point).norm() <= tolerance_ && v < found) {
          found = v;
        }
      }
    }
    if (found != none) {
      return found;
    }
    const auto added = static_cast<std::uint32_t>(vertices.size());
    vertices.push_back(point);
    const GridKey own{std::floor(scaled.x()) + 0.0, std::floor(scaled.y()) + 0.0,
                      std::floor(scaled.z()) + 0.0};
    const auto [head, first] = newest_in_cell_.try_emplace(own, none);
    older_in_cell_.resize(vertices.size(), none);
    older_in_cell_[added] = head->second;
    head->second = added;
    return added;
  }

private:
  static constexpr std::uint32_t none = 0xffffffffU;

  double tolerance_;
  std::unordered_map<GridKey, std::uint32_t, GridKeyHash> newest_in_cell_;
  std::vector<std::uint32_t> older_in_cell_;
};

} // namespace detail

/// The mesh with every vertex replaced by the first vertex kept within `tolerance` of it. Vertices are kept
/// in their order and chains are not followed: a vertex moves by at most the tolerance.
///
/// Facets keep their number, also those that collapse to an edge or a point; see without_collapsed_facets().
/// \param tolerance m, at least 0; 0 welds vertices with equal coordinates.
/// \throws Error for a tolerance that is negative or not finite.
inline TriangleMesh weld(const TriangleMesh& mesh, double tolerance) {
  if (!(tolerance >= 0.0 && std::isfinite(tolerance))) {
    throw Error(message("weld tolerance = ", tolerance, " m must be a finite number of at least 0"));
  }
  TriangleMesh welded;
  std::vector<std::uint32_t> renumbered(mesh.vertices.size());
  // Most vertices of a triangle soup are exact copies; those are found without looking at any neighbours.
  std::unordered_map<detail::GridKey, std::uint32_t, detail::GridKeyHash> exact;
  detail::WeldGrid grid{tolerance};
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const auto& v = mesh.vertices[i];
    const auto [entry, fresh] = exact.try_emplace({v.x() + 0.0, v.y() + 0.0, v.z() + 0.0}, 0U);
    if (fresh && tolerance > 0.0) {
      entry->second = grid.find_or_add(v, welded.vertices);
    } else if (fresh) {
      entry->second = static_cast<std::uint32_t>(welded.vertices.size());
      welded.vertices.push_back(v);
    }
    renumbered[i] = entry->second;
  }
  welded.facets.reserve(mesh.facets.size());
  for (const auto& f : mesh.facets) {
    welded.facets.push_back({renumbered[f[0]], renumbered[f[1]], renumbered[f[2]]});
  }
  return welded;
}

/// The mesh without the facets that name a vertex twice. Its neighbours across the edge that is left then
/// meet, so that this opens no gap; a facet with three different vertices on one line is needed and stays.
inline TriangleMesh without_collapsed_facets(TriangleMesh mesh) {
  std::erase_if(mesh.facets,
                [](const TriangleMesh::Facet& f) { return f[0] == f[1] || f[1] == f[2] || f[2] == f[0]; });
  return mesh;
}

} // namespace scree
