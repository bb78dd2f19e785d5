#pragma once
/// \file
/// Friction that wears off.

#include "scree/contact/frictional.hpp"

#include <limits>

namespace scree {

/// mu / (1 + a W) with the work W that sliding has dissipated in this contact, which forgets it when it ends:
/// asperities that break off where grains stay together. Ours. A rate of 0 gives the base law to the bit.
///
/// History: W [J].
struct Attrition {
  double rate = 0.0; ///< 1/J, a, 0 or above

  static constexpr int history_size = 1;
  static constexpr std::array<int, 1> history_parity{1};

  void check(const PairMaterial<double>&, std::string_view) const {
    require("Attrition::rate", rate, {0.0, std::numeric_limits<double>::max(), "1/J"});
  }

  template <class T>
  T friction(const PairMaterial<T>&, const Kinematics<T>&, T coefficient, T, std::span<T, 1> history) const {
    return coefficient / (T(1) + T(rate) * history[0]);
  }
  template <class T>
  void slid(const PairMaterial<T>&, T work, std::span<T, 1> history) const {
    history[0] += larger(work, T(0));
  }
};

} // namespace scree
