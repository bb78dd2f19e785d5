#pragma once
/// \file
/// What a simulation gets wrong, and why.

#include "scree/calibrate/measured.hpp"
#include "scree/calibrate/response_surface.hpp"
#include "scree/diagnose/bootstrap.hpp"
#include "scree/diagnose/cause.hpp"
#include "scree/diagnose/held_out.hpp"
#include "scree/diagnose/hypothesis.hpp"
#include "scree/diagnose/verdict.hpp"
#include "scree/diagnose/where.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace scree {

/// Where judgement draws its lines. All numbers are ours.
struct DiagnosisSetup {
  double false_alarms = 0.03;   ///< share of faultless simulations that are doubted, in (0, 0.5)
  double least_adequacy = 0.02; ///< probability by chance, below which a hypothesis does not suffice
  double clear_odds = 10.0;     ///< over the next best hypothesis, for one to be named alone; and of the base
                                ///< model on held-out data, for a hypothesis to be worse there
  double kept_odds = 30.0;      ///< within which hypotheses remain in what is returned
  double odds_against_pair = 30.0; ///< by which two causes are less likely beforehand than one
  double confidence = 0.9;         ///< of all intervals
  /// Share by which what a cause does to each observable may be off (one standard deviation), 0 to 1: the
  /// real one is hardly of the very form that the model gives it.
  double form_tolerance = 0.1;
  double least_power = 0.5;      ///< with which half-way effects must be seen for "no discrepancy" to mean it
  std::size_t draws = 400;       ///< of each bootstrap
  std::size_t pair_partners = 4; ///< causes that are tried together with all others
  std::uint64_t seed = 1;

  /// \throws Error for a value out of its range.
  void check() const {
    require("diagnosis false_alarms", false_alarms, {1e-3, 0.5});
    require("diagnosis least_adequacy", least_adequacy, {0.0, 0.5});
    require("diagnosis clear_odds", clear_odds, {1.0, 1e12});
    require("diagnosis kept_odds", kept_odds, {clear_odds, 1e12});
    require("diagnosis odds_against_pair", odds_against_pair, {1.0, 1e12});
    require("diagnosis confidence", confidence, {0.01, 0.999});
    require("diagnosis form_tolerance", form_tolerance, {0.0, 1.0});
    require("diagnosis least_power", least_power, {0.0, 1.0});
    require("diagnosis draws", static_cast<double>(draws), {20.0, 1e6});
  }
};

/// Judges from runs that were made; makes none itself.
class Diagnostician {
public:
  /// \param measured what is fitted
  /// \param held_out what is only predicted; may be empty
  /// \param runs over the whole space, with all of these observables, those held out last
  /// \throws Error for too few runs, runs without all observables, or a setup that makes no sense.
  Diagnostician(const ModelSpace& space, const std::vector<Measured>& measured,
                const std::vector<Measured>& held_out, const std::vector<Run>& runs,
                DiagnosisSetup setup = {})
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
    for (const std::size_t h : by_likelihood()) {
      if (out.size() < count) {
        out.push_back(best_point(h));
      }
    }
    return out;
  }

  /// How often such data would be taken for each of the causes, or for nothing (last), were one of them at
  /// work. \param value of its first parameter, in its unit; a second one has no effect
  [[nodiscard]] std::vector<double> taken_for(std::size_t cause, double value) {
    const Parameter& parameter =
        space_.parameters()[static_cast<std::size_t>(hypotheses_.at(cause + 1).free()[0])];
    Random random{setup_.seed, "diagnosis, taken for"};
    return look_alikes(point_of(cause, parameter.share(value)), setup_.draws, random);
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
    Random random{setup_.seed, "diagnosis, gain of runs"};
    return held_out_gain(noise, mean_of_runs(noise, base), mean_of_runs(noise, extended), setup_.confidence,
                         setup_.draws, random)
        .gain;
  }

  [[nodiscard]] Diagnosis operator()() {
    Random random{setup_.seed, "diagnosis"};
    Diagnosis out;
    out.alarm = alarm()(std::span{seen_}.first(singles()));
    out.base_adequacy = out.alarm.omnibus;
    out.scatter = noise_.prior();
    residuals(out);
    confusion(out, random);
    if (out.alarm.p > setup_.false_alarms) {
      judge_silence(out);
      rank(out);
      out.named = {place_of(out, {})};
      return out;
    }
    std::vector<std::size_t> left = not_refuted(random);
    if (left.empty() || left.front() != by_likelihood().front()) {
      try_pairs();
      left = not_refuted(random);
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
    const bool second_choice = left.front() != by_likelihood().front();
    const bool confirmed =
        out.held_out && out.held_out->gain.low > 0.0 && out.finding != Finding::unexplained;
    if (second_choice && !confirmed) {
      nothing_suffices(out);
    }
    return out;
  }

private:
  /// \param response of all of these observables over the whole space, those held out last
  Diagnostician(const ModelSpace& space, std::vector<Measured> measured, std::vector<Measured> held_out,
                const ResponseSurface& response, DiagnosisSetup setup)
      : space_{space},
        measured_{std::move(measured)},
        held_out_{std::move(held_out)},
        response_{part_of(response, 0, measured_.size())},
        setup_{setup},
        noise_{measured_, response_},
        court_{noise_, Prior::even(space.base())} {
    setup_.check();
    if (!held_out_.empty()) {
      held_out_response_ = part_of(response, measured_.size(), held_out_.size());
    }
    add({}, Eigen::VectorXd::Constant(space_.base(), 0.5));
    for (std::size_t c = 0; c < space_.causes().size(); ++c) {
      add({c}, base_point());
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

  void add(std::vector<std::size_t> causes, const Eigen::VectorXd& start) {
    const auto suitable = Hypothesis::most_suitable(space_, causes, measured_, response_, start);
    add(std::move(causes), suitable);
  }
  void add(std::vector<std::size_t> causes, const Hypothesis::Suitable& suitable) {
    hypotheses_.emplace_back(space_, std::move(causes), measured_, response_, suitable,
                             setup_.form_tolerance);
    seen_.push_back(court_.judge(hypotheses_.back(), noise_.readings()));
  }
  [[nodiscard]] const Eigen::VectorXd& base_point() const { return hypotheses_[0].points()[0].local.base; }

  [[nodiscard]] Eigen::VectorXd best_point(std::size_t h) const {
    const Hypothesis::Point& point = hypotheses_[h].points()[seen_[h].best];
    Eigen::VectorXd at = space_.null();
    at.head(space_.base()) = point.local.base;
    for (std::size_t k = 0; k < hypotheses_[h].free().size(); ++k) {
      at[hypotheses_[h].free()[k]] = point.shares[static_cast<Eigen::Index>(k)];
    }
    return at;
  }

  /// Natural logarithm of the odds over the base model, given that something is wrong or not alike.
  [[nodiscard]] double log_odds(std::size_t h) const {
    return log_odds(seen_[h].log_evidence, hypotheses_[h].causes().size());
  }
  [[nodiscard]] double log_odds(double log_evidence, std::size_t causes) const {
    const double before = causes > 1 ? -std::log(setup_.odds_against_pair) : 0.0;
    return log_evidence - seen_[0].log_evidence + before;
  }
  [[nodiscard]] std::vector<std::size_t> by_likelihood() const {
    std::vector<std::size_t> order(hypotheses_.size());
    for (std::size_t h = 0; h < order.size(); ++h) {
      order[h] = h;
    }
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return log_odds(a) > log_odds(b); });
    return order;
  }

  /// The causes, alone or together, within the kept odds of the most likely one that chance does not refute,
  /// the likeliest first; none where the base model is likelier than all.
  std::vector<std::size_t> not_refuted(Random& random) {
    std::vector<std::size_t> out;
    const std::vector<std::size_t> order = by_likelihood();
    for (const std::size_t h : order) {
      if (order.front() == 0 || log_odds(h) <= log_odds(order.front()) - std::log(setup_.kept_odds)) {
        break;
      }
      if (!adequacy_.contains(h)) {
        adequacy_[h] = adequacy(court_, hypotheses_[h], seen_[h], setup_.draws, random);
      }
      if (h != 0 && adequacy_[h] >= setup_.least_adequacy) {
        out.push_back(h);
      }
    }
    return out;
  }

  /// Each of the most likely causes together with each other one. A pair is no likelier than it is at its
  /// best point: those that are not near what is named even there are left at that.
  void try_pairs() {
    struct Pair {
      std::vector<std::size_t> causes;
      Hypothesis::Suitable suitable;
      double most; // of its log odds
    };
    std::vector<Pair> pairs;
    for (std::vector<std::size_t>& causes : pairs_of_interest()) {
      auto suitable = Hypothesis::most_suitable(space_, causes, measured_, response_, base_point());
      const LocalModel best = Hypothesis::local_at(space_, suitable.at, response_, setup_.form_tolerance);
      const LocalFit fit = fitted(noise_, noise_.readings(), best, court_.base);
      pairs.push_back({std::move(causes), std::move(suitable), log_odds(fit.log_evidence, 2)});
    }
    std::stable_sort(pairs.begin(), pairs.end(),
                     [](const Pair& a, const Pair& b) { return a.most > b.most; });
    constexpr double margin = 7.0; // as best points are only nearly so; ours
    for (Pair& pair : pairs) {
      if (pair.most < log_odds(by_likelihood().front()) - std::log(setup_.kept_odds) - margin) {
        break;
      }
      add(std::move(pair.causes), pair.suitable);
    }
  }
  [[nodiscard]] std::vector<std::vector<std::size_t>> pairs_of_interest() const {
    std::vector<std::size_t> first;
    for (const std::size_t h : by_likelihood()) {
      if (h > 0 && h < singles() && first.size() < setup_.pair_partners) {
        first.push_back(h - 1);
      }
    }
    constexpr std::size_t most_of_pair = 3; // parameters; the grid grows with each by a factor of 6 to 9
    std::vector<std::vector<std::size_t>> out;
    for (auto a = first.begin(); a != first.end(); ++a) {
      for (std::size_t c = 0; c < space_.causes().size(); ++c) {
        const bool done = std::find(first.begin(), a + 1, c) != a + 1;
        if (!done && space_.parameters_of({*a, c}).size() <= most_of_pair) {
          out.push_back({std::min(*a, c), std::max(*a, c)});
        }
      }
    }
    return out;
  }

  void residuals(Diagnosis& out) const {
    const Eigen::VectorXd base = best_point(0);
    const Posterior posterior{measured_, response_, Prior::even(space_.size()), base};
    const Eigen::VectorXd all = posterior.standardised_residuals();
    out.residuals.assign(all.begin(), all.end());
    out.where = where_wrong(noise_, measured_, hypotheses_[0].points()[0].local, court_.base);
  }

  /// The base model and the single causes.
  [[nodiscard]] std::size_t singles() const { return space_.causes().size() + 1; }
  [[nodiscard]] std::span<const Hypothesis> single() const { return std::span{hypotheses_}.first(singles()); }

  const AlarmTest& alarm() {
    if (!alarm_) {
      Random random{setup_.seed, "diagnosis, alarm"};
      alarm_.emplace(court_, single(), setup_.draws, random);
    }
    return *alarm_;
  }

  /// Where the first parameter of a cause is `share`, its others are null, and the base parameters suit best.
  [[nodiscard]] Hypothesis::Point point_of(std::size_t cause, double share) const {
    const Hypothesis& hypothesis = hypotheses_[cause + 1];
    Eigen::VectorXd shares = space_.null()(hypothesis.free());
    shares[0] = share;
    const auto& points = hypothesis.points();
    const auto near = std::min_element(points.begin(), points.end(), [&](const auto& a, const auto& b) {
      return (a.shares - shares).squaredNorm() < (b.shares - shares).squaredNorm();
    });
    return hypothesis.point_at(space_, measured_, response_, shares, near->local.base, setup_.form_tolerance);
  }

  /// What data from `truth` would be taken for; for nothing last.
  [[nodiscard]] std::vector<double> look_alikes(const Hypothesis::Point& truth, std::size_t draws,
                                                Random& random) {
    std::vector<double> row =
        scree::taken_for(court_, single(), alarm(), setup_.false_alarms, truth, draws, random);
    std::rotate(row.begin(), row.begin() + 1, row.end());
    return row;
  }

  /// Which causes these data could tell from each other and from nothing.
  void confusion(Diagnosis& out, Random& random) {
    const std::size_t draws = std::max<std::size_t>(setup_.draws / 8, 20);
    for (std::size_t c = 0; c < space_.causes().size(); ++c) {
      const double null = space_.null()[hypotheses_[c + 1].free()[0]];
      const double half = null < 0.5 ? null + 0.5 * (1.0 - null) : 0.5 * null;
      out.confusion.push_back(look_alikes(point_of(c, half), draws, random));
      out.power.push_back(1.0 - out.confusion.back().back());
    }
    out.confusion.push_back(look_alikes(hypotheses_[0].points()[0], draws, random));
  }

  void judge_silence(Diagnosis& out) const {
    std::vector<double> power = out.power;
    std::sort(power.begin(), power.end());
    const double middle = power.empty() ? 0.0 : power[power.size() / 2];
    if (middle >= setup_.least_power) {
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
    const double outside = 0.5 * (1.0 - setup_.confidence);
    for (const std::size_t h : by_likelihood()) {
      Ranked one{.causes = hypotheses_[h].causes(), .log_odds = log_odds(h), .deviance = seen_[h].deviance};
      if (const auto known = adequacy_.find(h); known != adequacy_.end()) {
        one.adequacy = known->second;
      }
      for (std::size_t k = 0; k < hypotheses_[h].free().size(); ++k) {
        const Eigen::Index at = hypotheses_[h].free()[k];
        const Parameter& parameter = space_.parameters()[static_cast<std::size_t>(at)];
        const auto value = [&](double probability) {
          return parameter.value(hypotheses_[h].quantile(seen_[h], k, probability));
        };
        one.parameters.push_back({at, value(0.5), value(outside), value(1.0 - outside)});
      }
      one.values = space_.values(best_point(h));
      const Eigen::VectorXd& mean = hypotheses_[h].points()[seen_[h].best].local.mean;
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
      out.named.push_back(place_of(out, hypotheses_[h].causes()));
    }
    const double best = log_odds(left.front());
    const bool alone = left.size() < 2 || log_odds(left[1]) < best - std::log(setup_.clear_odds);
    if (alone) {
      out.named.resize(1);
      out.finding = hypotheses_[left.front()].causes().size() > 1 ? Finding::causes : Finding::cause;
      out.reason = "The base model does not suffice, and what is named explains what is left, clearly better "
                   "than any rival.";
    } else {
      out.finding = Finding::indistinguishable;
      out.reason = "The base model does not suffice; several causes explain what is left about as well";
      for (const std::size_t c : hypotheses_[left.front()].causes()) {
        const bool in_all = std::all_of(left.begin(), left.end(), [&](std::size_t h) {
          const auto& causes = hypotheses_[h].causes();
          return std::find(causes.begin(), causes.end(), c) != causes.end();
        });
        out.reason += in_all ? message(", all of them with ", space_.causes()[c].name) : "";
      }
      out.reason += ".";
    }
    if (left.front() != by_likelihood().front()) {
      out.reason += message(" What is likelier leaves more than chance does (p = ",
                            adequacy_.at(by_likelihood().front()), ").");
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
      return predicted(court_, hypotheses_[h], noise_.readings(), seen_[h], space_, *held_out_response_,
                       setup_.form_tolerance);
    };
    out.held_out = held_out_gain(noise, of(0), of(best), setup_.confidence, setup_.draws, random);
    const bool contradicted = out.held_out->p < setup_.least_adequacy;
    // Both: chance alone puts one prediction nearer than the other, and a vague one is unlikely anyhow.
    const bool worse = out.held_out->gain.high < 0.0 && out.held_out->log_odds < -std::log(setup_.clear_odds);
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

  ModelSpace space_;
  std::vector<Measured> measured_, held_out_;
  ResponseSurface response_;
  std::optional<ResponseSurface> held_out_response_;
  DiagnosisSetup setup_;
  Noise noise_;
  Court court_;
  std::vector<Hypothesis> hypotheses_;       // the base model, the single causes, pairs
  std::vector<Judgement> seen_;              // of the measured data, one each
  std::optional<AlarmTest> alarm_{};         // made when it is needed
  std::map<std::size_t, double> adequacy_{}; // of hypotheses, where it was asked for
};

} // namespace scree
