/// \brief A wall dynamics of your own: grains are weighed by a pan on a spring
/// \smoke
#include "scree/simulation/run.hpp"
#include "scree/simulation/simulation.hpp"

#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

using namespace scree;

/// Moves up and down on a spring and a dashpot; stands at rest under its own weight at the start.
struct SpringMounted {
  double mass;      ///< kg, above 0
  double stiffness; ///< N/m, above 0
  double damping;   ///< N s/m, 0 or above
  double rest = 0.0;

  void start(WallMotion& motion, const TimeStep&) { rest = motion.position.z(); }

  /// Leapfrog: the velocity goes on by `step.kick`, then the position by `step.dt`.
  void advance(WallMotion& motion, const WallLoad& load, const TimeStep& step) const {
    const double force = load.force.z() + stiffness * (rest - motion.position.z());
    // The dashpot is taken at the new velocity, so that any damping is stable.
    const double v = (motion.velocity.z() + step.kick * force / mass) / (1.0 + step.kick * damping / mass);
    motion.velocity = {0.0, 0.0, v};
    motion.position.z() += v * step.dt;
  }

  // For the stable time step: how easily it gives way to the grains, what else holds it, and what that is.
  double mobility(double) const { return 1.0 / mass; }
  double squared_frequency() const { return stiffness / mass; }
  std::string holder() const { return message("a spring of ", stiffness, " N/m"); }
};

struct Scale : DefaultModel {
  using Walls = scree::Walls<SpringMounted>; // every kind that the simulation may have
};

int main() {
  Simulation<Scale> sim;
  const auto rock = sim.add_material({.normal_stiffness = 5e4, .shear_stiffness = 5e4, .restitution = 0.3});
  const Clump ball = make_clump("ball", std::vector<Sphere>{{Vector::Zero(), 0.01}});
  const SpringMounted spring{.mass = 0.5, .stiffness = 1000.0, .damping = 20.0};
  const auto pan = sim.add_wall({.name = "pan", .surfaces = {{Plane{}, rock}}, .dynamics = spring});
  for (int i = 0; i < 20; ++i) {
    sim.add(
        {.clump = &ball, .material = rock, .position = {0.03 * (i % 5), 0.03 * (i / 5), 0.02 + 0.002 * i}});
  }
  const auto shown = [&] { return spring.stiffness * (0.0 - sim.wall(pan).motion.position.z()); };
  run_for(sim, 1.5, Every{0.25, [&](const auto& s) { std::printf("%.2f s: %5.2f N\n", s.time(), shown()); }});

  const double weight = 20 * 9.81 * sim.bodies().mass(0);
  std::printf("the scale shows %.4f N, the grains weigh %.4f N\n", shown(), weight);
  return std::abs(shown() / weight - 1.0) < 1e-3 ? 0 : 1;
}
