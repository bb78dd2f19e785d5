// expect: error: .*scree: Model::Walls must be scree::Walls<
#include "scree/simulation/simulation.hpp"

struct Model : scree::DefaultModel {
  using Walls = scree::Fixed;
};

int main() {
  scree::Simulation<Model> simulation;
  simulation.step();
}
