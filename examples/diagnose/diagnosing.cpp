#include "diagnose/diagnosing.hpp"

#include "diagnose/catalogue.hpp"
#include "laboratory/measured_folder.hpp"

#include "scree/core/error.hpp"
#include "scree/core/random.hpp"
#include "scree/diagnose/shared_design.hpp"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>

namespace diagnose {

using namespace scree;
namespace ex = scree::examples;

namespace {

ex::Plan read(const std::string& folder) {
  if (folder.empty()) {
    throw Error("give --measured FOLDER");
  }
  return ex::read_plan(folder);
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

} // namespace

Diagnosing::Diagnosing(const Request& request, const Campaign& campaign, bool show_progress)
    : request_{request},
      plan_{read(request.measured)},
      space_{plan_.space, catalogue(plan_, request.causes)},
      trials_{plan_,         campaign,           request.limit, request.runs * plan_.experiments.size(),
              show_progress, request.step_safety} {
  plan_.space = space_.parameters();
}

Diagnosed Diagnosing::operator()() {
  std::vector<Measured> fitted, held_out;
  for (const ex::PlannedExperiment& e : plan_.experiments) {
    auto& there = e.held_out ? held_out : fitted;
    there.insert(there.end(), e.measured.begin(), e.measured.end());
  }
  if (fitted.empty()) {
    throw Error(message(request_.measured, ": every experiment is held out"));
  }
  const auto batch = [&](const std::vector<RunRequest>& requests) { return trials_(requests); };
  RunLog log{space_.parameters(), plan_.measured()};
  Random random{request_.fit_seed, "diagnosis, runs"};
  log.make(shared_design(space_, std::min(request_.runs, request_.first_runs), request_.active, random),
           batch, random);
  while (log.asked() < request_.runs) {
    const Diagnostician so_far{space_, fitted, held_out, log.runs(), request_.setup};
    const std::size_t count = std::min<std::size_t>(request_.runs - log.asked(), 12);
    log.make(around(so_far.of_interest(4), space_.null(), count, random), batch, random);
  }
  const auto judge_all = [&] {
    return std::make_unique<Diagnostician>(space_, fitted, held_out, log.runs(), request_.setup);
  };
  auto judge = judge_all();
  Diagnosis diagnosis = (*judge)();
  if (request_.second_look > 0 && refused_by_held_out(diagnosis)) {
    log.make(around(judge->of_interest(1), space_.null(), request_.second_look, random), batch, random);
    judge = judge_all();
    diagnosis = (*judge)();
  }
  std::optional<Confirmation> confirmation;
  if (request_.confirm > 1 && diagnosis.held_out && !diagnosis.named.empty()) {
    confirmation = confirm(plan_, trials_, *judge, diagnosis, request_.confirm);
  }
  trials_.close();
  return {space_,           std::move(fitted),    std::move(held_out),    std::move(log),
          std::move(judge), std::move(diagnosis), std::move(confirmation)};
}

} // namespace diagnose
