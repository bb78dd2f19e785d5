#pragma once
/// \file
/// Something that a simulation may lack.

#include "scree/calibrate/parameter.hpp"
#include "scree/core/error.hpp"

#include <cstddef>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

namespace scree {

/// One or two parameters of a model, of which the base model has the null values and measured data may show
/// others. The parameters' bounds are what is physically possible.
struct Cause {
  std::string name; ///< as in verdicts
  std::vector<Parameter> parameters;
  std::vector<double> null;                ///< of each parameter, within its bounds
  std::string extension{};                 ///< what is to be written into the model
  std::vector<std::string> separated_by{}; ///< kinds of experiment that tell it from its rivals

  /// \throws Error for no or more than two parameters, bounds that are none, or a null value outside of them.
  void check() const {
    if (parameters.empty() || parameters.size() > 2 || null.size() != parameters.size()) {
      throw Error(message("cause ", name, ": ", parameters.size(), " parameters and ", null.size(),
                          " null values; it must have one or two, and a null value for each"));
    }
    for (std::size_t k = 0; k < parameters.size(); ++k) {
      const Parameter& p = parameters[k];
      p.check();
      require(message("cause ", name, ": null value of ", p.name), null[k], {p.least, p.most, p.unit});
    }
  }
};

/// The parameters of a base model and then those of causes, as one space.
class ModelSpace {
public:
  /// \throws Error for no base parameter, a cause that makes no sense, or a name that stands twice.
  ModelSpace(std::vector<Parameter> base, std::vector<Cause> causes)
      : causes_{std::move(causes)}, parameters_{std::move(base)} {
    if (parameters_.empty()) {
      throw Error("diagnosis: needs a parameter of the base model at least");
    }
    base_ = static_cast<Eigen::Index>(parameters_.size());
    for (const Cause& cause : causes_) {
      cause.check();
      first_.push_back(static_cast<Eigen::Index>(parameters_.size()));
      parameters_.insert(parameters_.end(), cause.parameters.begin(), cause.parameters.end());
    }
    std::set<std::string> names;
    for (const Parameter& p : parameters_) {
      if (!names.insert(p.name).second) {
        throw Error(message("diagnosis: parameter ", p.name, " stands twice"));
      }
    }
  }

  [[nodiscard]] const std::vector<Parameter>& parameters() const { return parameters_; }
  [[nodiscard]] const std::vector<Cause>& causes() const { return causes_; }
  [[nodiscard]] Eigen::Index size() const { return static_cast<Eigen::Index>(parameters_.size()); }
  /// Number of base parameters; they come first.
  [[nodiscard]] Eigen::Index base() const { return base_; }

  /// The parameters of some causes, as their places in the space.
  [[nodiscard]] std::vector<Eigen::Index> parameters_of(const std::vector<std::size_t>& causes) const {
    std::vector<Eigen::Index> out;
    for (const std::size_t c : causes) {
      for (std::size_t k = 0; k < causes_[c].parameters.size(); ++k) {
        out.push_back(first_[c] + static_cast<Eigen::Index>(k));
      }
    }
    return out;
  }
  /// Shares: the middle of the base parameters, the null values of all causes.
  [[nodiscard]] Eigen::VectorXd null() const {
    Eigen::VectorXd out = Eigen::VectorXd::Constant(size(), 0.5);
    for (std::size_t c = 0; c < causes_.size(); ++c) {
      for (std::size_t k = 0; k < causes_[c].parameters.size(); ++k) {
        out[first_[c] + static_cast<Eigen::Index>(k)] = causes_[c].parameters[k].share(causes_[c].null[k]);
      }
    }
    return out;
  }
  /// Shares at which the parameters of the causes, the last of all, have no effect.
  [[nodiscard]] Eigen::VectorXd null_of_causes() const { return null().tail(size() - base()); }
  /// In the parameters' units.
  [[nodiscard]] std::vector<double> values(const Eigen::VectorXd& shares) const {
    std::vector<double> out;
    for (Eigen::Index k = 0; k < size(); ++k) {
      out.push_back(parameters_[static_cast<std::size_t>(k)].value(shares[k]));
    }
    return out;
  }

private:
  std::vector<Cause> causes_;
  std::vector<Parameter> parameters_;
  std::vector<Eigen::Index> first_; // parameter of each cause
  Eigen::Index base_ = 0;
};

} // namespace scree
