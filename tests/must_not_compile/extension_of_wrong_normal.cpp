// expect: error: .*scree: an extension's normal does not fit
#include "scree/simulation/simulation.hpp"

struct Extension {
  static constexpr int history_size = 0;
  static constexpr std::array<int, 0> history_parity{};

  template <class T>
  T normal(const scree::PairMaterial<T>&, const scree::Kinematics<T>&,
           T force) const { // lacks the history and the work
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
