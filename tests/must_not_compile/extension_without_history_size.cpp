// expect: error: .*scree: an extension of a contact law is missing history_size
#include "scree/simulation/simulation.hpp"

struct Extension {
  template <class T>
  T normal(const scree::PairMaterial<T>&, const scree::Kinematics<T>&, T force, std::span<T, 0>) const {
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
