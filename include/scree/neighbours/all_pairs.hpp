#pragma once
/// \file
/// Every pair is looked at: the oracle of the other searches.

#include "scree/neighbours/concept.hpp"

namespace scree {

/// O(n^2); for tests and a handful of bodies.
struct AllPairs {
  [[nodiscard]] static double skin(double) { return 0.0; }

  void find(std::span<const Ball> balls, std::size_t owned, double margin, Workers& workers,
            CandidateRows& rows) const {
    rows.build(owned, workers, [&](std::size_t i, std::vector<std::uint32_t>& row) {
      for (std::size_t k = i + 1; k < balls.size(); ++k) {
        if (within(balls[i], balls[k], margin)) {
          row.push_back(static_cast<std::uint32_t>(k));
        }
      }
    });
  }
};

} // namespace scree
