#pragma once
/// \file
/// Hypotheses that compete for what was measured.

#include "scree/calibrate/measured.hpp"
#include "scree/calibrate/posterior.hpp"
#include "scree/calibrate/response_surface.hpp"
#include "scree/core/random.hpp"
#include "scree/diagnose/bootstrap.hpp"
#include "scree/diagnose/cause.hpp"
#include "scree/diagnose/diagnosis_setup.hpp"
#include "scree/diagnose/hypothesis.hpp"
#include "scree/diagnose/local_model.hpp"
#include "scree/diagnose/noise.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace scree {

/// The base model first, then each single cause, then pairs of causes once they are tried: all judged by the
/// measured data. They go by their numbers in this order.
class Rivals {
public:
  /// \param response of the measured observables over the whole space
  /// \throws Error for a setup that makes no sense.
  Rivals(ModelSpace space, std::vector<Measured> measured, ResponseSurface response,
         const DiagnosisSetup& setup)
      : space_{std::move(space)},
        measured_{std::move(measured)},
        response_{std::move(response)},
        setup_{setup},
        noise_{measured_, response_},
        court_{noise_, Prior::even(space_.base())} {
    setup_.check();
    add({}, Eigen::VectorXd::Constant(space_.base(), 0.5));
    for (std::size_t c = 0; c < space_.causes().size(); ++c) {
      add({c}, base_point());
    }
  }

  Rivals(const Rivals&) = delete;
  Rivals& operator=(const Rivals&) = delete;
  Rivals(Rivals&&) = delete;
  Rivals& operator=(Rivals&&) = delete;
  ~Rivals() = default;

  [[nodiscard]] const Hypothesis& operator[](std::size_t h) const { return hypotheses_.at(h); }
  /// What the measured data say of one.
  [[nodiscard]] const Judgement& seen(std::size_t h) const { return seen_.at(h); }

  [[nodiscard]] const DiagnosisSetup& setup() const { return setup_; }
  [[nodiscard]] const ModelSpace& space() const { return space_; }
  [[nodiscard]] const std::vector<Measured>& measured() const { return measured_; }
  [[nodiscard]] const ResponseSurface& response() const { return response_; }
  [[nodiscard]] const Noise& noise() const { return noise_; }
  [[nodiscard]] const Court& court() const { return court_; }

  /// The base model and the single causes, and what the measured data say of these.
  [[nodiscard]] std::span<const Hypothesis> single() const { return std::span{hypotheses_}.first(singles()); }
  [[nodiscard]] std::span<const Judgement> single_seen() const { return std::span{seen_}.first(singles()); }

  /// Natural logarithm of the odds over the base model, given that something is wrong or not alike.
  [[nodiscard]] double log_odds(std::size_t h) const {
    return log_odds(seen_[h].log_evidence, hypotheses_[h].causes().size());
  }
  /// All of them, the likeliest first.
  [[nodiscard]] std::vector<std::size_t> by_likelihood() const {
    std::vector<std::size_t> order(hypotheses_.size());
    for (std::size_t h = 0; h < order.size(); ++h) {
      order[h] = h;
    }
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return log_odds(a) > log_odds(b); });
    return order;
  }

  /// Where one suits the measured data best, in shares of the space.
  [[nodiscard]] Eigen::VectorXd best_point(std::size_t h) const {
    const Hypothesis::Point& point = hypotheses_[h].points()[seen_[h].best];
    Eigen::VectorXd at = space_.null();
    at.head(space_.base()) = point.local.base;
    for (std::size_t k = 0; k < hypotheses_[h].free().size(); ++k) {
      at[hypotheses_[h].free()[k]] = point.shares[static_cast<Eigen::Index>(k)];
    }
    return at;
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

  /// The causes, alone or together, within the kept odds of the most likely one that chance does not refute,
  /// the likeliest first; none where the base model is likelier than all.
  [[nodiscard]] std::vector<std::size_t> not_refuted(Random& random) {
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

  /// The probability of what one leaves by chance, where it was asked for.
  [[nodiscard]] std::optional<double> known_adequacy(std::size_t h) const {
    const auto known = adequacy_.find(h);
    return known == adequacy_.end() ? std::nullopt : std::optional{known->second};
  }

  /// Each of the most likely causes together with each other one. A pair is no likelier than it is at its
  /// best point: those that are not near what is named even there are left at that. References to what is
  /// here hold no longer.
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

private:
  [[nodiscard]] std::size_t singles() const { return space_.causes().size() + 1; }

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

  [[nodiscard]] double log_odds(double log_evidence, std::size_t causes) const {
    const double before = causes > 1 ? -std::log(setup_.odds_against_pair) : 0.0;
    return log_evidence - seen_[0].log_evidence + before;
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

  ModelSpace space_;
  std::vector<Measured> measured_;
  ResponseSurface response_;
  DiagnosisSetup setup_;
  Noise noise_;
  Court court_;
  std::vector<Hypothesis> hypotheses_;
  std::vector<Judgement> seen_;              // of the measured data, one each
  std::map<std::size_t, double> adequacy_{}; // of hypotheses, where it was asked for
};

} // namespace scree
