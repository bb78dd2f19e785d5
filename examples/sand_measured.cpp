/// \brief Oedometer tests on Karlsruhe fine sand as a folder of measurements that `diagnose` reads.
/// \smoke --reference @PROJECT_SOURCE_DIR@/tests/examples/measured/sand --fitted 1,1,1,1 --held_out 1,1,1,1

#include "laboratory/sand_data.hpp"
#include "support/options.hpp"
#include "support/results.hpp"

#include "scree/core/error.hpp"
#include "scree/io/atomic_file.hpp"
#include "scree/io/csv.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

namespace {

using namespace scree;
namespace ex = scree::examples;

struct Wish {
  std::string reference, out;
  std::vector<double> fitted{1.0, 2.0, 4.0, 5.0}, held_out{7.0, 8.0, 10.0, 12.0};
  std::uint64_t pieces = 4;
};

/// The specimen that is simulated in place of the sand: radius [m], height [m], highest stress [Pa]; ours.
constexpr double radius = 0.1, height = 0.08, highest = 4e4;

/// Strain of the first loading between the stresses at which simulations are looked at.
double range(const sand::SandTest& test) {
  return strain_at(test.loading, 0.98 * test.highest) - strain_at(test.loading, 0.1 * test.highest);
}

/// A test in the size of the simulated specimen: its stress over the highest times what that bears, and its
/// strains times `scale`.
void write_curve(const std::filesystem::path& folder, const sand::SandTest& test, double scale) {
  const auto file = folder / message("OE", test.number, ".csv");
  CsvWriter table{file,
                  {"displacement_m", "lid_force_N"},
                  message("OE", test.number, ", void ratio ", test.void_ratio,
                          ", in the size of the simulated specimen.")};
  const double force = highest / test.highest * std::numbers::pi * radius * radius;
  const double displacement = scale * height;
  for (const StressStrain* branch : {&test.loading, &test.unloading, &test.reloading}) {
    for (std::size_t k = 0; k < branch->stress.size(); ++k) {
      table.row({branch->strain[k] * displacement, branch->stress[k] * force});
    }
  }
}

std::string experiment(const std::string& name, const std::vector<sand::SandTest>& tests,
                       std::uint64_t pieces, const std::string& more) {
  std::string curves, use;
  for (const sand::SandTest& test : tests) {
    curves += message(curves.empty() ? "" : ", ", "\"OE", test.number, ".csv\"");
  }
  for (const char* branch : {"loading", "unloading", "reloading"}) {
    for (std::uint64_t k = 1; k <= pieces; ++k) {
      use += message(use.empty() ? "" : ", ", "\"", branch, "_", k, "\"");
    }
  }
  return fmt::format(R"(
[experiments.{}]
kind = "oedometer"
container.radius = {}
container.height = {}
specimen.height = {}
fill.surplus = 0.5
load.low_stress = {}
load.high_stress = {}
load.cycles = 2
load.strain_rate = 0.15
load.most_inertial_number = 1e-2
load.pieces = {}
{}curves = [{}]
use = [{}]
)",
                     name, radius, height, height, 0.05 * highest, highest, pieces, more, curves, use);
}

void work(const Wish& wish) {
  if (wish.reference.empty()) {
    throw Error("--reference must name the folder of the measurements");
  }
  const auto folder = ex::results_folder(wish.out, "sand_measured");
  const auto read = [&](const std::vector<double>& numbers) {
    std::vector<sand::SandTest> tests;
    for (const double number : numbers) {
      tests.push_back(sand::read_sand_test(wish.reference, static_cast<int>(number)));
    }
    return tests;
  };
  const auto fitted = read(wish.fitted), held_out = read(wish.held_out);
  double strain = 1.0;
  for (const sand::SandTest& test : fitted) {
    strain *= std::pow(range(test), 1.0 / static_cast<double>(fitted.size()));
  }
  for (const sand::SandTest& test : fitted) {
    write_curve(folder, test, strain / range(test)); // replicates, as if all were of one density
  }
  for (const sand::SandTest& test : held_out) {
    write_curve(folder, test, 1.0);
  }
  write_atomically(
      folder / "calibration.toml",
      R"(# Karlsruhe fine sand (Wichtmann & Triantafyllidis 2016) in the size of a specimen of simulated rock: the
# same shares of its highest stress. Tests that are fitted have the mean of their strains in the first loading.
# Those that are held out are of denser sand, porosity less by 0.06 in the mean; simulated rock is poured with a tenth
# of the friction for them, as a fifteenth took its porosity from 0.48 to 0.43 or 0.44.
fidelity = "desk"

[parameters.normal_stiffness] # N/m
least = 1e5
most = 4e6

[parameters.friction]
least = 0.1
most = 0.9

[parameters.packing_friction] # times the friction, while it is poured: sand and rock pack differently
least = 0.05
most = 1.0
)" + experiment("fitted", fitted, wish.pieces, "") +
          experiment("other_densities", held_out, wish.pieces,
                     "fill.packing_friction = 0.1\nheld_out = true\n"));
  fmt::print("measured: {}\n", folder.string());
}

} // namespace

int main(int argc, char** argv) {
  try {
    Wish wish;
    ex::Options options{"sand_measured",
                        "Oedometer tests on Karlsruhe fine sand as a folder of measurements."};
    options.add("reference", wish.reference, {},
                "folder with OE/OE1.dat and so on (Wichtmann & Triantafyllidis 2016)");
    options.add("out", wish.out, {}, "folder for the measurements; none: results/sand_measured-K");
    options.add("fitted", wish.fitted, {1.0, 12.0}, "four tests, by their numbers");
    options.add("held_out", wish.held_out, {1.0, 12.0}, "four tests that are only predicted");
    options.add("pieces", wish.pieces, {2.0, 20.0}, "of each branch, whose strains are compared");
    options.parse(argc, argv);
    work(wish);
    return 0;
  } catch (const ex::HelpWanted& help) {
    fmt::print("{}", help.text);
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "sand_measured: {}\n", error.what());
    return 2;
  }
}
