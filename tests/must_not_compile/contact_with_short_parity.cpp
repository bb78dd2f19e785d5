// expect: error: .*scree: Model::Contact: history_parity must hold -1 or \+1 for each of
#include "scree/simulation/simulation.hpp"

struct Law : scree::LinearSpring<> {
  static constexpr std::array<int, 2> history_parity{-1, -1};
};

struct Model : scree::DefaultModel {
  using Contact = Law;
};

int main() {
  scree::Simulation<Model> simulation;
  simulation.step();
}
