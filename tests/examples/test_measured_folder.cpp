#include "laboratory/measured_folder.hpp"
#include "support/environment.hpp"
#include "support/scratch_folder.hpp"

#include "scree/io/atomic_file.hpp"
#include "scree/io/csv.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <string>

using namespace scree;

namespace measured_folder_tests {
using examples::read_plan;

namespace {

const std::string top = R"(fidelity = "desk"
[parameters.friction]
least = 0.2
most = 0.8
[rock]
density = 1700.0
[rig]
friction = 0.25
[experiments.heap]
kind = "angle_of_repose"
funnel.solid = 0.003
)";

/// What is wrong with a folder that has this calibration.toml and heap.csv.
std::string complaint(const std::string& toml, const std::string& csv = "angle_deg\n30\n31\n") {
  const test::ScratchFolder scratch;
  write_atomically(scratch.path() / "calibration.toml", toml);
  write_atomically(scratch.path() / "heap.csv", csv);
  try {
    (void)read_plan(scratch.path());
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

bool says(const std::string& text, const std::string& part) {
  CAPTURE(text);
  const bool found = text.find(part) != std::string::npos;
  CHECK(found);
  return found;
}

} // namespace

TEST_CASE("a folder of measurements is read: parameters, rock, experiments, replicates") {
  const test::ScratchFolder scratch;
  write_atomically(scratch.path() / "calibration.toml",
                   top + "data = \"heap.csv\"\ncurve = \"profile.csv\"\nstandard_error.angle_deg = 0.7\n");
  write_atomically(scratch.path() / "heap.csv", std::string{"angle_deg\n30\n31\n35\n"});
  const auto plan = read_plan(scratch.path());
  REQUIRE(plan.space.size() == 1);
  CHECK(plan.space[0].name == "friction");
  CHECK(plan.space[0].least == 0.2);
  CHECK(plan.start[0] == doctest::Approx(0.53)); // the desk rock's own
  CHECK(plan.model.sample.rock.density == 1700.0);
  CHECK(plan.model.sample.rig.friction == 0.25);
  CHECK(plan.with({0.4}).sample.rock.friction == 0.4);
  REQUIRE(plan.experiments.size() == 1);
  const auto& heap = plan.experiments[0];
  CHECK(heap.kind == "angle_of_repose");
  CHECK(heap.setup.find("\"funnel.solid\":0.003") != std::string::npos);
  REQUIRE(heap.measured.size() == 1);
  CHECK(heap.measured[0].replicates == std::vector<double>{30.0, 31.0, 35.0});
  CHECK(heap.measured[0].error == 0.7);
  CHECK(heap.curve == scratch.path() / "profile.csv");
  REQUIRE(plan.steps.size() == 1); // friction from the heap
  CHECK(plan.steps[0].observable == 0);
}

TEST_CASE("an experiment that is not measured yet is none of those to be fitted, and has no data") {
  const test::ScratchFolder scratch;
  const std::string later = "[experiments.later]\nkind = \"drop_test\"\nmeasured = false\n";
  write_atomically(scratch.path() / "calibration.toml",
                   top + "data = \"heap.csv\"\nmeasured = true\n" + later);
  write_atomically(scratch.path() / "heap.csv", std::string{"angle_deg\n30\n31\n"});
  const auto plan = read_plan(scratch.path());
  CHECK(plan.experiments.size() == 1);
  CHECK(plan.measured().size() == 1);
  REQUIRE(plan.possible.size() == 1);
  CHECK(plan.possible[0].name == "later");
  CHECK(plan.possible[0].measured.empty());
  const std::string complete = top + "data = \"heap.csv\"\n" + later;
  says(complaint(complete + "data = \"later.csv\"\n"),
       "experiments.later is not measured yet: it has no data");
  says(complaint(complete + "held_out = true\n"),
       "experiments.later is not measured yet: it has no held_out");
  says(complaint(top + "data = \"heap.csv\"\nmeasured = 0\n"), "measured must be true or false");
}

TEST_CASE("the smallest calibration of the tests can be read") {
  const auto plan = read_plan(test::source_directory() / "tests/examples/measured/immersion");
  CHECK(plan.experiments.at(0).measured.at(0).replicates.size() == 4);
  // Nothing but the bulk density finds the density in the paper's way.
  CHECK(plan.steps.empty());
  CHECK(plan.remarks.size() == 1);
}

TEST_CASE("curves of an oedometer are reduced as those of the simulation are") {
  const test::ScratchFolder scratch;
  write_atomically(scratch.path() / "calibration.toml", std::string{R"([parameters.normal_stiffness]
least = 1e4
most = 1e6
[experiments.oedometer]
container.radius = 0.15
container.height = 0.25
specimen.height = 0.2
load.low_stress = 1e3
load.high_stress = 1e4
curves = ["1.csv"]
standard_error = {modulus_Pa = 1e4, first_modulus_Pa = 1e4, unloading_modulus_Pa = 1e4, settlement = 1e-3, hysteresis_J = 0.1, base_share = 0.01}
)"});
  // Up at 2e5 N/m to 707 N, down at 4e5 N/m to 71 N, up again at 3e5 N/m.
  std::string curve = "displacement_m,lid_force_N,base_force_N\n";
  const double low = 71.0, high = 707.0;
  const auto row = [&](double displacement, double force) {
    curve += message(displacement + 0.003, ",", force, ",", 0.7 * force, "\n");
  };
  row(-0.003, 0.0); // the lid finds its seat
  row(-0.001, 10.0);
  for (int k = 0; k <= 50; ++k) {
    const double f = low + (high - low) * k / 50;
    row((f - low) / 2e5, f);
  }
  for (int k = 1; k <= 50; ++k) {
    const double f = high - (high - low) * k / 50;
    row((high - low) / 2e5 - (high - f) / 4e5, f);
  }
  for (int k = 1; k <= 50; ++k) {
    const double f = low + (high - low) * k / 50;
    row((high - low) / 4e5 + (f - low) / 3e5, f);
  }
  write_atomically(scratch.path() / "1.csv", curve);
  const auto plan = read_plan(scratch.path());
  const auto& measured = plan.experiments.at(0).measured;
  const double to_modulus = 0.2 / (3.141592653589793 * 0.15 * 0.15);
  CHECK(measured.at(0).replicates.at(0) == doctest::Approx(3e5 * to_modulus).epsilon(1e-4));
  const double range = high - low;
  CHECK(measured.at(1).replicates.at(0) == doctest::Approx(2e5 * to_modulus).epsilon(1e-4));
  CHECK(measured.at(2).replicates.at(0) == doctest::Approx(4e5 * to_modulus).epsilon(1e-4));
  CHECK(measured.at(3).replicates.at(0) == doctest::Approx(range / 2e5 / 0.2).epsilon(1e-4));
  CHECK(measured.at(4).replicates.at(0) == doctest::Approx(0.5 * range * range / 4e5).epsilon(1e-3));
  CHECK(measured.at(5).replicates.at(0) == doctest::Approx(0.7));
}

TEST_CASE("pieces of a measured curve are observables of one curve each") {
  const test::ScratchFolder scratch;
  write_atomically(scratch / "calibration.toml", R"([parameters.friction]
least = 0.1
most = 0.9
[experiments.oedometer]
container.radius = 0.15
specimen.height = 0.2
load.low_stress = 500.0
load.high_stress = 1e4
load.pieces = 2
curves = ["1.csv", "2.csv"]
use = ["loading_1", "loading_2", "unloading_1", "reloading_2"]
)");
  const double area = 3.141592653589793 * 0.15 * 0.15, high = 1e4 * area;
  for (const char* name : {"1.csv", "2.csv"}) {
    std::string curve = "displacement_m,lid_force_N\n";
    double displacement = 0.0, force = 0.0;
    const auto to = [&](double end, double stiffness) { // in so few rows that the turn is one of them
      for (int k = 0; k < 20; ++k) {
        const double step = (end - force) / (20 - k);
        force += step;
        displacement += step / stiffness;
        curve += message(displacement, ",", force, "\n");
      }
    };
    to(0.06 * high, 2e5);
    to(high, 2e5);
    to(0.03 * high, 4e5);
    to(high, 3e5);
    write_atomically(scratch / name, curve);
  }
  const auto plan = read_plan(scratch.path());
  const auto& measured = plan.experiments.at(0).measured;
  REQUIRE(measured.size() == 4);
  const double middle = std::sqrt(0.1 * 0.98);
  const auto strain = [&](double from, double end, double stiffness) {
    return (end - from) * high / stiffness / 0.2;
  };
  CHECK(measured[0].replicates[1] == doctest::Approx(strain(0.1, middle, 2e5)).epsilon(1e-6));
  CHECK(measured[1].replicates[0] == doctest::Approx(strain(middle, 0.98, 2e5)).epsilon(1e-6));
  CHECK(measured[2].replicates[0] == doctest::Approx(strain(0.1, middle, 4e5)).epsilon(1e-6));
  CHECK(measured[3].replicates[0] == doctest::Approx(strain(middle, 0.98, 3e5)).epsilon(1e-6));
  CHECK(measured[0].curve == "oedometer.loading");
  CHECK(measured[1].curve == measured[0].curve);
  CHECK(measured[2].curve == "oedometer.unloading");
}

TEST_CASE("curves of a drag are reduced as those of the simulation are, by what was measured") {
  const test::ScratchFolder scratch;
  const std::string stated = R"([parameters.rope_stiffness]
least = 0.2
most = 5.0
[experiments.drag]
rig.drag_distance = 0.5
record.pieces = 2
)";
  write_atomically(scratch / "calibration.toml", stated + "curves = [\"1.csv\", \"2.csv\"]\n");
  for (const double scale : {1.0, 2.0}) {
    std::string curve = "drag_m,force_N,pitch_deg\n";
    for (int k = 0; k <= 60; ++k) {
      const double x = k / 100.0; // a little further than is asked for
      curve += message(x, ",", scale * (100.0 * x + (k % 2 == 0 ? 1.0 : -1.0)), ",", 3.0 - 10.0 * x, "\n");
    }
    write_atomically(scratch / message(scale, ".csv"), curve);
  }
  const auto plan = read_plan(scratch.path());
  const auto& measured = plan.experiments.at(0).measured;
  // Of depth, mass and lag, nothing was measured.
  REQUIRE(measured.size() == 5);
  CHECK(measured[0].name == "drag.force_N_1");
  CHECK(measured[0].curve == "drag.force_N");
  CHECK_FALSE(measured[0].logarithmic);
  CHECK(measured[0].replicates[0] == doctest::Approx(12.5).epsilon(0.01));
  CHECK(measured[1].replicates[1] == doctest::Approx(2.0 * measured[1].replicates[0]));
  CHECK(measured[2].name == "drag.pitch_deg_1");
  CHECK(measured[2].replicates[0] == doctest::Approx(3.0 - 1.25));
  CHECK(measured[3].replicates[0] == doctest::Approx(3.0 - 3.75));
  CHECK(measured[4].name == "drag.roughness");
  CHECK(measured[4].replicates[0] == doctest::Approx(1.0 / 25.0).epsilon(0.05));
  CHECK(measured[4].replicates[0] == doctest::Approx(measured[4].replicates[1]));
  CHECK(plan.space.at(0).name == "rope_stiffness");
  CHECK(plan.start.at(0) == 1.0);

  write_atomically(scratch / "1.csv", "force_N\n3\n4\n");
  CHECK_THROWS_WITH_AS((void)read_plan(scratch.path()), doctest::Contains("drag_m"), Error);
}

TEST_CASE("a drag among the experiments is measured with its rig, and its curve is drawn") {
  const test::ScratchFolder scratch;
  write_atomically(scratch / "calibration.toml", R"([parameters.load_cell_gain]
least = 0.5
most = 2.0
[rock]
size_factor = 3.0
normal_stiffness = 1e4
shear_stiffness = 1e4
[rig]
normal_stiffness = 1e4
shear_stiffness = 1e4
[experiments.drag]
bed.length = 0.6
bed.width = 0.36
bed.depth = 0.15
rig.drag_distance = 0.05
record.pieces = 2
data = "drag.csv"
)");
  const auto plan = read_plan(scratch.path(), examples::Data::none);
  const examples::PlannedExperiment& drag = plan.experiments.at(0);
  const auto observables = drag.experiment->observables();
  const auto run = [&](double gain, const std::filesystem::path& folder) {
    return drag.experiment->observe({.model = plan.with({gain}), .seed = 3}, folder);
  };
  const auto null = run(1.0, scratch / ""), twice = run(2.0, {});
  REQUIRE(null.size() == observables.size());
  for (std::size_t k = 0; k < null.size(); ++k) {
    CAPTURE(observables[k].name);
    const double factor = observables[k].name.rfind("force_N", 0) == 0 ? 2.0 : 1.0;
    CHECK(twice[k] == doctest::Approx(factor * null[k]));
  }
  // What is measured in the curve that a run writes is what the run gives.
  const auto reduced = drag.experiment->reduce(read_csv(scratch / drag.experiment->curve().file));
  for (std::size_t k = 0; k < null.size(); ++k) {
    CAPTURE(observables[k].name);
    CHECK(reduced[k] == doctest::Approx(null[k]).epsilon(1e-6));
  }
}

TEST_CASE("a fault in a folder of measurements is told by file and line") {
  CHECK(complaint(top + "data = \"heap.csv\"\n").empty());
  says(complaint(top), "calibration.toml:9: experiments.heap needs either data or curves");
  says(complaint("[parameters.frition]\nleast = 0.0\nmost = 1.0\n"),
       "there is no parameter 'frition' of rock");
  says(complaint("[parameters.friction]\nleast = 0.9\nmost = 0.5\n[experiments.heap]\nkind = \"x\"\n"),
       "calibration.toml:1: parameter friction: bounds 0.9 to 0.5");
  says(complaint("[parameters.friction]\nleast = 0.5\n"), "needs bounds");
  says(complaint("[parameters.friction]\nleast = 0.5\nmost = 0.9\nmiddle = 1\n"),
       "calibration.toml:4: there is no 'parameters.friction.middle'");
  says(complaint("[parameters.friction]\nleast = 0.6\nmost = 0.9\nstart = 0.1\n"),
       "parameters.friction.start = 0.1");
  says(complaint("fidelity = \"desk\"\n"), "the file has no [parameters.NAME]");
  says(complaint("[parameters.friction]\nleast = 0.5\nmost = 0.9\n"), "the file has no [experiments.NAME]");
  says(complaint("oddity = 1\n" + top), "there is no 'oddity'");
  says(complaint(top + "data = \"heap.csv\"\nfunnel.sold = 1.0\n"), "calibration.toml:13: ");
  says(complaint(top + "funnel.sold = 1.0\ndata = \"heap.csv\"\n"), "did you mean 'funnel.solid'?");
  says(complaint(top + "data = \"heap.csv\"\nfunnel.rim = \"wide\"\n"), "calibration.toml:13: ");
  says(complaint(top + "data = \"none.csv\"\n"), "calibration.toml:12: no such file: ");
  says(complaint(top + "data = \"none.csv\"\n"), "none.csv");
  says(complaint(top + "data = \"/none.csv\"\n"), "calibration.toml:12: no such file: /none.csv");
  says(complaint(top + "curves = [\"heap.csv\", \"two\\nlines.csv\"]\n"), "two?lines.csv");
  says(complaint(top + "data = \"heap.csv\"\n", "angle\n30\n31\n"), "column angle is nothing that");
  says(complaint(top + "data = \"heap.csv\"\n", "angle_deg\n30\n"), "a single replicate needs an error");
  says(complaint(top + "data = \"heap.csv\"\nuse = [\"hysteresis_J\"]\n"), "'hysteresis_J' was not measured");
  says(complaint(top + "curves = [\"heap.csv\"]\n"), "takes tables of observables only");
  says(complaint("fidelity = \"best\"\n"), "fidelity = \"best\" is not one of desk, lab");
}

} // namespace measured_folder_tests
