/// \brief Says what a simulation gets wrong beside measured data, and why.
/// \smoke --measured @PROJECT_SOURCE_DIR@/tests/examples/measured/immersion --runs 30 --first_runs 30

#include "diagnose/diagnosing.hpp"
#include "diagnose/report.hpp"
#include "laboratory/before_and_after.hpp"

#include "support/crew.hpp"
#include "support/options.hpp"
#include "support/results.hpp"

#include "scree/io/atomic_file.hpp"
#include "scree/laboratory/campaign.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace scree;
namespace ex = scree::examples;

struct Wish {
  diagnose::Request request;
  std::string out, kept;
  bool resume = false, apply = false;
  std::uint64_t workers = 0, foresee = 4;
};

void bind(ex::Options& options, Wish& w) {
  options.add("measured", w.request.measured, {},
              "folder with calibration.toml and the tables that it names");
  options.add("out", w.out, {}, "folder for the results; none: results/diagnose-K");
  options.add("resume", w.resume,
              "go on in a folder that was begun: runs that are kept there are not repeated");
  options.add(
      "kept", w.kept, {},
      "folder that keeps every run, which several diagnoses may use one after another; none: runs/ in the "
      "folder for the results");
  options.add("apply", w.apply,
              "run every experiment again with the base model and with what is named, and draw both");
  options.add("causes", w.request.causes, {},
              "to be considered, with commas between them; none: all that there are");
  options.add("runs", w.request.runs, {20.0, 1e6}, "of all experiments at most");
  options.add("first_runs", w.request.first_runs, {20.0, 1e6},
              "of these, spread over all causes; the others go where "
              "the likeliest causes are");
  options.add(
      "second_look", w.request.second_look, {0.0, 1e6},
      "of all experiments beyond --runs, only where held-out data would refuse what explains the others");
  options.add(
      "confirm", w.request.confirm, {0.0, 1e6},
      "simulations beyond --runs of what was held out, with the base model and with what is named each, "
      "whose error is compared; below 2: none");
  options.add("active", w.request.active, {1.0, 100.0}, "causes at work in each of the first runs");
  options.add("fit_seed", w.request.fit_seed, {0.0, 9e15}, "of these runs");
  options.add("false_alarms", w.request.setup.false_alarms, {1e-3, 0.5},
              "share of faultless simulations that are doubted");
  options.add("clear_odds", w.request.setup.clear_odds, {1.0, 1e9},
              "of one cause over the next, for it to be named alone");
  options.add("form_tolerance", w.request.setup.form_tolerance, {0.0, 1.0},
              "share by which what a cause does to an observable may be off");
  options.add("confidence", w.request.setup.confidence, {0.5, 0.999}, "of the intervals");
  options.add("limit", w.request.limit, {1e-3, 1e6, "s"},
              "of simulated time, beyond which a run counts as failed");
  options.add("step_safety", w.request.step_safety, {0.01, 1.0}, "share of the critical time step");
  options.add("foresee", w.foresee, {0.0, 1000.0},
              "simulations by each rival of each experiment that is not measured yet, where several are "
              "named; below 2: none");
  options.add("workers", w.workers, {0.0, 1024.0}, "runs side by side; 0: one for each processor");
}

void work(const Wish& wish, const ex::Options& options, ex::CrewOfProgram& crew) {
  const auto begin = std::chrono::steady_clock::now();
  const ex::CrewFolders folders = crew.folders(wish.out, "diagnose", wish.resume);
  options.write_toml(folders.own / "input.toml");
  const Campaign campaign{wish.kept.empty() ? folders.common / "runs" : std::filesystem::path{wish.kept},
                          static_cast<unsigned>(wish.workers), crew.crew()};
  diagnose::Diagnosing diagnosing{wish.request, campaign, crew.first()};
  const diagnose::Diagnosed diagnosed = diagnosing();
  const Diagnosis& diagnosis = diagnosed.diagnosis;
  std::vector<diagnose::ForeseenExperiment> foreseen;
  if (diagnosis.named.size() > 1 && wish.foresee > 1 && !diagnosing.plan().possible.empty()) {
    std::vector<std::vector<double>> rivals;
    for (const std::size_t r : diagnosis.named) {
      rivals.push_back(diagnosis.ranking[r].values);
    }
    foreseen = diagnose::foresee(diagnosing.plan(), diagnosing.trials(), rivals, wish.foresee);
    diagnosing.trials().close();
  }

  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
  const diagnose::Case c{diagnosed, taken.count(), std::move(foreseen)};
  ex::write_json(folders.own / "verdict.json", diagnose::verdict(c));
  write_atomically(folders.own / "diagnosis.html", diagnose::page(c));
  fmt::print("{}\n{}\n", diagnose::sentence(c), diagnosis.reason);
  if (const std::string gain = diagnose::gain_of_runs(c); !gain.empty()) {
    fmt::print("{}\n", gain);
  }
  if (const std::string next = diagnose::next_experiment(c); !next.empty()) {
    fmt::print("  to be measured next: {}\n", next);
  }
  for (const std::string& line : diagnose::model_to_write(c)) {
    fmt::print("  {}\n", line);
  }
  if (wish.apply && !diagnosis.named.empty()) {
    const auto base = std::find_if(diagnosis.ranking.begin(), diagnosis.ranking.end(),
                                   [](const Ranked& r) { return r.causes.empty(); });
    const std::string complaints =
        ex::draw_before_and_after(diagnosing.plan(), diagnosing.trials(), base->values,
                                  diagnosis.ranking[diagnosis.named.front()].values, folders.own);
    diagnosing.trials().close();
    fmt::print(stderr, "{}", complaints);
  }
  fmt::print("results: {}\n", folders.own.string());
}

} // namespace

int main(int argc, char** argv) {
  return ex::run_with_crew("diagnose", argc, argv, [&](ex::CrewOfProgram& crew) {
    Wish wish;
    ex::Options options{"diagnose", "Says what a simulation gets wrong beside measured data, and why."};
    bind(options, wish);
    options.parse(argc, argv);
    work(wish, options, crew);
  });
}
