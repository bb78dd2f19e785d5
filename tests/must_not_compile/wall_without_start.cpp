// expect: error: .*scree: a wall dynamics of Model::Walls is missing start\(
#include "scree/simulation/simulation.hpp"

struct Dynamics : private scree::Fixed {
  using Fixed::advance;
};

struct Model : scree::DefaultModel {
  using Walls = scree::Walls<scree::Fixed, Dynamics>;
};

int main() {
  scree::Simulation<Model> simulation;
  simulation.step();
}
