#pragma once
/// \file
/// What hypotheses would say of data that were drawn again: false alarms, adequacy and confusion, by
/// parametric bootstrap of the whole judgement.

#include "scree/core/random.hpp"
#include "scree/diagnose/hypothesis.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace scree {

/// All that judgements need beside the hypotheses.
struct Court {
  const Noise& noise;
  Prior base; ///< prior of the base parameters

  [[nodiscard]] Judgement judge(const Hypothesis& hypothesis, const Readings& readings) const {
    return hypothesis.judge(noise, readings, base);
  }
  [[nodiscard]] std::vector<Judgement> judge_all(std::span<const Hypothesis> hypotheses,
                                                 const Readings& readings) const {
    std::vector<Judgement> out;
    out.reserve(hypotheses.size());
    for (const Hypothesis& hypothesis : hypotheses) {
      out.push_back(judge(hypothesis, readings));
    }
    return out;
  }
  /// Data as they would be if a point of a hypothesis were the truth. The simulated means that it is known by
  /// are off themselves, and by as much elsewhere nearby.
  [[nodiscard]] Readings drawn(const Hypothesis::Point& truth, Random& random) const {
    return noise.drawn(truth.local.mean + noise.normal(truth.local.variance, random), random);
  }
};

/// Share of `drawn` at or above `seen`, with which chance alone explains it.
inline double share_above(const std::vector<double>& drawn, double seen) {
  const auto above = std::count_if(drawn.begin(), drawn.end(), [&](double d) { return d >= seen; });
  return (static_cast<double>(above) + 1.0) / (static_cast<double>(drawn.size()) + 1.0);
}

/// Whether a hypothesis leaves no more than chance does.
/// \return the probability of a deviance like that of `seen`, were the best point of the hypothesis the truth
inline double adequacy(const Court& court, const Hypothesis& hypothesis, const Judgement& seen,
                       std::size_t draws, Random& random) {
  std::vector<double> deviances;
  for (std::size_t d = 0; d < draws; ++d) {
    const Readings again = court.drawn(hypothesis.points()[seen.best], random);
    deviances.push_back(court.judge(hypothesis, again).deviance);
  }
  return share_above(deviances, seen.deviance);
}

/// Whether the base model alone is to be doubted.
struct Alarm {
  double omnibus = 1.0;  ///< probability by chance: of so great a deviance
  double directed = 1.0; ///< of so much evidence for the best of the causes
  double p = 1.0;        ///< of the smaller of the two
};

/// Two tests at once: what the base model leaves over at all, and what a cause would explain of it. Both are
/// set against data drawn from the base model.
class AlarmTest {
public:
  /// \param hypotheses the base model first, then the causes
  AlarmTest(const Court& court, std::span<const Hypothesis> hypotheses, std::size_t draws, Random& random) {
    for (std::size_t d = 0; d < draws; ++d) {
      const Readings again = court.drawn(hypotheses[0].points()[0], random);
      const std::vector<Judgement> all = court.judge_all(hypotheses, again);
      omnibus_.push_back(all[0].deviance);
      directed_.push_back(directed_of(all));
    }
    for (std::size_t d = 0; d < draws; ++d) {
      const double p = std::min(share_above(omnibus_, omnibus_[d]), share_above(directed_, directed_[d]));
      rarity_.push_back(-p);
    }
  }

  /// \param seen judgements of the same hypotheses on other data
  [[nodiscard]] Alarm operator()(std::span<const Judgement> seen) const {
    Alarm out{.omnibus = share_above(omnibus_, seen[0].deviance),
              .directed = share_above(directed_, directed_of(seen))};
    out.p = share_above(rarity_, -std::min(out.omnibus, out.directed));
    return out;
  }

private:
  static double directed_of(std::span<const Judgement> all) {
    double most = -HUGE_VAL;
    for (std::size_t h = 1; h < all.size(); ++h) {
      most = std::max(most, all[h].log_evidence - all[0].log_evidence);
    }
    return most;
  }

  std::vector<double> omnibus_, directed_, rarity_;
};

/// What data are taken for that come from `truth`: how often for each of the hypotheses. The first of these
/// is the base model, and has all that raise no alarm.
inline std::vector<double> taken_for(const Court& court, std::span<const Hypothesis> hypotheses,
                                     const AlarmTest& alarm, double false_alarms,
                                     const Hypothesis::Point& truth, std::size_t draws, Random& random) {
  std::vector<double> share(hypotheses.size(), 0.0);
  for (std::size_t d = 0; d < draws; ++d) {
    const std::vector<Judgement> all = court.judge_all(hypotheses, court.drawn(truth, random));
    const auto best = std::max_element(all.begin() + 1, all.end(), [](const auto& a, const auto& b) {
      return a.log_evidence < b.log_evidence;
    });
    const bool alarmed = all.size() > 1 && alarm(all).p <= false_alarms;
    share[alarmed ? static_cast<std::size_t>(best - all.begin()) : 0] += 1.0 / static_cast<double>(draws);
  }
  return share;
}

} // namespace scree
