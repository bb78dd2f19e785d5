#pragma once
/// \file
/// A rock, some of its parameters, experiments with it, and what was measured in them.

#include "laboratory/experiment.hpp"

#include "scree/calibrate/measured.hpp"
#include "scree/calibrate/one_by_one.hpp"
#include "scree/calibrate/parameter.hpp"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace scree::examples {

/// One experiment of a plan.
struct PlannedExperiment {
  std::string name;
  std::string kind;
  std::unique_ptr<Experiment> experiment;
  std::string setup;                ///< all its numbers as one line of JSON
  std::vector<std::size_t> used{};  ///< which of its observables were measured
  std::vector<Measured> measured{}; ///< these
  std::filesystem::path curve{};    ///< a measured curve, to be drawn; empty for none
  bool held_out = false;            ///< not to be fitted, but to be predicted
};

struct Plan {
  std::filesystem::path folder;
  RockModel model;  ///< with the start values
  std::string rock; ///< all its numbers as one line of JSON
  std::vector<Parameter> space{};
  std::vector<double> start{}; ///< of each parameter
  std::vector<PlannedExperiment> experiments{};
  std::vector<PlannedExperiment> possible{}; ///< not done yet: without anything measured
  std::vector<FitStep> steps{};              ///< of the fit one by one
  std::vector<std::string> remarks{};

  /// Of all experiments, in their order.
  [[nodiscard]] std::vector<Measured> measured() const;
  /// Drops the experiments that are held out, with a remark for each.
  void drop_held_out();
  /// \throws Error for a name that none of the experiments has.
  [[nodiscard]] std::size_t index_of(const std::string& experiment) const;
  /// The model with other parameters.
  [[nodiscard]] RockModel with(const std::vector<double>& parameters) const;
};

} // namespace scree::examples
