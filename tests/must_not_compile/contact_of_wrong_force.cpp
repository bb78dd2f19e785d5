// expect: error: .*scree: Model::Contact is missing evaluate.* returning ContactForce<T>
#include "scree/simulation/simulation.hpp"

using Linear = scree::LinearSpring<>;

struct Law : Linear {
  template <class T>
  T evaluate(const scree::PairMaterial<T>& pair, const scree::Kinematics<T>& k, std::array<T, 3>&) const {
    return pair.normal_stiffness * k.overlap;
  }
};

struct Model : scree::DefaultModel {
  using Contact = Law;
};

int main() {
  scree::Simulation<Model> simulation;
  simulation.step();
}
