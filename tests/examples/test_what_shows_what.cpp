#include "laboratory/diagnosis_plans.hpp"
#include "laboratory/measured_folder.hpp"
#include "support/scratch_folder.hpp"

#include "scree/io/atomic_file.hpp"
#include "scree/laboratory/rock_parameters.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>
#include <string>
#include <vector>

using namespace scree;

namespace {

examples::Plan micro() {
  const test::ScratchFolder scratch;
  write_atomically(scratch / "calibration.toml", examples::diagnosis_plan("micro", 2).toml);
  return examples::read_plan(scratch.path(), examples::Data::none);
}

/// Another value than the rock has, by much.
void change(const RockParameter& parameter, RockModel& model) {
  const double value = parameter.get(model);
  parameter.set(model, parameter.unit == "N" ? 20.0 : value == 0.0 ? 0.5 : 0.8 * value);
}

/// Numbers, or both none.
bool same(const std::vector<double>& a, const std::vector<double>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); });
}

bool shows(const std::string& kind, const RockParameter& parameter) {
  const std::vector<std::string> kinds = examples::kinds_that_show(parameter);
  return std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
}

} // namespace

TEST_CASE("physics: what a kind of experiment is not to show changes not a bit of it") {
  const examples::Plan plan = micro();
  std::set<std::string> seen;
  const auto look_at = [&](const examples::PlannedExperiment& e) {
    if (!seen.insert(e.kind).second) {
      return;
    }
    CAPTURE(e.kind);
    RockModel other = plan.model;
    for (const RockParameter& parameter : rock_parameters) {
      if (!shows(e.kind, parameter)) {
        change(parameter, other);
      }
    }
    CHECK(
        same(e.experiment->observe({.model = other}, {}), e.experiment->observe({.model = plan.model}, {})));
  };
  for (const examples::PlannedExperiment& e : plan.experiments) {
    look_at(e);
  }
  for (const examples::PlannedExperiment& e : plan.possible) {
    look_at(e);
  }
  // A drag shows everything.
  seen.insert("drag");
  const std::vector<std::string> all = examples::experiment_kinds();
  CHECK(seen == std::set<std::string>{all.begin(), all.end()});
  for (const RockParameter& parameter : rock_parameters) {
    CAPTURE(parameter.name);
    CHECK(shows("drag", parameter));
  }
}

TEST_CASE("what a kind of experiment shows changes it") {
  const examples::Plan plan = micro();
  const examples::PlannedExperiment& immersion = plan.experiments[plan.index_of("immersion")];
  const auto grains = immersion.experiment->observe({.model = plan.model}, {});
  for (const RockParameter& parameter : rock_parameters) {
    if (shows("immersion", parameter)) {
      CAPTURE(parameter.name);
      RockModel other = plan.model;
      change(parameter, other);
      CHECK_FALSE(same(immersion.experiment->observe({.model = other}, {}), grains));
    }
  }
}
