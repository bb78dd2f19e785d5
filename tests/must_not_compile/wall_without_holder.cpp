// expect: error: .*scree: a wall dynamics of Model::Walls .* is missing holder\(
#include "scree/simulation/simulation.hpp"

struct Dynamics : scree::Fixed {
  [[nodiscard]] static double squared_frequency() { return 1e6; }
};

struct Model : scree::DefaultModel {
  using Walls = scree::Walls<Dynamics>;
};

int main() {
  scree::Simulation<Model> simulation;
  simulation.step();
}
