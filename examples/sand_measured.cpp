/// \brief Oedometer tests on Karlsruhe fine sand as a folder of measurements that `diagnose` reads.
/// \smoke --reference @PROJECT_SOURCE_DIR@/tests/examples/measured/sand --loose 1,1 --dense 1,1 --between 1,1 --held_out loose

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

/// Tests on sand of about one density, which one simulated bed stands for.
struct Group {
  std::string name;
  std::vector<double> numbers;
};

struct Wish {
  std::string reference, out, held_out = "dense";
  Group loose{"loose", {1.0, 2.0}}, between{"between", {4.0, 5.0, 7.0, 8.0}}, dense{"dense", {10.0, 12.0}};
  std::uint64_t pieces = 4;
};

/// The specimen that is simulated in place of the sand: radius [m], height [m], lowest and highest stress
/// [Pa]; ours. It has 310 to 370 grains; its lid is seated, as else it is on a few of them, and that is what
/// shows.
constexpr double radius = 0.1, height = 0.08, lowest = 3.2e3, highest = 4e4;

/// Void ratios of the sand at its loosest and its densest (Wichtmann & Triantafyllidis 2016).
constexpr double most_voids = 1.054, least_voids = 0.677;

/// Times its own, the friction with which a bed is poured whose place between the loosest and the densest is
/// that of the sand's. Ours: simulated beds (friction 0.5) had 797, 850, 894 and 937 kg/m3 at a factor of 2,
/// 0.5, 0.25 and 0.1, and no more than 976 with less. Base parameters shift all beds together.
double packing_friction(double void_ratio) {
  const double relative_density = (most_voids - void_ratio) / (most_voids - least_voids);
  return 2.4 * std::exp(-3.9 * relative_density);
}

/// Strain of the first loading between the stresses at which simulations are looked at.
double range(const sand::SandTest& test) {
  return strain_at(test.loading, 0.98 * test.highest) - strain_at(test.loading, 0.1 * test.highest);
}

/// A test in the size of the simulated specimen: its stress over the highest times what that bears, and its
/// strains times `scale`.
void write_curve(const std::filesystem::path& file, const sand::SandTest& test, double scale) {
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

/// The text of an experiment, whose curves are written into the folder: replicates, as if all were of one
/// density, with the mean of their strains in the first loading.
std::string experiment(const std::filesystem::path& folder, const Wish& wish, const Group& group) {
  std::vector<sand::SandTest> tests;
  double strain = 1.0, void_ratio = 0.0;
  const double share = 1.0 / static_cast<double>(group.numbers.size());
  for (const double number : group.numbers) {
    tests.push_back(sand::read_sand_test(wish.reference, static_cast<int>(number)));
    strain *= std::pow(range(tests.back()), share);
    void_ratio += share * tests.back().void_ratio;
  }
  std::string curves, use;
  for (const sand::SandTest& test : tests) {
    const std::string file = message(group.name, "_OE", test.number, ".csv");
    write_curve(folder / file, test, strain / range(test));
    curves += message(curves.empty() ? "" : ", ", "\"", file, "\"");
  }
  for (const char* branch : {"loading", "unloading", "reloading"}) {
    for (std::uint64_t k = 1; k <= wish.pieces; ++k) {
      use += message(use.empty() ? "" : ", ", "\"", branch, "_", k, "\"");
    }
  }
  return fmt::format(R"(
[experiments.{}] # void ratio of the sand: {:.3f}
kind = "oedometer"
container.radius = {}
container.height = {}
specimen.height = {}
fill.surplus = 0.3
fill.moving = 0.03
fill.packing_friction = {:.3f}
load.low_stress = {}
load.high_stress = {}
load.cycles = 2
load.seated = true
load.strain_rate = 0.3
load.most_inertial_number = 1e-2
load.pieces = {}
{}curves = [{}]
use = [{}]
)",
                     group.name, void_ratio, radius, height, height, packing_friction(void_ratio), lowest,
                     highest, wish.pieces, group.name == wish.held_out ? "held_out = true\n" : "", curves,
                     use);
}

void work(const Wish& wish) {
  if (wish.reference.empty()) {
    throw Error("--reference must name the folder of the measurements");
  }
  const auto folder = ex::results_folder(wish.out, "sand_measured");
  std::string text =
      R"(# Karlsruhe fine sand (Wichtmann & Triantafyllidis 2016) in the size of a specimen of simulated rock: the
# same shares of its highest stress. Tests of about one density are replicates, with the mean of their strains in the
# first loading. Simulated beds are poured with more or less friction, to be as dense, between their loosest and
# densest, as the sand is between its own.
fidelity = "desk"

[parameters.normal_stiffness] # N/m
start = 8e5
least = 3e5
most = 2e6

[parameters.friction]
least = 0.2
most = 0.9

[parameters.packing_friction] # times that of each bed: sand and rock pack differently
least = 0.3
most = 3.0

[rock]
size_factor = 0.9
fractions = [0.2, 0.0, 0.0, 0.8] # the last are spheres
)";
  for (const Group* group : {&wish.loose, &wish.between, &wish.dense}) {
    text += experiment(folder, wish, *group);
  }
  write_atomically(folder / "calibration.toml", text);
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
    for (Group* group : {&wish.loose, &wish.between, &wish.dense}) {
      options.add_series(group->name, group->numbers, 2, {1.0, 12.0},
                         "numbers of the tests that stand for sand so dense");
    }
    options.add("held_out", wish.held_out, {"loose", "between", "dense"},
                "which of these are only predicted, the others fitted");
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
