/// \brief Finds the parameters of rock from measured bulk density, compression and angle of repose (Coetzee et al. 2010, section 4).
/// \smoke --measured @PROJECT_SOURCE_DIR@/tests/examples/measured/immersion --runs 20

#include "calibrate/closed_loop.hpp"
#include "calibrate/report.hpp"
#include "laboratory/before_and_after.hpp"
#include "laboratory/measured_folder.hpp"
#include "laboratory/trials.hpp"

#include "support/crew.hpp"
#include "support/options.hpp"
#include "support/results.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>

namespace {

using namespace scree;
namespace ex = scree::examples;
using Json = nlohmann::ordered_json;

struct Wish {
  std::string measured, out, kept, method = "joint";
  bool closed_loop = false, resume = false, draw = true;
  std::uint64_t seed = 1, fit_seed = 1, runs = 44, workers = 0, replicates = 4;
  double confidence = 0.9, limit = 300.0;
};

void bind(ex::Options& options, Wish& w) {
  options.add("measured", w.measured, {}, "folder with calibration.toml and the tables that it names");
  options.add("closed-loop", w.closed_loop,
              "make the measurements by simulation, with parameters drawn at random, and find these again");
  options.add("out", w.out, {}, "folder for the results; none: results/calibrate-K");
  options.add("resume", w.resume,
              "go on in a folder that was begun: runs that are kept there are not repeated");
  options.add(
      "kept", w.kept, {},
      "folder that keeps every run, which several calibrations may use one after another; none: runs/ "
      "in the folder for the results");
  options.add("method", w.method, {"joint", "one_by_one", "both"},
              "all parameters at once with intervals, or the paper's sequence");
  options.add("seed", w.seed, {0.0, 9e15}, "of the closed loop's parameters and measurements");
  options.add("fit_seed", w.fit_seed, {0.0, 9e15}, "of the runs that are made to find the parameters");
  options.add("runs", w.runs, {10.0, 1e6}, "of each experiment at most, in the joint fit");
  options.add("replicates", w.replicates, {1.0, 1e4}, "of each run one by one, whose mean counts");
  options.add("confidence", w.confidence, {0.5, 0.999}, "of the intervals");
  options.add("limit", w.limit, {1e-3, 1e6, "s"}, "of simulated time, beyond which a run counts as failed");
  options.add("workers", w.workers, {0.0, 1024.0}, "runs side by side; 0: one for each processor");
  options.add("draw", w.draw, "every experiment before and after, which takes a few runs more");
}

/// One calibration, with summary.json kept up to date.
class Work {
public:
  Work(Wish wish, const ex::Options& options, ex::CrewOfProgram& crew) : wish_{std::move(wish)}, crew_{crew} {
    if (wish_.closed_loop == !wish_.measured.empty()) {
      throw Error("give either --measured FOLDER or --closed-loop");
    }
    const ex::CrewFolders folders = crew_.folders(wish_.out, "calibrate", wish_.resume);
    folder_ = folders.own;
    runs_ = wish_.kept.empty() ? folders.common / "runs" : std::filesystem::path{wish_.kept};
    options.write_toml(folder_ / "input.toml");
    summary_["program"] = "calibrate";
    summary_["finished"] = false;
    summary_["versions"] = ex::versions();
    summary_["input"] = options.json();
    save();
  }

  void operator()() {
    try {
      work();
    } catch (const std::exception& error) {
      summary_["error"] = error.what();
      save();
      throw;
    }
  }

private:
  void work() {
    const Campaign campaign{runs_, static_cast<unsigned>(wish_.workers), crew_.crew()};
    std::filesystem::path measured = wish_.measured;
    calibrate::Truth truth;
    if (wish_.closed_loop) {
      measured = folder_ / "measured";
      truth = calibrate::make_measurements(measured, wish_.seed, campaign, wish_.limit, crew_.first());
    }
    ex::Plan plan = ex::read_plan(measured);
    plan.drop_held_out();
    for (const std::string& remark : plan.remarks) {
      fmt::print("{}\n", remark);
    }
    summary_["remarks"] = plan.remarks;
    const std::size_t expected =
        plan.experiments.size() * ((wish_.method != "one_by_one" ? wish_.runs : 0) + (wish_.draw ? 8 : 0));
    ex::Trials trials{plan, campaign, wish_.limit, expected, crew_.first()};
    std::vector<double> found = plan.start;
    if (wish_.method != "joint") {
      found = one_by_one(plan, trials);
    }
    if (wish_.method != "one_by_one") {
      found = jointly(plan, trials, truth);
    }
    if (wish_.draw) {
      const std::string complaints = ex::draw_before_and_after(plan, trials, plan.start, found, folder_);
      trials.close();
      fmt::print(stderr, "{}", complaints);
    }
    trials.close();
    summary_["simulations"] = {{"done", trials.done() - trials.kept()}, {"kept_from_before", trials.kept()}};
    summary_["finished"] = true;
    save();
    fmt::print("results: {}\n", folder_.string());
  }

  std::vector<double> one_by_one(const ex::Plan& plan, ex::Trials& trials) {
    OneByOneCalibration calibration{
        plan.space, plan.measured(), plan.steps, {.replicates = wish_.replicates, .seed = wish_.fit_seed}};
    const OneByOneFit fit =
        calibration.fit(plan.start, [&](const auto& requests) { return trials(requests); });
    trials.close();
    summary_["one_by_one"] = calibrate::described(plan, fit, folder_);
    save();
    fmt::print("one by one, {} runs{}:\n", fit.runs, fit.converged ? "" : ", tolerances NOT met");
    for (std::size_t k = 0; k < plan.space.size(); ++k) {
      fmt::print("  {:<18} {:.5g} {}\n", plan.space[k].name, fit.parameters[k], plan.space[k].unit);
    }
    return fit.parameters;
  }

  std::vector<double> jointly(const ex::Plan& plan, ex::Trials& trials, const calibrate::Truth& truth) {
    JointCalibration calibration{
        plan.space,
        plan.measured(),
        {.most_runs = wish_.runs, .confidence = wish_.confidence, .seed = wish_.fit_seed}};
    const JointFit fit = calibration.fit([&](const auto& requests) { return trials(requests); });
    trials.close();
    summary_.update(calibrate::described(plan, fit));
    fmt::print("jointly, {} runs of {} experiments, {} failed:\n", fit.runs, plan.experiments.size(),
               fit.failed);
    std::vector<double> found;
    for (std::size_t k = 0; k < plan.space.size(); ++k) {
      const Parameter& p = plan.space[k];
      const Estimate& e = fit.parameters[k];
      found.push_back(e.value);
      std::string beside;
      for (const auto& [name, value] : truth) {
        if (name == p.name) {
          summary_["parameters"][name]["truth"] = value;
          beside = fmt::format("; truth {:.5g}", value);
        }
      }
      fmt::print("  {:<18} {:.5g} {} ({:.5g} to {:.5g}){}{}{}\n", p.name, e.value, p.unit, e.low, e.high,
                 e.determined ? "" : ", hardly determined", e.at_bound ? ", AT ITS BOUND: widen it" : "",
                 beside);
    }
    save();
    return found;
  }

  void save() const { ex::write_json(folder_ / "summary.json", summary_); }

  Wish wish_;
  ex::CrewOfProgram& crew_;
  std::filesystem::path folder_, runs_;
  Json summary_;
};

} // namespace

int main(int argc, char** argv) {
  return ex::run_with_crew("calibrate", argc, argv, [&](ex::CrewOfProgram& crew) {
    Wish wish;
    ex::Options options{"calibrate", "Finds the parameters of rock from measured experiments."};
    bind(options, wish);
    options.parse(argc, argv);
    Work{wish, options, crew}();
  });
}
