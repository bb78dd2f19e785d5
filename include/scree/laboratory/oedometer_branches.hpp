#pragma once
/// \file
/// Tells loadings from unloadings in a measured curve of confined compression.

#include "scree/core/error.hpp"
#include "scree/laboratory/oedometer_cycle.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace scree {

/// The rows of a measured curve with their branches. A branch ends where the force was farthest, once it has
/// come back from there by more than `swing`: smaller swings are noise. The first branch is a loading.
/// \param displacement m, down is positive, in the order in which it was measured
/// \param force N, on the lid, of the same length
/// \param swing N, above 0; a fifth of the range of the cycles is a good choice
/// \throws Error for lengths that differ, fewer than three rows, or a swing that is not above 0.
inline std::vector<OedometerPoint> oedometer_branches(std::span<const double> displacement,
                                                      std::span<const double> force, double swing) {
  require_positive("oedometer curve: swing", swing, "N");
  if (displacement.size() != force.size() || force.size() < 3) {
    throw Error(message("oedometer curve: ", displacement.size(), " displacements and ", force.size(),
                        " forces; three of each are the least"));
  }
  std::vector<OedometerPoint> rows;
  for (std::size_t k = 0; k < force.size(); ++k) {
    rows.push_back({.time = static_cast<double>(k), .displacement = displacement[k], .lid_force = force[k]});
  }
  std::size_t begin = 0, farthest = 0, cycle = 0;
  bool loading = true;
  const auto end_branch = [&](std::size_t last) {
    for (std::size_t k = begin; k <= last; ++k) {
      rows[k].cycle = cycle;
      rows[k].loading = loading;
    }
    begin = last + 1;
  };
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const double ahead = loading ? force[k] - force[farthest] : force[farthest] - force[k];
    if (ahead >= 0.0) {
      farthest = k;
    } else if (-ahead > swing) {
      end_branch(farthest);
      cycle += loading ? 0 : 1;
      loading = !loading;
      farthest = k;
    }
  }
  end_branch(rows.size() - 1);
  return rows;
}

} // namespace scree
