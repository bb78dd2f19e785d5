#pragma once
/// \file
/// What a diagnosis says.

#include "scree/diagnose/bootstrap.hpp"
#include "scree/diagnose/held_out.hpp"
#include "scree/diagnose/scatter_prior.hpp"
#include "scree/diagnose/where.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace scree {

/// The verdicts that there are.
enum class Finding { no_discrepancy, cause, causes, indistinguishable, unexplained, insufficient_data };

inline std::string name_of(Finding finding) {
  static constexpr const char* names[] = {"no_discrepancy",    "cause",       "causes",
                                          "indistinguishable", "unexplained", "insufficient_data"};
  return names[static_cast<std::size_t>(finding)];
}

/// One hypothesis as the data see it.
struct Ranked {
  std::vector<std::size_t> causes; ///< none: the base model
  double log_odds = 0.0;           ///< natural logarithm of the odds over the base model
  double deviance = 0.0;
  std::optional<double> adequacy{}; ///< probability of such a deviance by chance, of those near the best
  struct Interval {
    Eigen::Index parameter; ///< in the space
    double value, low, high;
  };
  std::vector<Interval> parameters{}; ///< of its causes, in their units
  std::vector<double> values{};       ///< of the whole space, in their units, at its best point
  std::vector<double> simulated{};    ///< observables there, as compared
};

struct Diagnosis {
  Finding finding = Finding::insufficient_data;
  std::vector<Ranked> ranking; ///< base model, single causes and pairs that were tried, most likely first
  /// Places in the ranking of what the verdict names: one, or all that remain where several do.
  std::vector<std::size_t> named;
  Alarm alarm;
  double base_adequacy = 1.0;
  /// Measured less what the base model gives, over the standard error of that, fitted to all.
  std::vector<double> residuals;
  Where where; ///< the base model goes wrong
  std::optional<HeldOutGain> held_out{};
  /// For each cause at half its range, and for no cause last: how often it is taken for each of the causes,
  /// or for none (last).
  std::vector<std::vector<double>> confusion;
  std::vector<double> power; ///< for each cause, how often half its range raises the alarm
  ScatterPrior scatter;      ///< how far simulated scatter told the measured one
  std::string reason;        ///< of the verdict, in a sentence
};

/// Whether something explains what was fitted, but not what was held out.
inline bool refused_by_held_out(const Diagnosis& diagnosis) {
  return diagnosis.finding == Finding::unexplained && diagnosis.held_out.has_value();
}

} // namespace scree
