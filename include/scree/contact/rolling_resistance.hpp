#pragma once
/// \file
/// Resistance of a contact to rolling.

#include "scree/contact/frictional.hpp"

#include <limits>

namespace scree {

/// Elastic-plastic rolling spring and dashpot (model C of Ai, Chen, Rotter & Ooi, Powder Technol. 206:269,
/// 2011): the couple grows by k_r times the relative rolling, k_r = 2.25 k_n mu_r^2 R*^2, up to mu_r R* F_n.
/// Below that limit a dashpot adds c_r times the rate of rolling, c_r = 2 damping sqrt(I_r k_r). I_r is
/// 7/5 m* R*^2, that of a sphere on a plane; between spheres the paper's is larger (ours, as a contact knows
/// no more). `Material::rolling_friction` is mu_r; 0 gives the base law to the bit.
///
/// History: the rolling couple of the spring on i [N m]. What the dashpot takes counts as frictional work.
struct RollingResistance {
  double damping = 0.0; ///< of critical, 0 or above; without it a grain on rolling springs rocks for good

  static constexpr int history_size = 3;
  static constexpr std::array<int, 3> history_parity{-1, -1, -1};

  void check(const PairMaterial<double>&, std::string_view) const {
    require("RollingResistance::damping", damping, {0.0, std::numeric_limits<double>::max()});
  }

  template <class T>
  Vec3<T> couple(const PairMaterial<T>& pair, const Kinematics<T>& k, T normal_stiffness, T normal_force,
                 std::span<T, 3> history, T& frictional_work) const {
    const Vec3<T> old = turned_with_contact(Vec3<T>{history[0], history[1], history[2]}, k);
    const Vec3<T> spin = k.spin_i - k.spin_j;
    const Vec3<T> rolling = negated_multiply_add(k.normal, dot(spin, k.normal), spin);
    const T reach = pair.rolling_friction * k.reduced_radius;
    const T stiffness = T(2.25) * normal_stiffness * reach * reach;
    const T limit = reach * larger(normal_force, T(0));
    const Vec3<T> trial = negated_multiply_add(rolling, stiffness * k.dt, old);
    const T size2 = squared_norm(trial);
    const auto over = size2 > limit * limit;
    Vec3<T> kept = trial;
    if (any(over)) {
      kept = trial * select(over, limit * reciprocal_square_root(select(over, size2, T(1))), T(1));
      const auto some = stiffness > T(0);
      frictional_work += select(some, dot(kept, trial - kept) / select(some, stiffness, T(1)), T(0));
    }
    history[0] = kept.x;
    history[1] = kept.y;
    history[2] = kept.z;
    if (damping == 0.0) {
      return kept;
    }
    const T inertia = T(1.4) * k.reduced_mass * k.reduced_radius * k.reduced_radius;
    const T dashpot = select(over, T(0), T(2.0 * damping) * square_root(inertia * stiffness));
    frictional_work += dashpot * squared_norm(rolling) * k.dt;
    return negated_multiply_add(rolling, dashpot, kept);
  }
};

} // namespace scree
