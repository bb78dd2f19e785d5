// expect: error: .*scree: a wall dynamics of Model::Walls is missing advance\(
#include "scree/simulation/simulation.hpp"

struct Dynamics : private scree::Fixed {
  using Fixed::start;
};

struct Model : scree::DefaultModel {
  using Walls = scree::Walls<scree::Fixed, Dynamics>;
};

int main() {
  scree::Simulation<Model> simulation;
  simulation.step();
}
