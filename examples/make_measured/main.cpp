/// \brief Makes data as a laboratory would, with effects in them that a base model does not have.
/// \smoke --plan @PROJECT_SOURCE_DIR@/tests/examples/measured/immersion --replicates 2

#include "laboratory/diagnosis_plans.hpp"
#include "laboratory/measured_folder.hpp"
#include "make_measured/effects.hpp"

#include "support/crew.hpp"
#include "support/options.hpp"
#include "support/results.hpp"

#include "scree/core/random.hpp"
#include "scree/io/atomic_file.hpp"
#include "scree/io/read_text.hpp"
#include "scree/laboratory/campaign.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

namespace {

using namespace scree;
namespace ex = scree::examples;
using Json = nlohmann::ordered_json;

struct Wish {
  std::string effects, out, kept, plan = "desk";
  std::uint64_t seed = 1, workers = 0, replicates = 6;
  double limit = 300.0, reading_error = 5e-3;
};

void bind(ex::Options& options, Wish& w) {
  options.add_repeatable(
      "effect", w.effects,
      "NAME=VALUE in the unit of its parameter, or NAME=auto for a size drawn from the seed; none: "
      "nothing is hidden");
  options.add("out", w.out, {},
              "folder for measured/ and, apart from it, truth.json; none: results/make_measured-K");
  options.add("kept", w.kept, {}, "folder that keeps every run; none: runs/ in the folder for the results");
  options.add("plan", w.plan, {},
              "the experiments: desk, of rock; mini, of some tens of softer grains; or a folder with "
              "calibration.toml");
  options.add("replicates", w.replicates, {2.0, 1e4}, "of each experiment");
  options.add("reading_error", w.reading_error, {0.0, 1.0}, "relative, of a folder's experiments");
  options.add("seed", w.seed, {0.0, 9e15}, "of the rock, of specimens, readings and sizes of effects");
  options.add("limit", w.limit, {1e-3, 1e6, "s"}, "of simulated time of one run");
  options.add("workers", w.workers, {0.0, 1024.0}, "runs side by side; 0: one for each processor");
}

ex::DiagnosisPlan plan_of(const Wish& wish) {
  if (!std::filesystem::is_directory(wish.plan)) {
    return ex::diagnosis_plan(wish.plan, wish.replicates);
  }
  ex::DiagnosisPlan out{
      wish.plan, read_text(std::filesystem::path{wish.plan} / "calibration.toml", std::size_t{1} << 20U), {}};
  for (const ex::PlannedExperiment& e : ex::read_plan(wish.plan, ex::Data::none).experiments) {
    out.readings.push_back({e.name, wish.replicates, wish.reading_error, 0.0});
  }
  return out;
}

void make(const Wish& wish, const ex::Options& options, ex::CrewOfProgram& crew) {
  const ex::CrewFolders folders = crew.folders(wish.out, "make_measured", false);
  options.write_toml(folders.own / "input.toml");
  const ex::DiagnosisPlan wanted = plan_of(wish);
  const auto measured = folders.own / "measured";
  std::filesystem::create_directories(measured);
  write_atomically(measured / "calibration.toml", wanted.toml);

  // The laboratory's rock: what the plan looks for, drawn at random, and the effects as parameters beside.
  ex::Plan plan = ex::read_plan(measured, ex::Data::none);
  Random draw{wish.seed, "laboratory, rock"};
  std::vector<double> parameters;
  Json truth;
  truth["seed"] = wish.seed;
  for (const Parameter& p : plan.space) {
    parameters.push_back(p.value(draw.uniform(0.2, 0.8)));
    truth["base"][p.name] = {{"value", parameters.back()}, {"unit", p.unit}};
  }
  truth["effects"] = Json::object();
  Random sizes{wish.seed, "laboratory, effects"};
  for (const make_measured::Effect& effect : make_measured::effects_in(wish.effects, plan, sizes)) {
    plan.space.push_back(effect.parameter);
    parameters.push_back(effect.value);
    truth["effects"][effect.name] = {
        {"parameter", effect.parameter.name}, {"value", effect.value}, {"unit", effect.parameter.unit}};
  }
  const Campaign campaign{wish.kept.empty() ? folders.common / "runs" : std::filesystem::path{wish.kept},
                          static_cast<unsigned>(wish.workers), crew.crew()};
  std::size_t expected = 0;
  for (const ex::Reading& reading : wanted.readings) {
    expected += reading.replicates;
  }
  // A smaller time step than that of those who will diagnose.
  ex::Trials trials{plan, campaign, wish.limit, expected, crew.first(), 0.6};
  ex::write_measurements(measured, plan, trials, parameters, wanted.readings, wish.seed);
  trials.close();
  ex::write_json(folders.own / "truth.json", truth);
  fmt::print("measured: {}\ntruth, to be opened after the verdict: {}\n", measured.string(),
             (folders.own / "truth.json").string());
}

} // namespace

int main(int argc, char** argv) {
  ex::CrewOfProgram crew{argc, argv};
  try {
    Wish wish;
    ex::Options options{"make_measured", "Makes data as a laboratory would, with effects hidden in them."};
    bind(options, wish);
    options.parse(argc, argv);
    make(wish, options, crew);
    return 0;
  } catch (const ex::HelpWanted& help) {
    fmt::print("{}", help.text);
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "make_measured: {}\n", error.what());
    crew.fail();
    return 2;
  }
}
