// expect: search.find\(balls, owned, margin, workers, rows\).*invalid
#include "scree/simulation/simulation.hpp"

struct Search {
  [[nodiscard]] static double skin(double) { return 0.0; }
};

struct Model : scree::DefaultModel {
  using Neighbours = scree::VerletList<Search>;
};

int main() {
  scree::Simulation<Model> simulation;
  simulation.step();
}
