// expect: error: .*scree: Model::Contact is missing history_size
#include "scree/simulation/simulation.hpp"

using Linear = scree::LinearSpring<>;

struct Law : private Linear {
  using Linear::check;
  using Linear::elastic_energy;
  using Linear::evaluate;
  using Linear::history_parity;
  using Linear::stiffness;
};

struct Model : scree::DefaultModel {
  using Contact = Law;
};

int main() {
  scree::Simulation<Model> simulation;
  simulation.step();
}
