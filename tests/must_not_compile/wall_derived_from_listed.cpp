// expect: error: .*scree: Model::Walls does not list this wall dynamics
#include "scree/simulation/simulation.hpp"

struct Dynamics : scree::Fixed {}; // a bare std::variant would take its Fixed part and drop the rest

int main() {
  scree::Simulation<> simulation;
  const auto rock = simulation.add_material({.normal_stiffness = 1e6});
  simulation.add_wall({.name = "floor", .surfaces = {{scree::Plane{}, rock}}, .dynamics = Dynamics{}});
}
