#pragma once
/// \file
/// Which observables a parameter can change.

#include "scree/calibrate/measured.hpp"
#include "scree/calibrate/parameter.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace scree {

/// For each observable the parameters that can change it, ascending. Runs tell of all others that they change
/// it hardly, but never that they do not; where that is known, it says much.
using Reach = std::vector<std::vector<Eigen::Index>>;

inline bool can_change(const Parameter& parameter, const Measured& observable) {
  const auto& kinds = parameter.touches;
  return kinds.empty() || observable.kind.empty() ||
         std::find(kinds.begin(), kinds.end(), observable.kind) != kinds.end();
}

inline Reach reach_of(std::span<const Parameter> parameters, std::span<const Measured> observables) {
  Reach out(observables.size());
  for (std::size_t m = 0; m < observables.size(); ++m) {
    for (std::size_t p = 0; p < parameters.size(); ++p) {
      if (can_change(parameters[p], observables[m])) {
        out[m].push_back(static_cast<Eigen::Index>(p));
      }
    }
  }
  return out;
}

} // namespace scree
