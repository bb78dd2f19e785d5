/// \brief A part of your own added to a contact law of the library: grains that stick together
/// \smoke
#include "scree/simulation/run.hpp"
#include "scree/simulation/simulation.hpp"

#include <cmath>
#include <cstdio>
#include <vector>

using namespace scree;

/// Pulls two grains together with a constant force while they touch, as a film of water between them does. No
/// force below `pull` parts them, and a sliding contact feels friction under the load that is left. With a
/// pull of 0 the law that it extends is unchanged to the bit.
struct WaterFilm {
  double pull = 0.0; ///< N, 0 or above

  static constexpr int history_size = 0; // remembers nothing of a contact
  static constexpr std::array<int, 0> history_parity{};

  /// Called with the normal force of the law [N], before the friction limit is taken from it.
  template <class T>
  T normal(const PairMaterial<T>&, const Kinematics<T>&, T normal_force, std::span<T, 0>, T&) const {
    return normal_force - T(pull);
  }
};

struct WetGrains : DefaultModel {
  using Contact = LinearSpring<WaterFilm>;
};

int main() {
  // A plate holds a ball with 0.5 N, and gravity lifts the ball ever harder until it comes off.
  const double pull = 0.5;
  const WetGrains::Contact law{WaterFilm{.pull = pull}};
  Simulation<WetGrains> sim{{.contact = law, .gravity = Vector::Zero()}};
  const auto rock = sim.add_material({.normal_stiffness = 1e5, .shear_stiffness = 1e5, .restitution = 0.3});
  const Clump ball = make_clump("ball", std::vector<Sphere>{{Vector::Zero(), 0.01}});
  sim.add({.clump = &ball, .material = rock, .position = {0.0, 0.0, 0.00999}});
  const auto plate = sim.add_wall({.name = "plate", .surfaces = {{Plane{}, rock}}, .dynamics = Fixed{}});

  run_for(sim, 0.05); // the ball is drawn in until spring and pull balance
  const double start = sim.time();
  const auto lift = [&] { return 0.5 * (sim.time() - start); }; // N, by 0.5 N a second
  const auto held = [&](const auto& s) { return s.wall(plate).load.contacts > 0 && lift() < 2.0 * pull; };
  run_while(sim, held, [&](auto& s) { s.set_gravity({0.0, 0.0, lift() / s.bodies().mass(0)}); });
  std::printf("pull-off force %.4f N, expected %.4f N\n", lift(), pull);
  return std::abs(lift() / pull - 1.0) < 0.01 ? 0 : 1;
}
