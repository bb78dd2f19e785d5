#pragma once
/// \file
/// A normal spring that stiffens.

#include "scree/contact/frictional.hpp"

#include <algorithm>
#include <cmath>

namespace scree {

/// Makes the linear spring F = k_n U one of F = k_n U_0 (U / U_0)^n, which is as strong at U_0, a given share
/// of the reduced radius. An exponent of 1 gives the base law to the bit; 1.5 is Hertz's. The dashpot stays
/// that of the linear spring. For linear laws only.
struct NormalExponent {
  double exponent = 1.0;   ///< n, 1 to 2
  double reference = 0.01; ///< U_0 over the reduced radius, above 0

  static constexpr int history_size = 0;
  static constexpr std::array<int, 0> history_parity{};

  void check(const PairMaterial<double>& pair, std::string_view names) const {
    require("NormalExponent::exponent", exponent, {1.0, 2.0});
    require_positive("NormalExponent::reference", reference);
    if (!(pair.normal_stiffness > 0.0)) {
      throw Error(message("materials ", names,
                          ": NormalExponent extends a linear law, and normal_stiffness = ",
                          pair.normal_stiffness, " N/m at the contact"));
    }
  }

  /// At the largest overlap of a free impact; not below the linear spring's, which small overlaps undercut.
  ContactStiffness stiffness(ContactStiffness base, const PairMaterial<double>& pair, double reduced_radius,
                             double reduced_mass, double speed) const {
    const double k = pair.normal_stiffness, u0 = reference * reduced_radius;
    const double overlap =
        std::pow(0.5 * (exponent + 1.0) * reduced_mass * speed * speed * std::pow(u0, exponent - 1.0) / k,
                 1.0 / (exponent + 1.0));
    return {base.normal * std::max(1.0, exponent * std::pow(overlap / u0, exponent - 1.0)), base.shear};
  }

  template <class T>
  T normal(const PairMaterial<T>& pair, const Kinematics<T>& k, T normal_force, std::span<T, 0>, T&) const {
    const T factor = power(k.overlap / (T(reference) * k.reduced_radius), exponent - 1.0);
    return larger(normal_force + pair.normal_stiffness * k.overlap * (factor - T(1)), T(0));
  }
  double elastic_energy(const PairMaterial<double>& pair, double reduced_radius, double overlap,
                        std::span<const double, 0>) const {
    const double factor = std::pow(overlap / (reference * reduced_radius), exponent - 1.0);
    return pair.normal_stiffness * overlap * overlap * (factor / (exponent + 1.0) - 0.5);
  }
};

} // namespace scree
