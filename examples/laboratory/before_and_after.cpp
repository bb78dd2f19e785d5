#include "laboratory/before_and_after.hpp"

#include "scree/core/error.hpp"
#include "support/plot.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <system_error>

namespace scree::examples {

namespace {

/// Of the runs that are shown; ours, and none that a calibration draws.
constexpr std::uint64_t first_shown = 1000;
constexpr std::size_t shown_runs = 4;

} // namespace

std::string draw_before_and_after(const Plan& plan, Trials& trials, const std::vector<double>& before,
                                  const std::vector<double>& after, const std::filesystem::path& folder) {
  std::string complaints;
  struct Side {
    const char* name;
    const std::vector<double>& parameters;
  };
  const Side sides[] = {{"before", before}, {"after", after}};
  for (std::size_t e = 0; e < plan.experiments.size(); ++e) {
    const PlannedExperiment& planned = plan.experiments[e];
    const CurveFile curve = planned.experiment->curve();
    Panel curves{curve.title, curve.x_label, curve.y_label, {}};
    Panel observables{
        "Observables over what was measured", "simulated or measured / mean of measured", "", {}};
    if (!planned.curve.empty()) {
      curves.curves.push_back({std::filesystem::absolute(planned.curve), curve.x, curve.y, "measured"});
    }
    for (std::size_t k = 0; k < planned.measured.size(); ++k) {
      const Measured& m = planned.measured[k];
      const double middle = m.logarithmic ? std::exp(m.mean()) : m.mean();
      observables.rows.push_back(m.name.substr(m.name.rfind('.') + 1)); // the experiment is in the title
      for (const double value : m.replicates) {
        observables.points.push_back({value / middle, static_cast<double>(k + 1) - 0.2, "measured", 0});
      }
    }
    for (std::size_t s = 0; s < 2; ++s) {
      std::vector<Trials::Replicate> wanted;
      for (std::size_t n = 0; n < shown_runs; ++n) {
        wanted.push_back({planned, sides[s].parameters, first_shown + n});
      }
      for (const RunOutcome& run : trials.replicates(wanted)) {
        for (std::size_t k = 0; run.failure.empty() && k < planned.measured.size(); ++k) {
          const Measured& m = planned.measured[k];
          const double middle = m.logarithmic ? std::exp(m.mean()) : m.mean();
          observables.points.push_back({run.observed[planned.used[k]] / middle,
                                        static_cast<double>(k + 1) + 0.2 * static_cast<double>(s),
                                        sides[s].name, 1});
        }
      }
      const auto place = std::filesystem::path{sides[s].name} / planned.name;
      std::error_code error;
      std::filesystem::create_directories(folder / place, error);
      try {
        (void)planned.experiment->observe({.model = plan.with(sides[s].parameters), .seed = first_shown},
                                          folder / place);
        curves.curves.push_back({place / curve.file, curve.x, curve.y, sides[s].name});
      } catch (const Error& failure) {
        complaints += message(planned.name, " ", sides[s].name, ": ", failure.what(), "\n");
      }
    }
    const std::string complaint =
        draw_plot(folder, "fit_" + planned.name, planned.name + ", before and after", {curves, observables});
    complaints += complaint.empty() ? "" : complaint + "\n";
  }
  return complaints;
}

} // namespace scree::examples
