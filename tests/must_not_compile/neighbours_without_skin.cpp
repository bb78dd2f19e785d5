// expect: error: .*scree: Model::Neighbours is missing skin\(
#include "scree/simulation/simulation.hpp"

struct Search : private scree::CellGrid {
  using CellGrid::find;
};

struct Model : scree::DefaultModel {
  using Neighbours = Search;
};

int main() {
  scree::Simulation<Model> simulation;
  simulation.step();
}
