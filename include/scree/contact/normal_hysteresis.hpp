#pragma once
/// \file
/// A normal spring that is stiffer in unloading, as asperities yield.

#include "scree/contact/frictional.hpp"

namespace scree {

/// Walton & Braun (J. Rheol. 30:949, 1986) on the linear spring: loaded for the first time F = k_n U,
/// unloaded and loaded again F = r k_n (U - U_p) up to the largest overlap so far U_m, with U_p = U_m (1 -
/// 1/r), never below 0. What a contact yields is forgotten when it ends. A ratio r of 1 gives the base law to
/// the bit. For linear laws only.
///
/// History: U_m [m]. What yielding takes counts as frictional work.
struct NormalHysteresis {
  double ratio = 1.0; ///< r, unloading over loading stiffness, 1 or above

  static constexpr int history_size = 1;
  static constexpr std::array<int, 1> history_parity{1};

  void check(const PairMaterial<double>& pair, std::string_view names) const {
    require("NormalHysteresis::ratio", ratio, {1.0, 1e3});
    if (!(pair.normal_stiffness > 0.0)) {
      throw Error(message("materials ", names,
                          ": NormalHysteresis extends a linear law, and normal_stiffness = ",
                          pair.normal_stiffness, " N/m at the contact"));
    }
  }

  ContactStiffness stiffness(ContactStiffness base, const PairMaterial<double>&, double, double,
                             double) const {
    return {ratio * base.normal, base.shear};
  }

  template <class T>
  T normal(const PairMaterial<T>& pair, const Kinematics<T>& k, T normal_force, std::span<T, 1> history,
           T& lost_work) const {
    const T before = history[0], most = larger(before, k.overlap);
    history[0] = most;
    const T first = pair.normal_stiffness * k.overlap;
    const T again = T(ratio) * pair.normal_stiffness * (k.overlap - most * T(share()));
    const T spring = larger(select(again < first, again, first), T(0));
    // Of the energy of first loading, k_n U_m^2 / 2, the spring gives back 1/r.
    lost_work += T(0.5 * share()) * pair.normal_stiffness * (most * most - before * before);
    return larger(normal_force + (spring - first), T(0));
  }
  double elastic_energy(const PairMaterial<double>& pair, double, double overlap,
                        std::span<const double, 1> history) const {
    const double k = pair.normal_stiffness, most = larger(history[0], overlap);
    const double stretch = larger(overlap - most * share(), 0.0);
    return 0.5 * k * (ratio * stretch * stretch - overlap * overlap);
  }

private:
  [[nodiscard]] double share() const { return 1.0 - 1.0 / ratio; } // of U_m that stays
};

} // namespace scree
