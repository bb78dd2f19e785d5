#pragma once
/// \file
/// How well a way of judging does over many data sets.

#include "hidden_effects/trial.hpp"

#include "scree/core/error.hpp"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace hidden {

using Judge = std::function<Verdict(const Trial&)>;

/// A verdict of what the diagnosis itself says.
inline Verdict honest(const Trial& t) {
  return verdict_of(t.diagnosed.space, t.diagnosed.diagnosis);
}

/// One requirement: how many of how many, and how many must or may be.
struct Requirement {
  std::string what;
  std::size_t count, of;
  double share;
  bool at_least;

  [[nodiscard]] bool met() const {
    const double wanted = share * static_cast<double>(of), is = static_cast<double>(count);
    return at_least ? is >= wanted - 1e-9 : is <= wanted + 1e-9;
  }
  [[nodiscard]] std::string text() const {
    return scree::message(met() ? "  " : "! ", count, " of ", of, " ", what, " (",
                          at_least ? "at least " : "at most ", 100.0 * share, " %)");
  }
};

/// Share by which the held-out error is left, in the median over the sets with one effect that is named.
inline double held_out_error_left(const std::vector<Trial>& trials) {
  std::vector<double> left;
  for (const Trial& t : trials) {
    const auto& held_out = t.diagnosed.diagnosis.held_out;
    if (t.kind == Kind::one && held_out) {
      left.push_back(held_out->gain.after / held_out->gain.before);
    }
  }
  std::sort(left.begin(), left.end());
  return left.empty() ? 1.0 : left[left.size() / 2];
}

inline std::vector<Requirement> score(const std::vector<Trial>& trials, const Judge& judge) {
  Requirement first{"named first, where confusion is expected in less than 5 %", 0, 0, 22.0 / 24.0, true};
  Requirement clear{"with one effect are expected to be clear", 0, 0, 0.5, true};
  Requirement within{"named with nothing but what is there in the set", 0, 0, 0.95, true};
  Requirement wrong{"named alone, and wrongly", 0, trials.size(), 0.05, false};
  Requirement alarms{"with nothing in them doubted", 0, 0, 1.0 / 12.0, false};
  Requirement outside{"with what is no cause called unexplained", 0, 0, 5.0 / 6.0, true};
  Requirement interval{"intervals with the truth in them", 0, 0, 18.0 / 24.0, true};
  Requirement halved{"held-out errors halved, in the median", held_out_error_left(trials) <= 0.5 ? 1U : 0U, 1,
                     1.0, true};
  for (const Trial& t : trials) {
    const Verdict verdict = judge(t);
    const bool there = std::any_of(verdict.named.begin(), verdict.named.end(),
                                   [&](const auto& causes) { return t.truth.has(causes); });
    wrong.count += verdict.single() && !there ? 1 : 0;
    if (t.kind == Kind::one || t.kind == Kind::two) {
      const bool doubted = verdict.finding != scree::Finding::no_discrepancy &&
                           verdict.finding != scree::Finding::insufficient_data;
      within.of += doubted ? 1 : 0;
      within.count += doubted && there ? 1 : 0;
    }
    if (t.kind == Kind::one) {
      const bool is_clear = t.expected[t.cause()] > 0.95;
      ++clear.of;
      clear.count += is_clear ? 1 : 0;
      first.of += is_clear ? 1 : 0;
      first.count += is_clear && !verdict.named.empty() && t.truth.has(verdict.named.front()) ? 1 : 0;
      const auto& found = t.hypothesis().parameters.at(0);
      interval.of += t.same_form() ? 1 : 0;
      interval.count +=
          t.same_form() && found.low <= t.truth.values[0] && t.truth.values[0] <= found.high ? 1 : 0;
    }
    if (t.kind == Kind::nothing) {
      ++alarms.of;
      alarms.count += verdict.finding != scree::Finding::no_discrepancy ? 1 : 0;
    }
    if (t.kind == Kind::outside) {
      ++outside.of;
      outside.count += verdict.finding == scree::Finding::unexplained ? 1 : 0;
    }
  }
  return {first, clear, within, wrong, alarms, outside, interval, halved};
}

inline bool all_met(const std::vector<Requirement>& requirements) {
  return std::all_of(requirements.begin(), requirements.end(), [](const Requirement& r) { return r.met(); });
}

inline std::string text_of(const std::vector<Requirement>& requirements) {
  std::string out;
  for (const Requirement& r : requirements) {
    out += r.text() + "\n";
  }
  return out;
}

} // namespace hidden
