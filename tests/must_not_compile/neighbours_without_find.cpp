// expect: error: .*scree: Model::Neighbours is missing find\(
#include "scree/simulation/simulation.hpp"

struct Search {
  [[nodiscard]] static double skin(double) { return 0.0; }
};

struct Model : scree::DefaultModel {
  using Neighbours = Search;
};

int main() {
  scree::Simulation<Model> simulation;
  simulation.step();
}
