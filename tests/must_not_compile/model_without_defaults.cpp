// expect: error: .*scree: Model is missing one of .*: derive it from DefaultModel
#include "scree/simulation/simulation.hpp"

struct Model {
  using Contact = scree::LinearSpring<>;
};

int main() {
  scree::Simulation<Model> simulation;
  simulation.step();
}
