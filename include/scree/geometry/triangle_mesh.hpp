#pragma once
/// \file
/// A surface of triangles that share vertices.

#include "scree/core/linear.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace scree {

/// Triangles over shared vertices. A surface is touched from both sides; the order of a facet's vertices
/// (right hand rule for the outward normal) matters only where a closed solid is meant.
struct TriangleMesh {
  using Facet = std::array<std::uint32_t, 3>;

  std::vector<Vector> vertices; ///< m
  std::vector<Facet> facets;    ///< indices into `vertices`

  [[nodiscard]] std::array<Vector, 3> corners(std::size_t facet) const {
    const auto& f = facets[facet];
    return {vertices[f[0]], vertices[f[1]], vertices[f[2]]};
  }
};

} // namespace scree
