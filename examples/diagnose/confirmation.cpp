#include "diagnose/confirmation.hpp"

#include "scree/core/error.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace diagnose {

using namespace scree;
namespace ex = scree::examples;

namespace {

constexpr std::uint64_t first_confirming = 3000; // ours, and none that a fit draws

/// The observables that were held out, as they are compared, of all runs that show each of them.
std::vector<Eigen::VectorXd> runs_at(const std::vector<double>& parameters, const ex::Plan& plan,
                                     ex::Trials& trials, std::size_t replicates) {
  std::vector<const ex::PlannedExperiment*> held_out;
  for (const ex::PlannedExperiment& e : plan.experiments) {
    if (e.held_out) {
      held_out.push_back(&e);
    }
  }
  std::vector<ex::Trials::Replicate> wanted;
  for (std::size_t n = 0; n < replicates; ++n) {
    for (const ex::PlannedExperiment* e : held_out) {
      wanted.push_back({*e, parameters, first_confirming + n});
    }
  }
  const std::vector<RunOutcome> outcomes = trials.replicates(wanted);
  auto outcome = outcomes.begin();
  std::vector<Eigen::VectorXd> out;
  for (std::size_t n = 0; n < replicates; ++n) {
    std::vector<double> seen;
    bool whole = true;
    for (const ex::PlannedExperiment* e : held_out) {
      whole = whole && outcome->failure.empty();
      for (std::size_t k = 0; whole && k < e->measured.size(); ++k) {
        seen.push_back(e->measured[k].compared(outcome->observed[e->used[k]]));
      }
      ++outcome;
    }
    const Eigen::VectorXd run = Eigen::Map<const Eigen::VectorXd>(seen.data(), std::ssize(seen));
    if (whole && run.allFinite()) {
      out.push_back(run);
    }
  }
  return out;
}

} // namespace

Confirmation confirm(const ex::Plan& plan, ex::Trials& trials, const Diagnostician& diagnostician,
                     const Diagnosis& diagnosis, std::size_t replicates) {
  require("replicates", static_cast<double>(replicates), {2.0, 1e6});
  const auto base = std::find_if(diagnosis.ranking.begin(), diagnosis.ranking.end(),
                                 [](const Ranked& r) { return r.causes.empty(); });
  const auto with = [&](const Ranked& r) { return runs_at(r.values, plan, trials, replicates); };
  const auto of_base = with(*base), extended = with(diagnosis.ranking.at(diagnosis.named.front()));
  Confirmation out{of_base.size(), extended.size()};
  if (std::min(out.base_runs, out.extended_runs) > 1) {
    out.gain = diagnostician.gain_of_runs(of_base, extended);
  }
  return out;
}

} // namespace diagnose
