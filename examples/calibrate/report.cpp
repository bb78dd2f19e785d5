#include "calibrate/report.hpp"

#include "scree/io/csv.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <system_error>

namespace calibrate {

using namespace scree;
using examples::Plan;
using examples::PlannedExperiment;
using examples::Trials;
namespace ex = scree::examples;
using Json = nlohmann::ordered_json;

namespace {

/// Of the runs that are shown; ours, and none that a calibration draws.
constexpr std::uint64_t first_shown = 1000;
constexpr std::size_t shown = 4;

Json numbers(const Eigen::VectorXd& values) {
  return std::vector<double>(values.begin(), values.end());
}

} // namespace

Json described(const Plan& plan, const JointFit& fit) {
  Json out;
  for (std::size_t k = 0; k < plan.space.size(); ++k) {
    const Estimate& e = fit.parameters[k];
    out["parameters"][plan.space[k].name] = {
        {"unit", plan.space[k].unit},  {"estimate", e.value},
        {"interval", {e.low, e.high}}, {"at_bound", e.at_bound},
        {"determined", e.determined},  {"share_of_variance_from_simulations", e.simulated_share}};
  }
  for (std::size_t i = 0; i < plan.space.size(); ++i) {
    for (std::size_t k = i + 1; k < plan.space.size(); ++k) {
      out["correlation"][plan.space[i].name][plan.space[k].name] =
          fit.correlation(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k));
    }
  }
  out["undetermined_directions"] = Json::array();
  for (Eigen::Index d = 0; d < fit.undetermined.cols(); ++d) {
    out["undetermined_directions"].push_back(numbers(fit.undetermined.col(d)));
  }
  const auto measured = plan.measured();
  for (std::size_t k = 0; k < measured.size(); ++k) {
    out["residuals_over_their_standard_error"][measured[k].name] = fit.residuals[k];
  }
  out["misfit"] = fit.misfit;
  out["runs"] = fit.runs;
  out["failed_runs"] = fit.failed;
  out["reasons_of_failure"] = fit.failures;
  return out;
}

Json described(const Plan& plan, const OneByOneFit& fit, const std::filesystem::path& folder) {
  CsvWriter table{folder / "one_by_one.csv",
                  {"round", "step", "iteration", "value", "observed", "deviation"},
                  "Deviations are logarithmic where observables are compared by their logarithm."};
  const auto measured = plan.measured();
  Json out;
  for (const FitIteration& i : fit.history) {
    table.row({static_cast<double>(i.round + 1), static_cast<double>(i.step + 1),
               static_cast<double>(i.iteration + 1), i.value, i.observed, i.deviation});
    out["iterations"].push_back({{"round", i.round + 1},
                                 {"parameter", plan.space[plan.steps[i.step].parameter].name},
                                 {"value", i.value},
                                 {"observable", measured[plan.steps[i.step].observable].name},
                                 {"observed", i.observed},
                                 {"deviation", i.deviation}});
  }
  for (std::size_t k = 0; k < plan.space.size(); ++k) {
    out["parameters"][plan.space[k].name] = {{"unit", plan.space[k].unit}, {"estimate", fit.parameters[k]}};
  }
  out["converged"] = fit.converged;
  out["runs"] = fit.runs;
  out["failed_runs"] = fit.failed;
  return out;
}

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
    const ex::CurveFile curve = planned.experiment->curve();
    ex::Panel curves{curve.title, curve.x_label, curve.y_label, {}};
    ex::Panel observables{"Observables over what was measured", "observable", "", {}};
    if (!planned.curve.empty()) {
      curves.curves.push_back({std::filesystem::absolute(planned.curve), curve.x, curve.y, "measured"});
    }
    for (std::size_t k = 0; k < planned.measured.size(); ++k) {
      const Measured& m = planned.measured[k];
      const double middle = m.logarithmic ? std::exp(m.mean()) : m.mean();
      for (const double value : m.replicates) {
        observables.points.push_back({static_cast<double>(k + 1) - 0.2, value / middle, "measured", 0});
      }
    }
    for (std::size_t s = 0; s < 2; ++s) {
      std::vector<Trials::Replicate> wanted;
      for (std::size_t n = 0; n < shown; ++n) {
        wanted.push_back({e, sides[s].parameters, first_shown + n});
      }
      for (const RunOutcome& run : trials.replicates(wanted)) {
        for (std::size_t k = 0; run.failure.empty() && k < planned.measured.size(); ++k) {
          const Measured& m = planned.measured[k];
          const double middle = m.logarithmic ? std::exp(m.mean()) : m.mean();
          observables.points.push_back({static_cast<double>(k + 1) + 0.2 * static_cast<double>(s),
                                        run.observed[planned.used[k]] / middle, sides[s].name, 1});
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
    for (std::size_t k = 0; k < planned.measured.size(); ++k) {
      observables.x_label += message(k == 0 ? ": " : ", ", k + 1, " ", planned.measured[k].name);
    }
    const std::string complaint = ex::draw_plot(folder, "fit_" + planned.name,
                                                planned.name + ", before and after", {curves, observables});
    complaints += complaint.empty() ? "" : complaint + "\n";
  }
  return complaints;
}

} // namespace calibrate
