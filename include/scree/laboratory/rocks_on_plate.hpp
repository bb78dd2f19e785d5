#pragma once
/// \file
/// Single rocks apart from each other.

#include "scree/core/random.hpp"
#include "scree/material/material.hpp"
#include "scree/packing/assembly.hpp"
#include "scree/packing/packing.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace scree {

/// The drawn rocks about the origin, each turned at random.
inline Packing turned_rocks(const Assembly& assembly, const std::vector<DrawnClump>& drawn,
                            MaterialId material, Random& random) {
  Packing rocks{assembly.clumps(), {}};
  for (const DrawnClump& grain : drawn) {
    PackedBody body;
    body.shape = static_cast<std::uint32_t>(grain.shape);
    body.scale = grain.scale;
    body.orientation = random.orientation();
    body.material = material;
    rocks.bodies.push_back(body);
  }
  return rocks;
}

/// Puts rocks in rows over the plane z = 0, each `pitch` [m] from the next, its lowest point at `gap` [m].
inline void place_in_rows(Packing& rocks, double pitch, double gap) {
  const auto row = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(rocks.bodies.size()))));
  for (std::size_t k = 0; k < rocks.bodies.size(); ++k) {
    PackedBody& body = rocks.bodies[k];
    body.position = Vector::Zero();
    double lowest = std::numeric_limits<double>::infinity();
    for (const Sphere& s : spheres_in_space(rocks, body)) {
      lowest = std::min(lowest, s.centre.z() - s.radius);
    }
    const std::size_t line = k / row;
    body.position = {pitch * static_cast<double>(k % row), pitch * static_cast<double>(line), gap - lowest};
  }
}

} // namespace scree
