/// \brief Says what a simulation gets wrong beside measured data, and why.
/// \smoke --measured @PROJECT_SOURCE_DIR@/tests/examples/measured/immersion --runs 30 --first_runs 30

#include "diagnose/catalogue.hpp"
#include "diagnose/report.hpp"
#include "laboratory/before_and_after.hpp"
#include "laboratory/measured_folder.hpp"
#include "laboratory/trials.hpp"

#include "support/crew.hpp"
#include "support/options.hpp"
#include "support/results.hpp"

#include "scree/diagnose/diagnosis.hpp"
#include "scree/diagnose/shared_design.hpp"
#include "scree/io/atomic_file.hpp"
#include "scree/laboratory/campaign.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace scree;
namespace ex = scree::examples;
using Json = nlohmann::ordered_json;

struct Wish {
  std::string measured, out, kept, causes;
  bool resume = false, apply = false;
  std::uint64_t runs = 96, first_runs = 72, active = 2, fit_seed = 1, workers = 0;
  double limit = 300.0;
  DiagnosisSetup setup{};
};

void bind(ex::Options& options, Wish& w) {
  options.add("measured", w.measured, {}, "folder with calibration.toml and the tables that it names");
  options.add("out", w.out, {}, "folder for the results; none: results/diagnose-K");
  options.add("resume", w.resume,
              "go on in a folder that was begun: runs that are kept there are not repeated");
  options.add(
      "kept", w.kept, {},
      "folder that keeps every run, which several diagnoses may use one after another; none: runs/ in the "
      "folder for the results");
  options.add("apply", w.apply,
              "run every experiment again with the base model and with what is named, and draw both");
  options.add("causes", w.causes, {}, "to be considered, with commas between them; none: all that there are");
  options.add("runs", w.runs, {20.0, 1e6}, "of all experiments at most");
  options.add("first_runs", w.first_runs, {20.0, 1e6},
              "of these, spread over all causes; the others go where "
              "the likeliest causes are");
  options.add("active", w.active, {1.0, 100.0}, "causes at work in each of the first runs");
  options.add("fit_seed", w.fit_seed, {0.0, 9e15}, "of these runs");
  options.add("false_alarms", w.setup.false_alarms, {1e-3, 0.5},
              "share of faultless simulations that are doubted");
  options.add("clear_odds", w.setup.clear_odds, {1.0, 1e9},
              "of one cause over the next, for it to be named alone");
  options.add("confidence", w.setup.confidence, {0.5, 0.999}, "of the intervals");
  options.add("limit", w.limit, {1e-3, 1e6, "s"}, "of simulated time, beyond which a run counts as failed");
  options.add("workers", w.workers, {0.0, 1024.0}, "runs side by side; 0: one for each processor");
}

/// Where the likeliest hypotheses are best, and somewhat beside.
std::vector<Eigen::VectorXd> around(const std::vector<Eigen::VectorXd>& points, const Eigen::VectorXd& null,
                                    std::size_t count, Random& random) {
  std::vector<Eigen::VectorXd> out;
  for (std::size_t k = 0; k < count; ++k) {
    Eigen::VectorXd at = points[k % points.size()];
    for (Eigen::Index d = 0; d < at.size(); ++d) {
      if (at[d] != null[d]) {
        at[d] = std::clamp(at[d] + 0.1 * random.uniform(-1.0, 1.0), 0.0, 1.0);
      }
    }
    out.push_back(std::move(at));
  }
  return out;
}

void work(const Wish& wish, const ex::Options& options, ex::CrewOfProgram& crew) {
  const auto begin = std::chrono::steady_clock::now();
  if (wish.measured.empty()) {
    throw Error("give --measured FOLDER");
  }
  const ex::CrewFolders folders = crew.folders(wish.out, "diagnose", wish.resume);
  options.write_toml(folders.own / "input.toml");
  ex::Plan plan = ex::read_plan(wish.measured);
  const ModelSpace space{plan.space, diagnose::catalogue(plan, wish.causes)};
  plan.space = space.parameters();
  std::vector<Measured> fitted, held_out;
  for (const ex::PlannedExperiment& e : plan.experiments) {
    auto& there = e.held_out ? held_out : fitted;
    there.insert(there.end(), e.measured.begin(), e.measured.end());
  }
  if (fitted.empty()) {
    throw Error(message(wish.measured, ": every experiment is held out"));
  }

  const Campaign campaign{wish.kept.empty() ? folders.common / "runs" : std::filesystem::path{wish.kept},
                          static_cast<unsigned>(wish.workers), crew.crew()};
  ex::Trials trials{plan, campaign, wish.limit, wish.runs * plan.experiments.size(), crew.first()};
  const auto batch = [&](const std::vector<RunRequest>& requests) { return trials(requests); };
  RunLog log{space.parameters(), plan.measured()};
  Random random{wish.fit_seed, "diagnosis, runs"};
  log.make(shared_design(space, std::min(wish.runs, wish.first_runs), wish.active, random), batch, random);
  while (log.asked() < wish.runs) {
    const Diagnostician so_far{space, fitted, held_out, log.runs(), wish.setup};
    const std::size_t count = std::min<std::size_t>(wish.runs - log.asked(), 12);
    log.make(around(so_far.of_interest(4), space.null(), count, random), batch, random);
  }
  trials.close();
  const Diagnosis diagnosis = Diagnostician{space, fitted, held_out, log.runs(), wish.setup}();

  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
  const diagnose::Case c{space, fitted, held_out, diagnosis, log, taken.count()};
  ex::write_json(folders.own / "verdict.json", diagnose::verdict(c));
  write_atomically(folders.own / "diagnosis.html", diagnose::page(c));
  fmt::print("{}\n{}\n", diagnose::sentence(c), diagnosis.reason);
  for (const std::string& line : diagnose::model_to_write(c)) {
    fmt::print("  {}\n", line);
  }
  if (wish.apply && !diagnosis.named.empty()) {
    const auto base = std::find_if(diagnosis.ranking.begin(), diagnosis.ranking.end(),
                                   [](const Ranked& r) { return r.causes.empty(); });
    const std::string complaints = ex::draw_before_and_after(
        plan, trials, base->values, diagnosis.ranking[diagnosis.named.front()].values, folders.own);
    trials.close();
    fmt::print(stderr, "{}", complaints);
  }
  fmt::print("results: {}\n", folders.own.string());
}

} // namespace

int main(int argc, char** argv) {
  ex::CrewOfProgram crew{argc, argv};
  try {
    Wish wish;
    ex::Options options{"diagnose", "Says what a simulation gets wrong beside measured data, and why."};
    bind(options, wish);
    options.parse(argc, argv);
    work(wish, options, crew);
    return 0;
  } catch (const ex::HelpWanted& help) {
    fmt::print("{}", help.text);
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "diagnose: {}\n", error.what());
    crew.fail();
    return 2;
  }
}
