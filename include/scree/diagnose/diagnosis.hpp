#pragma once
/// \file
/// What a simulation gets wrong, and why.

#include "scree/calibrate/measured.hpp"
#include "scree/calibrate/response_surface.hpp"
#include "scree/diagnose/bootstrap.hpp"
#include "scree/diagnose/cause.hpp"
#include "scree/diagnose/diagnosis_setup.hpp"
#include "scree/diagnose/held_out.hpp"
#include "scree/diagnose/hypothesis.hpp"
#include "scree/diagnose/rivals.hpp"
#include "scree/diagnose/verdict.hpp"
#include "scree/diagnose/where.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace scree {

/// Judges from runs that were made; makes none itself.
class Diagnostician {
public:
  /// \param measured what is fitted
  /// \param held_out what is only predicted; may be empty
  /// \param runs over the whole space, with all of these observables, those held out last
  /// \throws Error for too few runs, runs without all observables, or a setup that makes no sense.
  Diagnostician(const ModelSpace& space, const std::vector<Measured>& measured,
                const std::vector<Measured>& held_out, const std::vector<Run>& runs,
                const DiagnosisSetup& setup = {})
      : Diagnostician{space, measured, held_out,
                      ResponseSurface{with_observables(runs, measured.size() + held_out.size()),
                                      space.null_of_causes(), reach(space, measured, held_out)},
                      setup} {}

  Diagnostician(const Diagnostician&) = delete;
  Diagnostician& operator=(const Diagnostician&) = delete;
  Diagnostician(Diagnostician&&) = delete;
  Diagnostician& operator=(Diagnostician&&) = delete;
  ~Diagnostician() = default;

  /// Where more runs would tell most: at the best points of the most likely hypotheses, as shares of the
  /// space.
  [[nodiscard]] std::vector<Eigen::VectorXd> of_interest(std::size_t count) const {
    std::vector<Eigen::VectorXd> out;
    for (const std::size_t h : rivals_.by_likelihood()) {
      if (out.size() < count) {
        out.push_back(rivals_.best_point(h));
      }
    }
    return out;
  }

  /// How often such data would be taken for each of the causes, or for nothing (last), were one of them at
  /// work. \param value of its first parameter, in its unit; a second one has no effect
  [[nodiscard]] std::vector<double> taken_for(std::size_t cause, double value) {
    const Parameter& parameter =
        rivals_.space().parameters()[static_cast<std::size_t>(rivals_[cause + 1].free()[0])];
    Random random{rivals_.setup().seed, "diagnosis, taken for"};
    return look_alikes(rivals_.point_of(cause, parameter.share(value)), rivals_.setup().draws, random);
  }

  /// What an extended model gains on the held-out data where it and the base model were run there, each at
  /// one point: what is not known of their parameters does not count.
  ///
  /// \param base, extended runs with the observables that were held out, as they are compared
  /// \throws Error for less than two runs of either, or where nothing was held out.
  [[nodiscard]] Gain gain_of_runs(const std::vector<Eigen::VectorXd>& base,
                                  const std::vector<Eigen::VectorXd>& extended) const {
    if (!held_out_response_) {
      throw Error("diagnosis: nothing was held out, on which something could be gained");
    }
    const Noise noise{held_out_, *held_out_response_};
    Random random{rivals_.setup().seed, "diagnosis, gain of runs"};
    return held_out_gain(noise, mean_of_runs(noise, base), mean_of_runs(noise, extended),
                         rivals_.setup().confidence, rivals_.setup().draws, random)
        .gain;
  }

  [[nodiscard]] Diagnosis operator()() {
    Random random{rivals_.setup().seed, "diagnosis"};
    Diagnosis out;
    out.alarm = alarm()(rivals_.single_seen());
    out.base_adequacy = out.alarm.omnibus;
    out.scatter = rivals_.noise().prior();
    residuals(out);
    confusion(out, random);
    if (out.alarm.p > rivals_.setup().false_alarms) {
      judge_silence(out);
      rank(out);
      out.named = {place_of(out, {})};
      return out;
    }
    std::vector<std::size_t> left = rivals_.not_refuted(random);
    if (left.empty() || left.front() != rivals_.by_likelihood().front()) {
      rivals_.try_pairs();
      left = rivals_.not_refuted(random);
    }
    rank(out);
    if (left.empty()) {
      nothing_suffices(out);
      return out;
    }
    name_what_remains(out, left);
    hold_out(out, left.front(), random);
    // What is refuted may be the truth in another form, and what is less likely then fits by bending: it
    // needs data that it was not fitted to.
    const bool second_choice = left.front() != rivals_.by_likelihood().front();
    const bool confirmed =
        out.held_out && out.held_out->gain.low > 0.0 && out.finding != Finding::unexplained;
    if (second_choice && !confirmed) {
      nothing_suffices(out);
    }
    return out;
  }

private:
  /// \param response of all of these observables over the whole space, those held out last
  Diagnostician(const ModelSpace& space, const std::vector<Measured>& measured,
                std::vector<Measured> held_out, const ResponseSurface& response, const DiagnosisSetup& setup)
      : held_out_{std::move(held_out)},
        rivals_{space, measured, part_of(response, 0, measured.size()), setup} {
    if (!held_out_.empty()) {
      held_out_response_ = part_of(response, measured.size(), held_out_.size());
    }
  }

  static const std::vector<Run>& with_observables(const std::vector<Run>& runs, std::size_t count) {
    for (const Run& run : runs) {
      if (static_cast<std::size_t>(run.observed.size()) < count) {
        throw Error(message("diagnosis: a run has ", run.observed.size(), " observables where ", count,
                            " are needed"));
      }
    }
    return runs;
  }
  static Reach reach(const ModelSpace& space, std::vector<Measured> observables,
                     const std::vector<Measured>& held_out) {
    observables.insert(observables.end(), held_out.begin(), held_out.end());
    return reach_of(space.parameters(), observables);
  }
  static ResponseSurface part_of(const ResponseSurface& response, std::size_t first, std::size_t count) {
    return response.part(static_cast<Eigen::Index>(first), static_cast<Eigen::Index>(count));
  }

  void residuals(Diagnosis& out) const {
    const Eigen::VectorXd base = rivals_.best_point(0);
    const Posterior posterior{rivals_.measured(), rivals_.response(), Prior::even(rivals_.space().size()),
                              base};
    const Eigen::VectorXd all = posterior.standardised_residuals();
    out.residuals.assign(all.begin(), all.end());
    out.where =
        where_wrong(rivals_.noise(), rivals_.measured(), rivals_[0].points()[0].local, rivals_.court().base);
  }

  const AlarmTest& alarm() {
    if (!alarm_) {
      Random random{rivals_.setup().seed, "diagnosis, alarm"};
      alarm_.emplace(rivals_.court(), rivals_.single(), rivals_.setup().draws, random);
    }
    return *alarm_;
  }

  /// What data from `truth` would be taken for; for nothing last.
  [[nodiscard]] std::vector<double> look_alikes(const Hypothesis::Point& truth, std::size_t draws,
                                                Random& random) {
    std::vector<double> row = scree::taken_for(rivals_.court(), rivals_.single(), alarm(),
                                               rivals_.setup().false_alarms, truth, draws, random);
    std::rotate(row.begin(), row.begin() + 1, row.end());
    return row;
  }

  /// Which causes these data could tell from each other and from nothing.
  void confusion(Diagnosis& out, Random& random) {
    const std::size_t draws = std::max<std::size_t>(rivals_.setup().draws / 8, 20);
    for (std::size_t c = 0; c < rivals_.space().causes().size(); ++c) {
      const double null = rivals_.space().null()[rivals_[c + 1].free()[0]];
      const double half = null < 0.5 ? null + 0.5 * (1.0 - null) : 0.5 * null;
      out.confusion.push_back(look_alikes(rivals_.point_of(c, half), draws, random));
      out.power.push_back(1.0 - out.confusion.back().back());
    }
    out.confusion.push_back(look_alikes(rivals_[0].points()[0], draws, random));
  }

  void judge_silence(Diagnosis& out) const {
    std::vector<double> power = out.power;
    std::sort(power.begin(), power.end());
    const double middle = power.empty() ? 0.0 : power[power.size() / 2];
    if (middle >= rivals_.setup().least_power) {
      out.finding = Finding::no_discrepancy;
      out.reason = message(
          "The base model explains what was measured as well as chance allows (p = ", out.alarm.p, ").");
    } else {
      out.finding = Finding::insufficient_data;
      out.reason = message("The base model is not contradicted (p = ", out.alarm.p,
                           "), but these data would show half-way effects in only ", 100.0 * middle,
                           " % of cases, in the median over all causes.");
    }
  }

  void rank(Diagnosis& out) const {
    const double outside = 0.5 * (1.0 - rivals_.setup().confidence);
    for (const std::size_t h : rivals_.by_likelihood()) {
      Ranked one{.causes = rivals_[h].causes(),
                 .log_odds = rivals_.log_odds(h),
                 .deviance = rivals_.seen(h).deviance,
                 .adequacy = rivals_.known_adequacy(h)};
      for (std::size_t k = 0; k < rivals_[h].free().size(); ++k) {
        const Eigen::Index at = rivals_[h].free()[k];
        const Parameter& parameter = rivals_.space().parameters()[static_cast<std::size_t>(at)];
        const auto value = [&](double probability) {
          return parameter.value(rivals_[h].quantile(rivals_.seen(h), k, probability));
        };
        one.parameters.push_back({at, value(0.5), value(outside), value(1.0 - outside)});
      }
      one.values = rivals_.space().values(rivals_.best_point(h));
      const Eigen::VectorXd& mean = rivals_[h].points()[rivals_.seen(h).best].local.mean;
      one.simulated.assign(mean.begin(), mean.end());
      out.ranking.push_back(std::move(one));
    }
  }
  static std::size_t place_of(const Diagnosis& out, const std::vector<std::size_t>& causes) {
    return static_cast<std::size_t>(std::find_if(out.ranking.begin(), out.ranking.end(),
                                                 [&](const Ranked& r) { return r.causes == causes; }) -
                                    out.ranking.begin());
  }

  static void nothing_suffices(Diagnosis& out) {
    out.finding = Finding::unexplained;
    out.named.clear();
    out.held_out.reset();
    out.reason =
        "The base model does not suffice, and no cause of the catalogue, nor two, explain what is left.";
  }

  void name_what_remains(Diagnosis& out, const std::vector<std::size_t>& left) const {
    for (const std::size_t h : left) {
      out.named.push_back(place_of(out, rivals_[h].causes()));
    }
    const double best = rivals_.log_odds(left.front());
    const bool alone =
        left.size() < 2 || rivals_.log_odds(left[1]) < best - std::log(rivals_.setup().clear_odds);
    if (alone) {
      out.named.resize(1);
      out.finding = rivals_[left.front()].causes().size() > 1 ? Finding::causes : Finding::cause;
      out.reason = "The base model does not suffice, and what is named explains what is left, clearly better "
                   "than any rival.";
    } else {
      out.finding = Finding::indistinguishable;
      out.reason = "The base model does not suffice; several causes explain what is left about as well";
      for (const std::size_t c : rivals_[left.front()].causes()) {
        const bool in_all = std::all_of(left.begin(), left.end(), [&](std::size_t h) {
          const auto& causes = rivals_[h].causes();
          return std::find(causes.begin(), causes.end(), c) != causes.end();
        });
        out.reason += in_all ? message(", all of them with ", rivals_.space().causes()[c].name) : "";
      }
      out.reason += ".";
    }
    if (left.front() != rivals_.by_likelihood().front()) {
      out.reason += message(" What is likelier leaves more than chance does (p = ",
                            rivals_.known_adequacy(rivals_.by_likelihood().front()).value(), ").");
    }
  }

  /// Predicts what was held out; a cause that fails there, or is clearly less likely there than none, is
  /// none.
  void hold_out(Diagnosis& out, std::size_t best, Random& random) const {
    if (!held_out_response_) {
      return;
    }
    const Noise noise{held_out_, *held_out_response_};
    const auto of = [&](std::size_t h) {
      return predicted(rivals_.court(), rivals_[h], rivals_.noise().readings(), rivals_.seen(h),
                       rivals_.space(), *held_out_response_, rivals_.setup().form_tolerance);
    };
    out.held_out =
        held_out_gain(noise, of(0), of(best), rivals_.setup().confidence, rivals_.setup().draws, random);
    const bool contradicted = out.held_out->p < rivals_.setup().least_adequacy;
    // Both: chance alone puts one prediction nearer than the other, and a vague one is unlikely anyhow.
    const bool worse =
        out.held_out->gain.high < 0.0 && out.held_out->log_odds < -std::log(rivals_.setup().clear_odds);
    if (contradicted || worse) {
      out.finding = Finding::unexplained;
      out.named.clear();
      out.reason = "The best of the causes explains what was fitted, but fails on what was held out: ";
      out.reason += contradicted
                        ? message("it leaves more there than chance does (p = ", out.held_out->p, ").")
                        : message("the base model predicts that better (odds ",
                                  std::exp(-out.held_out->log_odds), ").");
    } else if (out.held_out->gain.low <= 0.0) {
      // It may be right all the same: a cause that does not touch what was held out gains nothing there.
      out.reason +=
          message(" What was held out neither shows nor refutes it (gain ", out.held_out->gain.share, ", ",
                  out.held_out->gain.low, " to ", out.held_out->gain.high, ").");
    }
  }

  std::vector<Measured> held_out_;
  std::optional<ResponseSurface> held_out_response_;
  Rivals rivals_;
  std::optional<AlarmTest> alarm_{}; // made when it is needed
};

} // namespace scree
