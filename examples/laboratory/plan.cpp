#include "laboratory/plan.hpp"

#include "scree/core/error.hpp"
#include "scree/laboratory/rock_parameters.hpp"

namespace scree::examples {

std::vector<Measured> Plan::measured() const {
  std::vector<Measured> all;
  for (const PlannedExperiment& e : experiments) {
    all.insert(all.end(), e.measured.begin(), e.measured.end());
  }
  return all;
}

RockModel Plan::with(const std::vector<double>& parameters) const {
  RockModel changed = model;
  for (std::size_t k = 0; k < space.size(); ++k) {
    rock_parameter(space[k].name).set(changed, parameters.at(k));
  }
  return changed;
}

void Plan::drop_held_out() {
  for (const PlannedExperiment& e : experiments) {
    if (e.held_out) {
      remarks.push_back(message(e.name, " is held out, and not looked at"));
    }
  }
  std::erase_if(experiments, [](const PlannedExperiment& e) { return e.held_out; });
}

std::size_t Plan::index_of(const std::string& experiment) const {
  for (std::size_t e = 0; e < experiments.size(); ++e) {
    if (experiments[e].name == experiment) {
      return e;
    }
  }
  throw Error(message(folder.string(), ": there is no experiment '", experiment, "'"));
}

} // namespace scree::examples
