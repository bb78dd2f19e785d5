#include "diagnose/foresight.hpp"

#include "laboratory/measured_folder.hpp"
#include "support/scratch_folder.hpp"

#include "scree/io/atomic_file.hpp"

#include <doctest/doctest.h>

#include <cstddef>
#include <string>
#include <vector>

using namespace scree;
using diagnose::ForeseenExperiment;

namespace {

// Rock weighed in water needs no simulation. A batch of two grains tells the size of grains badly, one of two
// thousand well; both tell their density exactly.
const std::string plan_text = R"(fidelity = "desk"
[parameters.particle_density]
least = 1000.0
most = 2500.0
[parameters.size_factor]
least = 0.5
most = 2.0
[experiments.immersion]
data = "immersion.csv"
[experiments.few]
kind = "immersion"
batch.grains = 2
measured = false
[experiments.many]
kind = "immersion"
batch.grains = 2000
measured = false
)";

std::vector<ForeseenExperiment> foreseen(const std::vector<std::vector<double>>& rivals) {
  const test::ScratchFolder scratch;
  write_atomically(scratch.path() / "calibration.toml", plan_text);
  write_atomically(scratch.path() / "immersion.csv",
                   std::string{"solid_density_kg_m3,grain_mass_kg\n1500,0.01\n1501,0.0101\n"});
  const examples::Plan plan = examples::read_plan(scratch.path());
  examples::Trials trials{plan, Campaign{scratch.path() / "runs", 1}, 1e3, 1, false};
  return diagnose::foresee(plan, trials, rivals, 6);
}

const diagnose::Foreseen& seen(const ForeseenExperiment& e, const std::string& observable) {
  for (const diagnose::Foreseen& f : e.observables) {
    if (f.observable == observable) {
      return f;
    }
  }
  FAIL(e.name, " foresees no ", observable);
  return e.observables.front();
}

} // namespace

TEST_CASE("of experiments not done yet, the one that tells rivals apart comes first, with what each says") {
  const auto found = foreseen({{1500.0, 1.2}, {1500.0, 1.3}});
  REQUIRE(found.size() == 2);
  CHECK(found[0].name == "many");
  CHECK(found[1].name == "few");
  CHECK(found[0].apart > found[1].apart);
  const diagnose::Foreseen& mass = seen(found[0], "grain_mass_kg");
  CHECK(found[0].observables.front().observable == "grain_mass_kg");
  CHECK(found[0].apart == mass.apart);
  CHECK(mass.apart > 3.0);
  CHECK(mass.mean[1] / mass.mean[0] == doctest::Approx(1.3 * 1.3 * 1.3 / (1.2 * 1.2 * 1.2)).epsilon(0.03));
  const diagnose::Foreseen& density = seen(found[0], "solid_density_kg_m3");
  CHECK(density.apart < 1.0);
  CHECK(density.mean[0] == doctest::Approx(density.mean[1]).epsilon(1e-3));
}

TEST_CASE("three rivals are told apart only where each two are, by one observable or another") {
  // The first two differ in size, the third in density from both.
  const auto found = foreseen({{1500.0, 1.2}, {1500.0, 1.3}, {1600.0, 1.2}});
  const ForeseenExperiment& many = found[0];
  CHECK(many.name == "many");
  CHECK(many.apart > 3.0);
  CHECK(seen(many, "solid_density_kg_m3").apart < 1.0); // that does not tell the first two
  CHECK(seen(many, "solid_density_kg_m3").mean.size() == 3);
  const auto alike = foreseen({{1500.0, 1.2}, {1500.0, 1.2}, {1600.0, 1.2}});
  CHECK(alike[0].apart == 0.0); // with the same seeds the same rock gives the same
}
