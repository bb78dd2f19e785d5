// expect: error: .*scree: an extension of a contact law has none of normal, friction and couple
#include "scree/simulation/simulation.hpp"

struct Extension {
  static constexpr int history_size = 0;
  static constexpr std::array<int, 0> history_parity{};
};

struct Model : scree::DefaultModel {
  using Contact = scree::LinearSpring<Extension>;
};

int main() {
  scree::Simulation<Model> simulation;
  simulation.step();
}
