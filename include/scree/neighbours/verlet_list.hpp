#pragma once
/// \file
/// A search whose result is kept while nothing has moved further than a skin.

#include "scree/neighbours/concept.hpp"

namespace scree {

/// Lists pairs with a gap of up to `thickness` and searches anew only when two of them could have closed it.
template <NeighbourSearch Search>
struct VerletList {
  double thickness = 0.0; ///< m, 0 or above; 0: `share` of the smallest radius
  double share = 0.3;     ///< of the smallest radius; ours
  Search search{};

  [[nodiscard]] double skin(double smallest_radius) const {
    return thickness > 0.0 ? thickness : share * smallest_radius;
  }

  void find(std::span<const Ball> balls, std::size_t owned, double margin, Workers& workers,
            CandidateRows& rows) {
    search.find(balls, owned, margin, workers, rows);
  }
};

} // namespace scree
