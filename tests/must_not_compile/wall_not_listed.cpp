// expect: error: .*scree: Model::Walls does not list this wall dynamics
#include "scree/simulation/simulation.hpp"

struct Dynamics {
  static void start(scree::WallMotion&, const scree::TimeStep&) {}
  static void advance(scree::WallMotion&, const scree::WallLoad&, const scree::TimeStep&) {}
};

int main() {
  scree::Simulation<> simulation;
  const auto rock = simulation.add_material({.normal_stiffness = 1e6});
  simulation.add_wall({.name = "floor", .surfaces = {{scree::Plane{}, rock}}, .dynamics = Dynamics{}});
}
