#pragma once
/// \file
/// Linear springs and dashpots.

#include "scree/contact/frictional.hpp"

namespace scree {

/// F_n = k_n U_n, F_s from k_s U_s (Coetzee et al. 2010 Eqs. (1)-(2)), dashpots in proportion to critical
/// damping so that a free normal impact has the requested restitution at any speed, and half an oscillation
/// in shear too (material/restitution.hpp).
struct LinearModel {
  static constexpr int history_size = 0;
  static constexpr std::array<int, 0> history_parity{};

  static void check(const PairMaterial<double>& pair, std::string_view names) {
    if (!(pair.normal_stiffness > 0.0)) {
      throw Error(message("materials ", names, ": normal_stiffness = ", pair.normal_stiffness,
                          " N/m at the contact must be above 0 for a linear law"));
    }
  }

  static ContactStiffness stiffness(const PairMaterial<double>& pair, double, double, double) {
    return {pair.normal_stiffness, pair.shear_stiffness};
  }
  static double elastic_energy(const PairMaterial<double>& pair, double, double overlap) {
    return 0.5 * pair.normal_stiffness * overlap * overlap;
  }
  static double inverse_shear_stiffness(const PairMaterial<double>& pair, double, double) {
    return pair.inverse_shear_stiffness;
  }

  template <class T>
  static SpringDashpot<T> evaluate(const PairMaterial<T>& pair, const Kinematics<T>& k, Vec3<T>&,
                                   std::span<T, 0>) {
    return {
        pair.normal_stiffness * k.overlap,
        pair.normal_stiffness,
        pair.shear_stiffness,
        pair.inverse_shear_stiffness,
        multiply_add(pair.normal_damping_rate, k.reduced_mass, pair.normal_damping_coefficient * k.root_mass),
        multiply_add(pair.shear_damping_rate, k.reduced_mass, pair.shear_damping_coefficient * k.root_mass)};
  }
};

/// The linear law with any extensions, e.g. `LinearSpring<RollingResistance>`.
template <class... Extensions>
using LinearSpring = FrictionalLaw<LinearModel, Extensions...>;

} // namespace scree
