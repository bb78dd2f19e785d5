#pragma once
/// \file
/// Friction that changes with the speed of sliding.

#include "scree/contact/frictional.hpp"

#include <limits>

namespace scree {

/// mu (1 + b v) with the slip speed v, not below 0: the simplest dependence that there is, ours, to be fitted
/// over a small range of speeds. A slope of 0 gives the base law to the bit.
struct RateFriction {
  double slope = 0.0; ///< s/m, b

  static constexpr int history_size = 0;
  static constexpr std::array<int, 0> history_parity{};

  void check(const PairMaterial<double>&, std::string_view) const {
    constexpr double most = std::numeric_limits<double>::max();
    require("RateFriction::slope", slope, {-most, most, "s/m"});
  }

  template <class T>
  T friction(const PairMaterial<T>&, const Kinematics<T>&, T coefficient, T slip_speed,
             std::span<T, 0>) const {
    return coefficient * larger(T(1) + T(slope) * slip_speed, T(0));
  }
};

} // namespace scree
