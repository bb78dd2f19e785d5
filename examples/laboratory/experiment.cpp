#include "laboratory/experiment.hpp"
#include "laboratory/program.hpp"

#include "scree/core/error.hpp"

#include <array>

namespace scree::examples {

namespace {

struct Kind {
  const char* name;
  ExperimentPart last;
  std::unique_ptr<Experiment> (*make)(bool desk);
};
constexpr std::array kinds{Kind{"immersion", ExperimentPart::grains, detail::make_immersion},
                           Kind{"bulk_density", ExperimentPart::bed, detail::make_bulk_density},
                           Kind{"oedometer", ExperimentPart::bed, detail::make_oedometer},
                           Kind{"angle_of_repose", ExperimentPart::bed, detail::make_angle_of_repose},
                           Kind{"drop_test", ExperimentPart::contacts, detail::make_drop_test},
                           Kind{"tilt_test", ExperimentPart::contacts, detail::make_tilt_test},
                           Kind{"drag", ExperimentPart::dragline, detail::make_drag_test}};

} // namespace

std::vector<std::string> experiment_kinds() {
  std::vector<std::string> names;
  for (const auto& [name, last, make] : kinds) {
    names.emplace_back(name);
  }
  return names;
}

std::vector<std::string> kinds_that_show(const RockParameter& parameter) {
  std::vector<std::string> names;
  for (const auto& [name, last, make] : kinds) {
    if (parameter.of <= last) {
      names.emplace_back(name);
    }
  }
  return names;
}

std::unique_ptr<Experiment> make_experiment(const std::string& kind, bool desk) {
  for (const auto& [name, last, make] : kinds) {
    if (kind == name) {
      return make(desk);
    }
  }
  throw Error(message("there is no experiment of the kind '", kind, "'; there are ",
                      detail::joined(experiment_kinds(), ", ")));
}

int experiment_program(const std::string& kind, const std::string& brief, int argc, const char* const* argv) {
  return run_experiment(kind, brief, argc, argv, [&](Workbench& bench) {
    const auto experiment = make_experiment(kind, bench.desk());
    experiment->bind(bench.options());
    bench.begin();
    experiment->show(bench);
  });
}

} // namespace scree::examples
