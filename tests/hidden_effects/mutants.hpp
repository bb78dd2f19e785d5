#pragma once
/// \file
/// Ways of judging that are wrong, each of which the suite must refuse.

#include "hidden_effects/score.hpp"

#include <boost/math/distributions/chi_squared.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace hidden {

/// Whatever was measured, the answer is the same.
inline Verdict constant_answer(const Trial&) {
  return {scree::Finding::cause, {{"rolling_resistance"}}};
}

/// What fits best is named; a parameter more costs nothing.
inline Verdict best_fit_without_penalty(const Trial& t) {
  const auto& ranking = t.diagnosed.diagnosis.ranking;
  const auto best = std::min_element(ranking.begin(), ranking.end(),
                                     [](const auto& a, const auto& b) { return a.deviance < b.deviance; });
  return {scree::Finding::cause, {names_of(t.diagnosed.space, best->causes)}};
}

/// Doubt begins where the sum of squared residuals passes the 95 % of a table, as if the noise were known and
/// simulations had none. What is likeliest then is named.
inline Verdict chi_squared_threshold(const Trial& t) {
  const auto& diagnosis = t.diagnosed.diagnosis;
  const auto base = std::find_if(diagnosis.ranking.begin(), diagnosis.ranking.end(),
                                 [](const auto& r) { return r.causes.empty(); });
  double sum = 0.0;
  for (std::size_t k = 0; k < t.diagnosed.fitted.size(); ++k) {
    const scree::Measured& m = t.diagnosed.fitted[k];
    sum += std::pow(m.mean() - base->simulated[k], 2) / scree::variance_of(m);
  }
  const auto freedom =
      static_cast<double>(t.diagnosed.fitted.size()) - static_cast<double>(t.diagnosed.space.base());
  if (sum <= boost::math::quantile(boost::math::chi_squared{freedom}, 0.95)) {
    return {scree::Finding::no_discrepancy, {}};
  }
  const auto best = std::find_if(diagnosis.ranking.begin(), diagnosis.ranking.end(),
                                 [](const auto& r) { return !r.causes.empty(); });
  return {scree::Finding::cause, {names_of(t.diagnosed.space, best->causes)}};
}

/// One cause leaves no trace in the simulations: in all runs with it, it is said to be null.
inline Verdict zeroed_signature(const Trial& t) {
  static const std::string zeroed = "damping";
  if (t.truth.effects != std::vector<std::string>{zeroed}) {
    return honest(t); // it was named nowhere else
  }
  const diagnose::Diagnosed& d = t.diagnosed;
  std::vector<scree::Run> runs = d.log.runs();
  const Eigen::Index at = d.space.parameters_of({t.cause()}).front();
  for (scree::Run& run : runs) {
    run.at[at] = d.space.null()[at];
  }
  scree::DiagnosisSetup setup;
  setup.draws = 200;
  return verdict_of(d.space, scree::Diagnostician{d.space, d.fitted, d.held_out, runs, setup}());
}

} // namespace hidden
