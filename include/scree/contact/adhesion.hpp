#pragma once
/// \file
/// Grains that stick together while they touch.

#include "scree/contact/frictional.hpp"

#include <limits>
#include <numbers>

namespace scree {

/// A pull of 2 pi w R* while there is overlap (Derjaguin, Muller & Toporov, J. Colloid Interface Sci. 53:314,
/// 1975, the force at which two spheres part), taken from the normal force before the friction limit. No pull
/// at a distance. A work of adhesion of 0 gives the base law to the bit.
struct Adhesion {
  double work = 0.0; ///< J/m2, w, 0 or above

  static constexpr int history_size = 0;
  static constexpr std::array<int, 0> history_parity{};

  void check(const PairMaterial<double>&, std::string_view) const {
    require("Adhesion::work", work, {0.0, std::numeric_limits<double>::max(), "J/m2"});
  }

  template <class T>
  T normal(const PairMaterial<T>&, const Kinematics<T>& k, T normal_force, std::span<T, 0>, T&) const {
    return normal_force - T(force_per_radius()) * k.reduced_radius;
  }
  double elastic_energy(const PairMaterial<double>&, double reduced_radius, double overlap,
                        std::span<const double, 0>) const {
    return -force_per_radius() * reduced_radius * overlap;
  }

private:
  [[nodiscard]] double force_per_radius() const { return 2.0 * std::numbers::pi * work; } // N/m
};

} // namespace scree
