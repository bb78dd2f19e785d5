/// \brief What the oedometer's modulus and the angle of repose depend on, and which bulk density each mass convention gives (Coetzee et al. 2010, section 4).
/// \smoke --experiments bulk_density --replicates 2 --rock.size_factor 2.5

#include "laboratory/plan.hpp"
#include "laboratory/trials.hpp"
#include "sensitivity/trend.hpp"
#include "support/crew.hpp"
#include "support/options.hpp"
#include "support/plot.hpp"
#include "support/results.hpp"
#include "support/rock_options.hpp"

#include "scree/io/csv.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace scree;
namespace ex = scree::examples;
using Json = nlohmann::ordered_json;

struct Wish {
  std::string out, experiments = "all";
  bool resume = false;
  std::vector<double> frictions{0.15, 0.3, 0.45, 0.6, 0.75}, stiffness_factors{0.25, 0.5, 1.0, 2.0, 4.0};
  std::uint64_t replicates = 4, seed = 1, workers = 0;
  double limit = 300.0;
};

/// One parameter swept, one observable looked at.
struct Sweep {
  const char *experiment, *observable, *parameter;
  const char* claim; ///< of the paper, sections 4.4 and 4.5
  const char *x_label, *y_label;
  double factor = 1.0; ///< from the observable to what the plot shows
};
constexpr Sweep sweeps[] = {
    {"oedometer", "modulus_Pa", "normal_stiffness", "the contact stiffness sets it",
     "normal stiffness of the rock, N/m", "kPa", 1e-3},
    {"oedometer", "modulus_Pa", "friction", "friction hardly changes it", "friction of the rock", "kPa",
     1e-3},
    {"angle_of_repose", "angle_deg", "friction", "friction sets it", "friction of the rock", "degrees"},
    {"angle_of_repose", "angle_deg", "normal_stiffness", "stiffness hardly changes it",
     "normal stiffness of the rock, N/m", "degrees"},
    {"bulk_density", "bulk_density_kg_m3", "friction", "nothing said", "friction of the rock", "kg/m3"},
    {"bulk_density", "bulk_density_kg_m3", "normal_stiffness", "nothing said",
     "normal stiffness of the rock, N/m", "kg/m3"},
};

class Work {
public:
  Work(Wish wish, const ex::Options& options, const ex::RockOptions& rock, Material rig, bool desk,
       ex::CrewOfProgram& crew)
      : wish_{std::move(wish)},
        rock_{rock},
        rig_{std::move(rig)},
        desk_{desk},
        folders_{crew.folders(wish_.out, "sensitivity", wish_.resume)},
        folder_{folders_.own},
        campaign_{folders_.common / "runs", static_cast<unsigned>(wish_.workers), crew.crew()},
        show_progress_{crew.first()} {
    options.write_toml(folder_ / "input.toml");
    summary_["program"] = "sensitivity";
    summary_["finished"] = false;
    summary_["versions"] = ex::versions();
    summary_["input"] = options.json();
    save();
  }

  void operator()() {
    const ex::Plan plan = plan_of(kinds(), rock_.mass_convention());
    std::size_t runs = 0;
    for (const Sweep& sweep : sweeps) {
      runs += wanted(sweep.experiment) ? values_of(sweep).size() * wish_.replicates : 0;
    }
    ex::Trials trials{plan, campaign_, wish_.limit, runs, show_progress_};
    for (const Sweep& sweep : sweeps) {
      if (wanted(sweep.experiment)) {
        run(sweep, plan, trials);
      }
    }
    const std::string complaint = ex::draw_plot(folder_, "sensitivity", "What depends on what", panels_);
    fmt::print(stderr, "{}", complaint);
    if (wanted("bulk_density")) {
      compare_conventions();
    }
    summary_["finished"] = true;
    save();
    fmt::print("results: {}\n", folder_.string());
  }

private:
  [[nodiscard]] bool wanted(std::string_view kind) const {
    return wish_.experiments == "all" || wish_.experiments == kind;
  }
  [[nodiscard]] std::vector<std::string> kinds() const {
    std::vector<std::string> out;
    for (const char* kind : {"oedometer", "angle_of_repose", "bulk_density"}) {
      if (wanted(kind)) {
        out.emplace_back(kind);
      }
    }
    return out;
  }
  static bool of_friction(const Sweep& sweep) { return std::string_view{sweep.parameter} == "friction"; }
  [[nodiscard]] const std::vector<double>& values_of(const Sweep& sweep) const {
    return of_friction(sweep) ? wish_.frictions : wish_.stiffness_factors;
  }

  /// Experiments with the rock of the options, nothing measured.
  [[nodiscard]] ex::Plan plan_of(const std::vector<std::string>& kinds, MassConvention convention) const {
    ex::RockOptions rock = rock_;
    rock.set_mass_convention(convention);
    ex::Plan plan{.folder = {}, .model = {rock.sample(rig_)}, .rock = ex::text_of(rock, rig_)};
    for (const char* name : {"normal_stiffness", "friction"}) {
      plan.space.push_back({.name = name});
    }
    for (const std::string& kind : kinds) {
      ex::PlannedExperiment e{
          .name = kind, .kind = kind, .experiment = ex::make_experiment(kind, desk_), .setup = {}};
      ex::Options options{kind, ""};
      e.experiment->bind(options);
      e.setup = options.json().dump();
      plan.experiments.push_back(std::move(e));
    }
    return plan;
  }

  /// An observable at some parameters, in all replicates that came to an end.
  std::vector<double> observed(const ex::Plan& plan, ex::Trials& trials, const std::string& kind,
                               const std::string& observable, double stiffness, double friction) const {
    const ex::PlannedExperiment& experiment = plan.experiments[plan.index_of(kind)];
    const auto observables = experiment.experiment->observables();
    std::size_t at = 0;
    while (observables[at].name != observable) {
      ++at;
    }
    const std::vector<double> parameters{stiffness, friction};
    std::vector<ex::Trials::Replicate> wanted;
    for (std::uint64_t k = 0; k < wish_.replicates; ++k) {
      wanted.push_back({experiment, parameters, wish_.seed + k});
    }
    std::vector<double> values;
    for (const RunOutcome& run : trials.replicates(wanted)) {
      if (run.failure.empty()) {
        values.push_back(run.observed[at]);
      }
    }
    trials.close();
    if (values.size() < 2) {
      throw Error(message(kind, ": fewer than two of ", wish_.replicates,
                          " runs came to an end at normal_stiffness = ", stiffness,
                          " N/m, friction = ", friction));
    }
    return values;
  }

  void run(const Sweep& sweep, const ex::Plan& plan, ex::Trials& trials) {
    const Material& base = rock_.material();
    const bool friction_varies = of_friction(sweep);
    const std::string name = message(sweep.experiment, "_of_", sweep.parameter);
    Json rows = Json::array();
    std::vector<ex::Level> levels;
    {
      CsvWriter table{folder_ / (name + ".csv"),
                      {sweep.parameter, sweep.observable, "standard_error", "runs"},
                      "Means of the replicates."};
      for (const double step : values_of(sweep)) {
        const double stiffness = friction_varies ? base.normal_stiffness : step * base.normal_stiffness;
        const double friction = friction_varies ? step : base.friction;
        const double value = friction_varies ? friction : stiffness;
        levels.push_back(
            {value, observed(plan, trials, sweep.experiment, sweep.observable, stiffness, friction)});
        const auto& runs = levels.back().observed;
        const ex::Mean mean = ex::mean_of_runs(runs);
        table.row({value, mean.value, mean.error, static_cast<double>(runs.size())});
        rows.push_back(
            {{sweep.parameter, value}, {sweep.observable, mean.value}, {"standard_error", mean.error}});
        fmt::print("{} {} at {} {:.4g}: {:.5g} +- {:.2g}\n", sweep.experiment, sweep.observable,
                   sweep.parameter, value, mean.value, mean.error);
      }
    }
    const ex::Trend trend = ex::trend(levels);
    summary_["sweeps"][name] = {{"paper", sweep.claim},
                                {"rows", rows},
                                {"exponent", trend.exponent},
                                {"exponent_standard_error", trend.error},
                                {"relative_change", trend.change},
                                {"relative_change_standard_error", trend.change_error}};
    fmt::print("{} goes by {}^({:.3f} +- {:.3f}); from {:.4g} to {:.4g} it changes by {:.1f} +- {:.1f} %\n\n",
               sweep.observable, sweep.parameter, trend.exponent, trend.error, levels.front().parameter,
               levels.back().parameter, 100.0 * trend.change, 100.0 * trend.change_error);
    save();
    ex::Panel panel{
        message(sweep.experiment, "; the paper: ", sweep.claim), sweep.x_label, sweep.y_label, {}};
    panel.log_x = !friction_varies;
    panel.curves.push_back({.file = name + ".csv",
                            .x = sweep.parameter,
                            .y = sweep.observable,
                            .title = "mean and its standard error",
                            .factor = sweep.factor,
                            .error = "standard_error"});
    panels_.push_back(std::move(panel));
  }

  /// The same rock weighed in both ways of counting the overlaps of a clump's spheres.
  void compare_conventions() {
    CsvWriter table{
        folder_ / "mass_conventions.csv",
        {"counts_overlaps_twice", "bulk_density_kg_m3", "standard_error"},
        message("Particles of ", rock_.material().density, " kg/m3 under both mass conventions.")};
    for (const MassConvention convention :
         {MassConvention::sum_of_spheres, MassConvention::union_of_spheres}) {
      const ex::Plan plan = plan_of({"bulk_density"}, convention);
      ex::Trials trials{plan, campaign_, wish_.limit, wish_.replicates, show_progress_};
      const ex::Mean mean =
          ex::mean_of_runs(observed(plan, trials, "bulk_density", "bulk_density_kg_m3",
                                    rock_.material().normal_stiffness, rock_.material().friction));
      const std::string name{to_string(convention)};
      table.row({convention == MassConvention::sum_of_spheres ? 1.0 : 0.0, mean.value, mean.error});
      summary_["mass_conventions"][name] = {{"particle_density_kg_m3", rock_.material().density},
                                            {"bulk_density_kg_m3", mean.value},
                                            {"standard_error", mean.error}};
      fmt::print("{}: particles of {:.5g} kg/m3 give a bulk density of {:.5g} +- {:.2g} kg/m3\n", name,
                 rock_.material().density, mean.value, mean.error);
    }
    save();
  }

  void save() const { ex::write_json(folder_ / "summary.json", summary_); }

  Wish wish_;
  ex::RockOptions rock_;
  Material rig_;
  bool desk_;
  ex::CrewFolders folders_;
  std::filesystem::path folder_;
  Campaign campaign_;
  bool show_progress_;
  Json summary_;
  std::vector<ex::Panel> panels_;
};

void run(int argc, char** argv, ex::CrewOfProgram& crew) {
  std::string fidelity = ex::Options::peek(argc, argv, "fidelity").value_or("desk");
  const bool desk = fidelity == "desk";
  Wish wish;
  ex::RockOptions rock{desk};
  ex::Options options{"sensitivity", "What the results of the laboratory depend on."};
  options.add("fidelity", fidelity, {"desk", "lab"}, "which set of defaults");
  options.add("out", wish.out, {}, "folder for the results; none: results/sensitivity-K");
  options.add("resume", wish.resume,
              "go on in a folder that was begun: runs that are kept there are not repeated");
  options.add("experiments", wish.experiments, {"all", "oedometer", "angle_of_repose", "bulk_density"},
              "which");
  options.add_series("frictions", wish.frictions, 2, {1e-3, 10.0}, "at which runs are made, ascending");
  options.add_series("stiffness_factors", wish.stiffness_factors, 2, {1e-3, 1e3},
                     "on rock.normal_stiffness, likewise");
  options.add("replicates", wish.replicates, {2.0, 1e4}, "of each run");
  options.add("seed", wish.seed, {0.0, 9e15}, "of the first replicate; the others follow");
  options.add("limit", wish.limit, {1e-3, 1e6, "s"},
              "of simulated time, beyond which a run counts as failed");
  options.add("workers", wish.workers, {0.0, 1024.0}, "runs side by side; 0: one for each processor");
  Material rig = rock.rig();
  ex::bind(options, rock, rig);
  options.parse(argc, argv);
  Work{wish, options, rock, rig, desk, crew}();
}

} // namespace

int main(int argc, char** argv) {
  return ex::run_with_crew("sensitivity", argc, argv,
                           [&](ex::CrewOfProgram& crew) { run(argc, argv, crew); });
}
