#include "diagnose/diagnosing.hpp"
#include "diagnose/report.hpp"

#include "laboratory/measured_folder.hpp"
#include "support/scratch_folder.hpp"

#include "scree/io/atomic_file.hpp"

#include <doctest/doctest.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

using namespace scree;

namespace confirmation_tests {
namespace {

// Rock weighed in water needs no simulation. Small batches and a large one, of grains that are larger than
// stated.
const std::string plan_text = R"(fidelity = "desk"
[parameters.particle_density]
least = 1000.0
most = 2500.0
[experiments.fitted]
kind = "immersion"
batch.grains = 50
data = "fitted.csv"
[experiments.predicted]
kind = "immersion"
batch.grains = 200
held_out = true
data = "predicted.csv"
)";
const std::string header = "solid_density_kg_m3,grain_mass_kg\n";

/// Weighs grains of a plan's rock, larger by a factor.
std::string weighed(const std::filesystem::path& folder, const std::string& experiment, double factor) {
  examples::Plan plan = examples::read_plan(folder);
  plan.space = {{.name = "size_factor", .least = 0.5, .most = 2.0}};
  examples::Trials trials{plan, Campaign{folder / "weighed", 1}, 1e3, 1, false};
  const std::vector<double> larger{factor * plan.model.sample.assembly.size_factor()};
  std::string out = header;
  for (std::uint64_t seed = 501; seed <= 506; ++seed) {
    const auto run = trials.replicates({{plan.experiments[plan.index_of(experiment)], larger, seed}}).front();
    REQUIRE(run.failure == "");
    out += message(run.observed.at(0), ",", run.observed.at(1), "\n");
  }
  return out;
}

} // namespace

TEST_CASE("what is named is run where nothing was fitted, and so is the base model") {
  const test::ScratchFolder scratch;
  write_atomically(scratch.path() / "calibration.toml", plan_text);
  for (const char* name : {"fitted", "predicted"}) {
    write_atomically(scratch.path() / message(name, ".csv"), header + "1500,0.01\n1501,0.0101\n");
  }
  for (const char* name : {"fitted", "predicted"}) {
    write_atomically(scratch.path() / message(name, ".csv"), weighed(scratch.path(), name, 1.25));
  }
  diagnose::Request request{.measured = scratch.path().string(), .runs = 40, .first_runs = 40};
  request.confirm = 6;
  diagnose::Diagnosing diagnosing{request, Campaign{scratch.path() / "runs", 1}, false};
  const diagnose::Diagnosed diagnosed = diagnosing();
  REQUIRE(diagnosed.diagnosis.finding == Finding::cause);
  REQUIRE(diagnosed.confirmation);
  CHECK(diagnosed.confirmation->base_runs == 6);
  CHECK(diagnosed.confirmation->extended_runs == 6);
  REQUIRE(diagnosed.confirmation->gain);
  CHECK(diagnosed.confirmation->gain->low > 0.5);
  const diagnose::Case c{diagnosed, 0.0};
  CHECK(diagnose::verdict(c)["held_out_gain"]["by_runs"]["runs"]["after"] == 6);
  CHECK(diagnose::gain_of_runs(c).find("6 with the base model") != std::string::npos);
  CHECK(diagnose::page(c).find("6 with the base model") != std::string::npos);

  request.confirm = 0;
  const diagnose::Diagnosed unconfirmed =
      diagnose::Diagnosing{request, Campaign{scratch.path() / "runs", 1}, false}();
  CHECK_FALSE(unconfirmed.confirmation);
  CHECK(diagnose::gain_of_runs({unconfirmed, 0.0}).empty());
}

} // namespace confirmation_tests
