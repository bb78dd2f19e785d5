#pragma once
/// \file
/// Meshes of known shape.

#include "scree/geometry/triangle_mesh.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>

namespace scree::test {

/// A closed box about the origin with its edges along the axes: 8 vertices and 12 facets with outward
/// normals.
inline TriangleMesh box_mesh(const Vector& sizes) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) {
    const Vector sign{i & 1 ? 0.5 : -0.5, i & 2 ? 0.5 : -0.5, i & 4 ? 0.5 : -0.5};
    mesh.vertices.push_back(sign.cwiseProduct(sizes));
  }
  mesh.facets = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                 {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

/// A closed sphere about the origin: an octahedron whose facets are divided in four `divisions` times, all
/// vertices on the sphere.
inline TriangleMesh sphere_mesh(double radius, int divisions) {
  TriangleMesh mesh;
  mesh.vertices = {{radius, 0, 0},  {-radius, 0, 0}, {0, radius, 0},
                   {0, -radius, 0}, {0, 0, radius},  {0, 0, -radius}};
  mesh.facets = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int i = 0; i < divisions; ++i) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [entry, fresh] =
          middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(mesh.vertices.size()));
      if (fresh) {
        mesh.vertices.push_back(radius * (mesh.vertices[a] + mesh.vertices[b]).normalized());
      }
      return entry->second;
    };
    std::vector<TriangleMesh::Facet> finer;
    for (const auto& [a, b, c] : mesh.facets) {
      const auto ab = middle(a, b);
      const auto bc = middle(b, c);
      const auto ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    mesh.facets = std::move(finer);
  }
  return mesh;
}

/// The same surface with three vertices of its own for every facet, as in an STL file.
inline TriangleMesh soup(const TriangleMesh& mesh) {
  TriangleMesh loose;
  for (std::size_t i = 0; i < mesh.facets.size(); ++i) {
    const auto corners = mesh.corners(i);
    loose.vertices.insert(loose.vertices.end(), corners.begin(), corners.end());
    const auto next = static_cast<std::uint32_t>(loose.vertices.size());
    loose.facets.push_back({next - 3, next - 2, next - 1});
  }
  return loose;
}

} // namespace scree::test
