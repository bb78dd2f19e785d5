// expect: error: .*scree: an extension of a contact law has neither normal
#include "scree/simulation/simulation.hpp"

struct Extension {
  static constexpr int history_size = 0;
  static constexpr std::array<int, 0> history_parity{};

  template <class T>
  T normal(const scree::PairMaterial<T>&, const scree::Kinematics<T>&, T force) const { // lacks the history
    return force;
  }
};

struct Model : scree::DefaultModel {
  using Contact = scree::LinearSpring<Extension>;
};

int main() {
  scree::Simulation<Model> simulation;
  simulation.step();
}
