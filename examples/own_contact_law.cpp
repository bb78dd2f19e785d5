/// \brief A contact law of your own: a spring that is stiffer on the way out than on the way in
/// \smoke
#include "scree/simulation/run.hpp"
#include "scree/simulation/simulation.hpp"

#include <cmath>
#include <cstdio>
#include <vector>

using namespace scree;

/// Walton & Braun (J. Rheol. 30:949, 1986), without friction: loads along k1, the stiffness of the pair,
/// unloads along k2 = ratio k1: F = max(0, min(k1 U, k2 U - (k2 - k1) U_max)). Restitution sqrt(k1 / k2).
struct WaltonBraun {
  using Pair = PairMaterial<double>;
  double ratio = 1.0;                                    ///< k2 / k1, 1 or above
  static constexpr int history_size = 1;                 // U_max [m]
  static constexpr std::array<int, 1> history_parity{1}; // a length: the same seen from i and from j

  static void check(const Pair& pair, std::string_view names) {
    require_positive(message("materials ", names, ": normal_stiffness"), pair.normal_stiffness, "N/m");
  }
  ContactStiffness stiffness(const Pair& pair, double, double, double) const {
    return {.normal = ratio * pair.normal_stiffness, .shear = 0.0};
  }
  double elastic_energy(const Pair& pair, double, double U, std::span<const double, 1> h) const {
    return 0.5 * std::pow(force(pair, U, h[0]), 2) / (ratio * pair.normal_stiffness);
  }
  template <class T> // float, double or a pack of either, hence no branch on the contact
  ContactForce<T> evaluate(const PairMaterial<T>& pair, const Kinematics<T>& k, std::array<T, 1>& h) const {
    const T before = h[0], now = larger(before, k.overlap);
    h[0] = now;
    const T yielded = T(0.5 - 0.5 / ratio) * pair.normal_stiffness * (now * now - before * before);
    return {force(pair, k.overlap, now), {}, {}, yielded, {}};
  }
  template <class T>
  T force(const PairMaterial<T>& pair, T U, T most) const {
    const T loading = U, unloading = T(ratio) * U - T(ratio - 1.0) * most;
    return pair.normal_stiffness * larger(T(0), -larger(-loading, -unloading));
  }
};

struct Clay : DefaultModel {
  using Contact = WaltonBraun;
};

int main() { // a ball meets a floor at 1 m/s
  Simulation<Clay> sim{{.contact = {.ratio = 4.0}, .gravity = Vector::Zero(), .step_safety = 0.05}};
  const auto clay = sim.add_material({.name = "clay", .normal_stiffness = 1e5});
  const Clump ball = make_clump("ball", std::vector<Sphere>{{Vector::Zero(), 0.01}});
  sim.add({.clump = &ball, .material = clay, .position = {0, 0, 0.011}, .velocity = {0, 0, -1}});
  sim.add_wall({.name = "floor", .surfaces = {{Plane{}, clay}}, .dynamics = Fixed{}});
  run_for(sim, 0.01);
  const double rebound = sim.bodies().velocity(0).z(), mass = sim.bodies().mass(0);
  const double lost = 0.5 * mass * (1.0 - rebound * rebound), yielded = sim.dissipation().friction;
  std::printf("rebound %.4f m/s, expected 0.5 m/s; lost %.6f J, yielded %.6f J\n", rebound, lost, yielded);
  return std::abs(rebound - 0.5) < 1e-3 && std::abs(yielded / lost - 1.0) < 1e-3 ? 0 : 1;
}
