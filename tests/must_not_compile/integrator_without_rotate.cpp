// expect: error: .*scree: Model::Integrator is missing rotate\(
#include "scree/simulation/simulation.hpp"

struct Half : private scree::Leapfrog {
  using Leapfrog::translate;
};

struct Model : scree::DefaultModel {
  using Integrator = Half;
};

int main() {
  scree::Simulation<Model> simulation;
  simulation.step();
}
