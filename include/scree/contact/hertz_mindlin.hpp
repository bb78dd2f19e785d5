#pragma once
/// \file
/// Elastic spheres.

#include "scree/contact/frictional.hpp"

#include <cmath>

namespace scree {

/// Hertz's normal force F_n = 4/3 E* sqrt(R*) U_n^(3/2) and Mindlin's tangential stiffness k_s = 8 G* sqrt(R*
/// U_n) without partial slip, loaded in increments; when the overlap falls, the spring is reduced with its
/// stiffness so that unloading makes no energy (Thornton, Cummins & Cleary, Powder Technol. 233:30, 2013).
/// Dashpots 2 sqrt(5/6) beta sqrt(S m*) with S the tangent stiffness (Tsuji, Tanaka & Ishida, Powder Technol.
/// 71:239, 1992) and beta the damping ratio of the restitution, which is the linear law's
/// (material/restitution.hpp).
///
/// History: sqrt(R* U_n) of the step before [m].
struct HertzModel {
  static constexpr int history_size = 1;
  static constexpr std::array<int, 1> history_parity{1};

  static void check(const PairMaterial<double>& pair, std::string_view names) {
    if (!(pair.youngs_modulus > 0.0)) {
      throw Error(message("materials ", names, ": youngs_modulus gives E* = ", pair.youngs_modulus,
                          " Pa at the contact, which must be above 0 for a Hertzian law"));
    }
  }

  /// At the largest overlap of a free impact, U = (15 m* v^2 / (16 E* sqrt(R*)))^(2/5).
  static ContactStiffness stiffness(const PairMaterial<double>& pair, double reduced_radius,
                                    double reduced_mass, double speed) {
    const double overlap = std::pow(
        15.0 * reduced_mass * speed * speed / (16.0 * pair.youngs_modulus * std::sqrt(reduced_radius)), 0.4);
    const double a = std::sqrt(reduced_radius * overlap);
    return {2.0 * pair.youngs_modulus * a, 8.0 * pair.shear_modulus * a};
  }
  static double elastic_energy(const PairMaterial<double>& pair, double reduced_radius, double overlap) {
    return 8.0 / 15.0 * pair.youngs_modulus * std::sqrt(reduced_radius * overlap) * overlap * overlap;
  }
  static double inverse_shear_stiffness(const PairMaterial<double>& pair, double reduced_radius,
                                        double overlap) {
    const double k = 8.0 * pair.shear_modulus * std::sqrt(reduced_radius * overlap);
    return k > 0.0 ? 1.0 / k : 0.0;
  }

  template <class T>
  static SpringDashpot<T> evaluate(const PairMaterial<T>& pair, const Kinematics<T>& k, Vec3<T>& spring,
                                   std::span<T, 1> history) {
    const T a = square_root(k.reduced_radius * k.overlap);
    const T before = history[0];
    const T spring2 = squared_norm(spring);
    const auto unloading = a < history[0];
    spring *= select(unloading, a / select(unloading, history[0], T(1)), T(1));
    history[0] = a;
    const T normal = T(2) * pair.youngs_modulus * a;
    const T shear = T(8) * pair.shear_modulus * a;
    const T critical = T(1.8257418583505538); // 2 sqrt(5/6)
    const auto sheared = shear > T(0);
    const auto known = before > T(0);
    const T energy = select(known, spring2 / select(known, T(16) * pair.shear_modulus * before, T(1)), T(0));
    const T low = select(a < before, a, before), high = larger(a, before);
    const T spring_loss = energy * (T(1) - low / high);
    return {T(2.0 / 3.0) * normal * k.overlap,
            normal,
            shear,
            select(sheared, T(1) / select(sheared, shear, T(1)), T(0)),
            multiply_add(pair.normal_damping_rate, k.reduced_mass,
                         critical * pair.damping_ratio * square_root(normal * k.reduced_mass)),
            multiply_add(pair.shear_damping_rate, k.reduced_mass,
                         critical * pair.shear_damping_ratio * square_root(shear * k.reduced_mass)),
            spring_loss};
  }
};

/// The Hertz-Mindlin law with any extensions.
template <class... Extensions>
using HertzMindlin = FrictionalLaw<HertzModel, Extensions...>;

} // namespace scree
