/// \brief How far a linear contact law is from sand in an oedometer: stress-dependent stiffness, and loading against reloading.

#include "laboratory/sand_data.hpp"

#include "scree/compare/stiffness.hpp"
#include "scree/io/csv.hpp"
#include "scree/laboratory/campaign.hpp"
#include "scree/laboratory/oedometer.hpp"
#include "support/crew.hpp"
#include "support/default_simulation.hpp"
#include "support/options.hpp"
#include "support/plot.hpp"
#include "support/progress.hpp"
#include "support/results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace scree;
namespace ex = scree::examples;
using Json = nlohmann::ordered_json;

struct Wish {
  std::string reference, out;
  bool resume = false;
  std::vector<double> tests{1.0, 5.0, 8.0, 12.0};
  std::vector<double> stiffnesses{50.0, 100.0, 200.0, 400.0, 800.0};
  double packing_friction = 0.3;
  std::uint64_t replicates = 3, seed = 1, workers = 0;
};

/// Shares of the highest stress at which curves are compared.
constexpr std::size_t level_count = 10;
constexpr double lowest_level = 0.1, highest_level = 0.98;
double level(std::size_t k) {
  return lowest_level * std::pow(highest_level / lowest_level,
                                 static_cast<double>(k) / static_cast<double>(level_count - 1));
}

/// Strains at the levels: loading and reloading upwards, unloading downwards; zero at the lowest level of the
/// first loading.
struct Path {
  std::vector<double> strain; // of loading, unloading, reloading, one after another
  double porosity = 0.0;

  [[nodiscard]] StressStrain branch(std::size_t which) const {
    StressStrain out;
    for (std::size_t k = 0; k < level_count; ++k) {
      out.stress.push_back(level(which == 1 ? level_count - 1 - k : k));
      out.strain.push_back(strain[which * level_count + k]);
    }
    return out;
  }
  /// From the lowest to the highest level of the first loading.
  [[nodiscard]] double range() const { return strain[level_count - 1] - strain[0]; }
};

Path path_of(const StressStrain& loading, const StressStrain& unloading, const StressStrain& reloading,
             double highest) {
  Path out;
  for (const StressStrain* branch : {&loading, &unloading, &reloading}) {
    for (std::size_t k = 0; k < level_count; ++k) {
      const std::size_t at = branch == &unloading ? level_count - 1 - k : k;
      out.strain.push_back(strain_at(*branch, highest * level(at)));
    }
  }
  const double zero = out.strain.front();
  for (double& strain : out.strain) {
    strain -= zero;
  }
  return out;
}

/// Loaded, unloaded and loaded again with a stiffness of k / (highest stress times the mean diameter).
/// Returns the strains of the path, then the porosity.
std::vector<double> simulated(double stiffness, double packing_friction, std::uint64_t seed) {
  OedometerSetup setup = desk_oedometer();
  double diameter = 0.0;
  Random random{1, "mean diameter"};
  constexpr std::size_t grains = 2000;
  const auto clumps = setup.sample.assembly.clumps();
  for (const DrawnClump& grain : setup.sample.assembly.draw(grains, random)) {
    diameter += 2.0 * grain.scale * clumps[grain.shape].bounding_radius / static_cast<double>(grains);
  }
  for (Material* m : {&setup.sample.rock, &setup.sample.rig}) {
    m->normal_stiffness = m->shear_stiffness = stiffness * setup.high_stress * diameter;
  }
  setup.low_stress = 0.05 * setup.high_stress;
  setup.strain_rate = 0.04; // quasi-static under the low stress too
  setup.cycles = 2;
  setup.fill.packing_friction = packing_friction;
  setup.seed = seed;
  setup.threads = 1;
  Oedometer<> oedometer{setup};
  const OedometerResult& r = oedometer.run();
  StressStrain branches[3];
  const double area = setup.container.area();
  for (const OedometerPoint& p : r.curve) {
    StressStrain& branch = branches[p.cycle == 1 ? 2 : p.loading ? 0 : 1];
    branch.stress.push_back(p.lid_force / area);
    branch.strain.push_back(p.displacement / r.height);
  }
  std::vector<double> out = path_of(branches[0], branches[1], branches[2], setup.high_stress).strain;
  double solid = 0.0;
  for (std::size_t b = 0; b < oedometer.simulation().bodies().size(); ++b) {
    solid += oedometer.simulation().bodies().solid_volume(b);
  }
  out.push_back(1.0 - solid / (area * r.height));
  return out;
}

/// What a path says, without dimension.
struct Numbers {
  PowerStiffness stiffness;  ///< of the first loading
  double reload_ratio = 0.0; ///< modulus of reloading over that of loading, upper half of the stress
  double unload_ratio = 0.0; ///< of unloading
  double permanent = 0.0;    ///< strain that unloading leaves, over that of the loading
};

Numbers numbers_of(const Path& path) {
  const StressStrain loading = path.branch(0);
  const double low = level(level_count / 2), high = highest_level;
  const double first = secant_modulus(loading, low, high);
  return {.stiffness = power_stiffness(loading, lowest_level, highest_level, 1.0, level_count),
          .reload_ratio = secant_modulus(path.branch(2), low, high) / first,
          .unload_ratio = secant_modulus(path.branch(1), low, high) / first,
          .permanent = path.strain[2 * level_count - 1] / path.range()};
}

class Work {
public:
  Work(Wish wish, const ex::Options& options, ex::CrewOfProgram& crew)
      : wish_{std::move(wish)},
        folders_{crew.folders(wish_.out, "sand_oedometer", wish_.resume)},
        folder_{folders_.own},
        crew_{crew} {
    options.write_toml(folder_ / "input.toml");
    summary_["program"] = "sand_oedometer";
    summary_["finished"] = false;
    summary_["versions"] = ex::versions();
    summary_["input"] = options.json();
    save();
  }

  void operator()() {
    std::vector<sand::SandTest> tests;
    for (const double number : wish_.tests) {
      tests.push_back(sand::read_sand_test(wish_.reference, static_cast<int>(number)));
    }
    simulate();
    CsvWriter table{
        folder_ / "sand_oedometer.csv",
        {"test", "void_ratio", "stiffness_over_stress_and_diameter", "exponent_measured",
         "exponent_standard_error", "exponent_simulated", "reload_ratio_measured", "reload_ratio_simulated",
         "unload_ratio_measured", "unload_ratio_simulated", "permanent_measured", "permanent_simulated",
         "misfit_loading", "misfit_unloading", "misfit_reloading"},
        "Misfits are root mean squares of the difference in strain over that of the first loading."};
    std::vector<ex::Panel> panels;
    for (const sand::SandTest& test : tests) {
      compare(test, table, panels);
    }
    if (panels.empty()) {
      throw Error("none of the tests could be fitted");
    }
    fmt::print(stderr, "{}",
               ex::draw_plot(folder_, "sand_oedometer",
                             "Karlsruhe fine sand and a linear contact law, fitted to the first loading",
                             panels));
    summary_["finished"] = true;
    save();
    fmt::print("results: {}\n", folder_.string());
  }

private:
  void simulate() {
    std::vector<Job> jobs;
    for (const double stiffness : wish_.stiffnesses) {
      for (std::uint64_t k = 0; k < wish_.replicates; ++k) {
        const std::uint64_t seed = wish_.seed + k;
        jobs.push_back({message("scree ", SCREE_VERSION, " sand_oedometer stiffness=", number_text(stiffness),
                                " packing_friction=", number_text(wish_.packing_friction), " seed=", seed),
                        [stiffness, packing = wish_.packing_friction, seed] {
                          return simulated(stiffness, packing, seed);
                        }});
      }
    }
    ex::Progress progress;
    const Campaign campaign{folders_.common / "runs", static_cast<unsigned>(wish_.workers), crew_.crew()};
    const auto outcomes = campaign.run(jobs, [&](std::size_t done, std::size_t all, const JobOutcome&) {
      if (crew_.first()) {
        progress(static_cast<double>(done) / static_cast<double>(all), message(done, " runs of ", all), true);
      }
    });
    progress.close();
    for (std::size_t s = 0; s < wish_.stiffnesses.size(); ++s) {
      Path mean{std::vector<double>(3 * level_count, 0.0)};
      double count = 0.0;
      for (std::size_t k = 0; k < wish_.replicates; ++k) {
        const JobOutcome& outcome = outcomes[s * wish_.replicates + k];
        if (!outcome.failure.empty()) {
          fmt::print(stderr, "stiffness {}: {}\n", wish_.stiffnesses[s], outcome.failure);
          continue;
        }
        count += 1.0;
        for (std::size_t i = 0; i < mean.strain.size(); ++i) {
          mean.strain[i] += outcome.values.at(i);
        }
        mean.porosity += outcome.values.at(3 * level_count);
      }
      if (count == 0.0) {
        continue; // the reason has been printed
      }
      for (double& strain : mean.strain) {
        strain /= count;
      }
      mean.porosity /= count;
      paths_.push_back(std::move(mean));
      stiffnesses_.push_back(wish_.stiffnesses[s]);
      const Numbers n = numbers_of(paths_.back());
      summary_["simulated"].push_back({{"stiffness_over_stress_and_diameter", wish_.stiffnesses[s]},
                                       {"strain_of_the_loading", paths_.back().range()},
                                       {"porosity", paths_.back().porosity},
                                       {"exponent", n.stiffness.exponent},
                                       {"reload_ratio", n.reload_ratio},
                                       {"unload_ratio", n.unload_ratio}});
    }
    if (paths_.size() < 2) {
      throw Error(message("--stiffnesses: two at least must be simulated, and ", paths_.size(), " of ",
                          wish_.stiffnesses.size(), " could be"));
    }
    save();
  }

  /// The stiffness whose first loading strains as much as `range`, and the path there, between two simulated
  /// ones by straight lines in logarithms; nothing outside of what was simulated.
  std::optional<std::pair<double, Path>> fitted(double range) const {
    for (std::size_t s = 0; s + 1 < paths_.size(); ++s) {
      const double soft = paths_[s].range(), stiff = paths_[s + 1].range();
      if (stiff <= range && range <= soft) {
        const double share = std::log(soft / range) / std::log(soft / stiff);
        Path path{std::vector<double>(3 * level_count, 0.0)};
        for (std::size_t i = 0; i < path.strain.size(); ++i) {
          // Each strain in its share of the first loading's.
          path.strain[i] =
              range * ((1.0 - share) * paths_[s].strain[i] / soft + share * paths_[s + 1].strain[i] / stiff);
        }
        return std::pair{stiffnesses_[s] * std::pow(stiffnesses_[s + 1] / stiffnesses_[s], share), path};
      }
    }
    return std::nullopt;
  }

  void compare(const sand::SandTest& test, CsvWriter& table, std::vector<ex::Panel>& panels) {
    const Path measured = path_of(test.loading, test.unloading, test.reloading, test.highest);
    const auto fit = fitted(measured.range());
    Json& found = summary_["tests"][message("OE", test.number)];
    if (!fit) {
      const std::string why =
          message("strains by ", measured.range(), " in its first loading, the simulated ones by ",
                  paths_.back().range(), " to ", paths_.front().range(),
                  ": not fitted; extend --stiffnesses, or pour denser with a lower --packing_friction");
      fmt::print("OE{} {}\n", test.number, why);
      found = {{"void_ratio", test.void_ratio}, {"not_fitted", why}};
      save();
      return;
    }
    const auto& [stiffness, model] = *fit;
    const Numbers m = numbers_of(measured), s = numbers_of(model);
    double misfit[3];
    for (std::size_t branch = 0; branch < 3; ++branch) {
      double sum = 0.0;
      for (std::size_t k = 0; k < level_count; ++k) {
        const std::size_t i = branch * level_count + k;
        sum += std::pow((model.strain[i] - measured.strain[i]) / measured.range(), 2);
      }
      misfit[branch] = std::sqrt(sum / static_cast<double>(level_count));
    }
    table.row({static_cast<double>(test.number), test.void_ratio, stiffness, m.stiffness.exponent,
               m.stiffness.exponent_error, s.stiffness.exponent, m.reload_ratio, s.reload_ratio,
               m.unload_ratio, s.unload_ratio, m.permanent, s.permanent, misfit[0], misfit[1], misfit[2]});
    fmt::print(
        "OE{}: k/(sigma d) {:.0f}; exponent {:.2f} (simulated {:.2f}); reloading {:.2f} times as stiff as "
        "loading (simulated {:.2f}), unloading {:.2f} ({:.2f}); {:.0f} % of the strain stays ({:.0f} %)\n",
        test.number, stiffness, m.stiffness.exponent, s.stiffness.exponent, m.reload_ratio, s.reload_ratio,
        m.unload_ratio, s.unload_ratio, 100.0 * m.permanent, 100.0 * s.permanent);
    found = {
        {"void_ratio", test.void_ratio},
        {"stiffness_over_stress_and_diameter", stiffness},
        {"exponent",
         {{"measured", m.stiffness.exponent},
          {"standard_error", m.stiffness.exponent_error},
          {"simulated", s.stiffness.exponent}}},
        {"reload_over_loading", {{"measured", m.reload_ratio}, {"simulated", s.reload_ratio}}},
        {"unload_over_loading", {{"measured", m.unload_ratio}, {"simulated", s.unload_ratio}}},
        {"permanent_share", {{"measured", m.permanent}, {"simulated", s.permanent}}},
        {"misfit_of_strain", {{"loading", misfit[0]}, {"unloading", misfit[1]}, {"reloading", misfit[2]}}}};
    save();
    ex::Panel panel{message("OE", test.number, ", void ratio ", test.void_ratio),
                    "strain over that of the first loading",
                    "stress over the highest",
                    {}};
    for (const auto& [name, path] : {std::pair{"measured", &measured}, std::pair{"linear law", &model}}) {
      const std::string file =
          message("OE", test.number, "_", path == &measured ? "measured" : "simulated", ".csv");
      CsvWriter curve{folder_ / file, {"strain_share", "stress_share"}, "Loading, unloading, loading again."};
      for (std::size_t branch = 0; branch < 3; ++branch) {
        const StressStrain rows = path->branch(branch);
        for (std::size_t k = 0; k < level_count; ++k) {
          curve.row({rows.strain[k] / measured.range(), rows.stress[k]});
        }
      }
      panel.curves.push_back({file, "strain_share", "stress_share", name});
    }
    panels.push_back(std::move(panel));
  }

  void save() const { ex::write_json(folder_ / "summary.json", summary_); }

  Wish wish_;
  ex::CrewFolders folders_;
  std::filesystem::path folder_;
  const ex::CrewOfProgram& crew_;
  std::vector<double> stiffnesses_; // of those that could be simulated
  std::vector<Path> paths_;
  Json summary_;
};

} // namespace

int main(int argc, char** argv) {
  return ex::run_with_crew("sand_oedometer", argc, argv, [&](ex::CrewOfProgram& crew) {
    Wish wish;
    ex::Options options{"sand_oedometer",
                        "A linear contact law beside oedometer tests on Karlsruhe fine sand."};
    options.add("reference", wish.reference, {},
                "folder with OE/OE1.dat and so on (Wichtmann & Triantafyllidis 2016)");
    options.add("out", wish.out, {}, "folder for the results; none: results/sand_oedometer-K");
    options.add("resume", wish.resume,
                "go on in a folder that was begun: runs that are kept there are not repeated");
    options.add_series("tests", wish.tests, 1, {1.0, 12.0}, "by their numbers");
    options.add_series("stiffnesses", wish.stiffnesses, 2, {1.0, 1e6},
                       "of contacts over highest stress times mean diameter, ascending");
    options.add("packing_friction", wish.packing_friction, {1e-3, 1e3},
                "times its own, the friction of the simulated grains while they are poured: loose fillings "
                "give way by "
                "more than dense sand strains, whatever the stiffness");
    options.add("replicates", wish.replicates, {1.0, 1e4}, "of each simulation");
    options.add("seed", wish.seed, {0.0, 9e15}, "of the first replicate; the others follow");
    options.add("workers", wish.workers, {0.0, 1024.0}, "runs side by side; 0: one for each processor");
    options.parse(argc, argv);
    if (wish.reference.empty()) {
      throw Error("--reference must name the folder of the measurements");
    }
    Work{wish, options, crew}();
  });
}
