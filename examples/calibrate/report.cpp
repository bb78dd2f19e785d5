#include "calibrate/report.hpp"

#include "scree/io/csv.hpp"

#include <fmt/format.h>

namespace calibrate {

using namespace scree;
using examples::Plan;
using Json = nlohmann::ordered_json;

namespace {

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
                  {"round", "step", "iteration", "value", "observed", "deviation", "standard_error"},
                  "Deviations and errors are logarithmic where observables are compared by their logarithm."};
  const auto measured = plan.measured();
  Json out;
  for (const FitIteration& i : fit.history) {
    table.row({static_cast<double>(i.round + 1), static_cast<double>(i.step + 1),
               static_cast<double>(i.iteration + 1), i.value, i.observed, i.deviation, i.error});
    out["iterations"].push_back({{"round", i.round + 1},
                                 {"parameter", plan.space[plan.steps[i.step].parameter].name},
                                 {"value", i.value},
                                 {"observable", measured[plan.steps[i.step].observable].name},
                                 {"observed", i.observed},
                                 {"deviation", i.deviation},
                                 {"standard_error", i.error}});
  }
  for (std::size_t k = 0; k < plan.space.size(); ++k) {
    out["parameters"][plan.space[k].name] = {{"unit", plan.space[k].unit}, {"estimate", fit.parameters[k]}};
  }
  out["converged"] = fit.converged;
  out["runs"] = fit.runs;
  out["failed_runs"] = fit.failed;
  return out;
}

} // namespace calibrate
