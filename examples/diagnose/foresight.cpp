#include "diagnose/foresight.hpp"

#include "scree/core/error.hpp"
#include "support/mean.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace diagnose {

using namespace scree;
namespace ex = scree::examples;

namespace {

constexpr std::uint64_t first_seed = 2000; // ours, and none that a fit draws

/// Values of each observable, by rival.
using Values = std::vector<std::vector<std::vector<double>>>;

/// Standard deviations between rivals a and b.
double between(const Foreseen& f, std::size_t a, std::size_t b, double replicates) {
  const double scatter = f.scatter * std::sqrt(1.0 + 2.0 / replicates);
  const double off = std::abs(f.mean[a] - f.mean[b]);
  return scatter > 0.0 ? off / scatter : off > 0.0 ? std::numeric_limits<double>::max() : 0.0;
}

/// Of the two rivals that are told apart worst, where `told(a, b)` is by how much two are.
template <class Told>
double least(std::size_t rivals, Told told) {
  double out = std::numeric_limits<double>::max();
  for (std::size_t a = 0; a < rivals; ++a) {
    for (std::size_t b = a + 1; b < rivals; ++b) {
      out = std::min(out, told(a, b));
    }
  }
  return out;
}

ForeseenExperiment judged(const ex::PlannedExperiment& e, const Values& values, double replicates) {
  ForeseenExperiment out{e.name, e.kind};
  const auto observables = e.experiment->observables();
  const std::size_t rivals = values.front().size();
  for (std::size_t k = 0; k < observables.size(); ++k) {
    Foreseen f{.observable = observables[k].name, .mean = {}};
    double squares = 0.0, freedom = 0.0;
    for (const std::vector<double>& of_rival : values[k]) {
      const ex::Mean mean{of_rival};
      const auto n = static_cast<double>(mean.count);
      f.mean.push_back(mean.value);
      if (mean.count > 1) {
        squares += mean.error * mean.error * n * (n - 1.0);
        freedom += n - 1.0;
      }
    }
    const bool seen_by_all = std::all_of(values[k].begin(), values[k].end(),
                                         [](const auto& of_rival) { return of_rival.size() > 1; });
    if (seen_by_all) {
      f.scatter = std::sqrt(squares / freedom);
      f.apart = least(rivals, [&](std::size_t a, std::size_t b) { return between(f, a, b, replicates); });
      out.observables.push_back(std::move(f));
    }
  }
  if (out.observables.empty()) {
    out.failure = "too few of its simulations came to an end";
    return out;
  }
  out.apart = least(rivals, [&](std::size_t a, std::size_t b) {
    double most = 0.0;
    for (const Foreseen& f : out.observables) {
      most = std::max(most, between(f, a, b, replicates));
    }
    return most;
  });
  std::stable_sort(out.observables.begin(), out.observables.end(),
                   [](const Foreseen& a, const Foreseen& b) { return a.apart > b.apart; });
  return out;
}

} // namespace

std::vector<ForeseenExperiment> foresee(const ex::Plan& plan, ex::Trials& trials,
                                        const std::vector<std::vector<double>>& rivals,
                                        std::size_t replicates) {
  require("rivals", static_cast<double>(rivals.size()), {2.0, 1e6});
  require("replicates", static_cast<double>(replicates), {2.0, 1e6});
  std::vector<ex::Trials::Replicate> wanted;
  for (const ex::PlannedExperiment& e : plan.possible) {
    for (const std::vector<double>& rival : rivals) {
      for (std::size_t n = 0; n < replicates; ++n) {
        wanted.push_back({e, rival, first_seed + n});
      }
    }
  }
  const std::vector<RunOutcome> runs = trials.replicates(wanted);
  auto run = runs.begin();
  std::vector<ForeseenExperiment> out;
  for (const ex::PlannedExperiment& e : plan.possible) {
    Values values(e.experiment->observables().size(), std::vector<std::vector<double>>(rivals.size()));
    for (std::size_t r = 0; r < rivals.size(); ++r) {
      for (std::size_t n = 0; n < replicates; ++n, ++run) {
        for (std::size_t k = 0; run->failure.empty() && k < values.size(); ++k) {
          if (std::isfinite(run->observed[k])) {
            values[k][r].push_back(run->observed[k]);
          }
        }
      }
    }
    out.push_back(judged(e, values, static_cast<double>(replicates)));
  }
  std::stable_sort(out.begin(), out.end(), [](const ForeseenExperiment& a, const ForeseenExperiment& b) {
    return a.apart > b.apart;
  });
  return out;
}

} // namespace diagnose
