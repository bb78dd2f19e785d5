// expect: error: .*scree: Model::Real must be float or double
#include "scree/simulation/simulation.hpp"

struct Model : scree::DefaultModel {
  using Real = int;
};

int main() {
  scree::Simulation<Model> simulation;
  simulation.step();
}
