// expect: error: .*scree: Model::Contact is missing check\(
#include "scree/simulation/simulation.hpp"

using Linear = scree::LinearSpring<>;

struct Law : private Linear {
  using Linear::elastic_energy;
  using Linear::evaluate;
  using Linear::history_parity;
  using Linear::history_size;
  using Linear::stiffness;
};

struct Model : scree::DefaultModel {
  using Contact = Law;
};

int main() {
  scree::Simulation<Model> simulation;
  simulation.step();
}
