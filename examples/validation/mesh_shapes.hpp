#pragma once
/// \file
/// Planes and tubes as triangle meshes, for what a mesh must do as the analytic wall does.

#include "scree/core/random.hpp"
#include "scree/geometry/tessellation.hpp"

#include <cmath>
#include <cstdint>
#include <numbers>

namespace validation {

/// A square plate about the origin with its normal along `turn` times z.
/// \param side m; \param cells along each side, of two facets each
/// \param jitter by which inner vertices are moved within the plate, as a share of a cell, below 0.4
inline scree::TriangleMesh plate(double side, int cells, double jitter, const scree::Quaternion& turn) {
  scree::TriangleMesh mesh;
  scree::Random random{1, "plate"};
  const double cell = side / cells;
  const auto inner = [&](int i) { return i > 0 && i < cells; };
  for (int i = 0; i <= cells; ++i) {
    for (int j = 0; j <= cells; ++j) {
      const double dx = jitter * cell * random.uniform(-1.0, 1.0);
      const double dy = jitter * cell * random.uniform(-1.0, 1.0);
      mesh.vertices.push_back(turn * scree::Vector{-0.5 * side + i * cell + (inner(i) ? dx : 0.0),
                                                   -0.5 * side + j * cell + (inner(j) ? dy : 0.0), 0.0});
    }
  }
  for (int i = 0; i < cells; ++i) {
    for (int j = 0; j < cells; ++j) {
      const auto at = [&](int a, int b) { return static_cast<std::uint32_t>(a * (cells + 1) + b); };
      mesh.facets.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
      mesh.facets.push_back({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

/// A tube along z from `low` to `high` [m], as a prism of `sides` sides with its edges at `radius` [m].
inline scree::TriangleMesh prism(double radius, int sides, double low, double high) {
  scree::TriangleMesh mesh;
  for (int k = 0; k < sides; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / sides;
    for (const double z : {low, high}) {
      mesh.vertices.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
    }
  }
  for (int k = 0; k < sides; ++k) {
    const auto a = static_cast<std::uint32_t>(2 * k), b = static_cast<std::uint32_t>(2 * ((k + 1) % sides));
    mesh.facets.push_back({a, b, a + 1});
    mesh.facets.push_back({b, b + 1, a + 1});
  }
  return mesh;
}

} // namespace validation
