#include "laboratory/trials.hpp"

#include "scree/io/number_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace scree::examples {

Trials::Trials(const Plan& plan, Campaign campaign, double limit, std::size_t expected, bool show_progress,
               double step_safety)
    : plan_{plan},
      campaign_{std::move(campaign)},
      limit_{limit},
      step_safety_{step_safety},
      expected_{expected} {
  if (show_progress) {
    progress_.emplace();
  }
}

Job Trials::job(const PlannedExperiment& e, const std::vector<double>& parameters, std::uint64_t seed) const {
  std::string values;
  for (std::size_t k = 0; k < plan_.space.size(); ++k) {
    values += message(" ", plan_.space[k].name, "=", number_text(parameters[k]));
  }
  Job job;
  job.key = message("scree ", SCREE_VERSION, " ", e.kind, " ", e.setup, " ", plan_.rock, values,
                    " limit=", number_text(limit_), " step=", number_text(step_safety_),
                    " gives=", e.experiment->observables().size(), " seed=", seed);
  job.work = [this, &e, model = plan_.with(parameters), seed] {
    return e.experiment->observe({.model = model, .seed = seed, .step_safety = step_safety_, .limit = limit_},
                                 {});
  };
  return job;
}

std::vector<JobOutcome> Trials::run(const std::vector<Job>& jobs) {
  const std::size_t before = done_;
  return campaign_.run(jobs, [&](std::size_t done, std::size_t, const JobOutcome& last) {
    done_ = before + done;
    kept_ += last.kept ? 1 : 0;
    failed_ += last.failure.empty() ? 0 : 1;
    expected_ = std::max(expected_, done_);
    if (!progress_) {
      return;
    }
    // Those kept from before took no time, and tell nothing of what is left.
    const double share = done_ == expected_
                             ? 1.0
                             : static_cast<double>(done_ - kept_) / static_cast<double>(expected_ - kept_);
    (*progress_)(share, fmt::format("{} runs of about {}, {} of them kept from before, {} failed", done_,
                                    expected_, kept_, failed_));
  });
}

std::vector<RunOutcome> Trials::operator()(const std::vector<RunRequest>& requests) {
  struct Place {
    std::size_t request, experiment;
  };
  std::vector<Job> jobs;
  std::vector<Place> places;
  std::vector<std::size_t> first; // observable of each experiment
  std::size_t observables = 0;
  for (const PlannedExperiment& e : plan_.experiments) {
    first.push_back(observables);
    observables += e.measured.size();
  }
  for (std::size_t r = 0; r < requests.size(); ++r) {
    const RunRequest& request = requests[r];
    for (std::size_t e = 0; e < plan_.experiments.size(); ++e) {
      const bool wanted = request.wanted.empty() ||
                          std::any_of(request.wanted.begin(), request.wanted.end(), [&](std::size_t k) {
                            return k >= first[e] && k < first[e] + plan_.experiments[e].measured.size();
                          });
      if (wanted) {
        jobs.push_back(job(plan_.experiments[e], request.parameters, request.seed));
        places.push_back({r, e});
      }
    }
  }
  const std::vector<JobOutcome> done = run(jobs);
  std::vector<RunOutcome> outcomes(requests.size());
  for (RunOutcome& outcome : outcomes) {
    outcome.observed.assign(observables, std::numeric_limits<double>::quiet_NaN());
  }
  for (std::size_t j = 0; j < done.size(); ++j) {
    const auto [r, e] = places[j];
    const PlannedExperiment& experiment = plan_.experiments[e];
    if (!done[j].failure.empty()) {
      outcomes[r].failure = message(experiment.name, ": ", done[j].failure);
      continue;
    }
    for (std::size_t k = 0; k < experiment.used.size(); ++k) {
      outcomes[r].observed[first[e] + k] = done[j].values.at(experiment.used[k]);
    }
  }
  return outcomes;
}

std::vector<RunOutcome> Trials::replicates(const std::vector<Replicate>& wanted) {
  std::vector<Job> jobs;
  for (const Replicate& r : wanted) {
    jobs.push_back(job(r.experiment, r.parameters, r.seed));
  }
  std::vector<RunOutcome> out;
  for (JobOutcome& outcome : run(jobs)) {
    out.push_back({std::move(outcome.values), std::move(outcome.failure)});
  }
  return out;
}

} // namespace scree::examples
