// expect: error: .*scree: Model::Contact is missing evaluate.* for T = Model::Real
#include "scree/simulation/simulation.hpp"

using Linear = scree::LinearSpring<>;

struct Law : Linear {
  scree::ContactForce<double> evaluate(const scree::PairMaterial<double>& pair,
                                       const scree::Kinematics<double>& k,
                                       std::array<double, 3>& history) const {
    return Linear::evaluate(pair, k, history);
  }
};

struct Model : scree::DefaultModel {
  using Real = float;
  using Contact = Law;
};

int main() {
  scree::Simulation<Model> simulation;
  simulation.step();
}
