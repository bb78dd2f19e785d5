#pragma once
/// \file
/// The check that loose_lattice() and loose_pile() share.

#include "scree/core/error.hpp"
#include "scree/packing/assembly.hpp"

#include <algorithm>
#include <span>
#include <vector>

namespace scree::detail {

/// Largest bounding diameter [m] of the drawn clumps, `gap` (a fraction of it) included; zero if there are
/// none.
/// \throws Error for a shape that does not exist, a scale not above zero, or a footprint narrower than that.
inline double require_placeable(const std::vector<Clump>& shapes, std::span<const DrawnClump> drawn,
                                const Eigen::AlignedBox3d& footprint, double gap) {
  double largest = 0.0;
  for (const DrawnClump& d : drawn) {
    if (d.shape >= shapes.size()) {
      throw Error(message("a drawn clump has shape ", d.shape, ", but there are only ", shapes.size()));
    }
    require_positive("scale of a drawn clump", d.scale);
    largest = std::max(largest, 2.0 * (1.0 + gap) * d.scale * shapes[d.shape].bounding_radius);
  }
  const Vector size = footprint.sizes();
  if (!drawn.empty() && !(size.x() >= largest && size.y() >= largest && size.allFinite())) {
    throw Error(message("footprint of ", size.x(), " m by ", size.y(), " m does not hold the largest body, ",
                        largest, " m across with its gap"));
  }
  return largest;
}

} // namespace scree::detail
