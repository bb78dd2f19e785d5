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

/// Two tests at once: what is left over at all, and what a cause would explain of it.
/// \param hypotheses the base model first, then the causes
inline Alarm raise_alarm(const Court& court, std::span<const Hypothesis> hypotheses,
                         std::span<const Judgement> seen, std::size_t draws, Random& random) {
  const auto directed_of = [](std::span<const Judgement> all) {
    double most = -HUGE_VAL;
    for (std::size_t h = 1; h < all.size(); ++h) {
      most = std::max(most, all[h].log_evidence - all[0].log_evidence);
    }
    return most;
  };
  std::vector<double> omnibus, directed;
  for (std::size_t d = 0; d < draws; ++d) {
    const Readings again = court.drawn(hypotheses[0].points()[0], random);
    std::vector<Judgement> all;
    for (const Hypothesis& h : hypotheses) {
      all.push_back(court.judge(h, again));
    }
    omnibus.push_back(all[0].deviance);
    directed.push_back(directed_of(all));
  }
  Alarm out{.omnibus = share_above(omnibus, seen[0].deviance),
            .directed = share_above(directed, directed_of(seen))};
  std::vector<double> smaller; // 1 - p, so that greater is rarer
  for (std::size_t d = 0; d < draws; ++d) {
    smaller.push_back(-std::min(share_above(omnibus, omnibus[d]), share_above(directed, directed[d])));
  }
  out.p = share_above(smaller, -std::min(out.omnibus, out.directed));
  return out;
}

/// What data are taken for that come from `truth`: for each of the hypotheses, how often it has the greatest
/// evidence.
inline std::vector<double> mistaken_for(const Court& court, std::span<const Hypothesis> hypotheses,
                                        const Hypothesis::Point& truth, std::size_t draws, Random& random) {
  std::vector<double> share(hypotheses.size(), 0.0);
  for (std::size_t d = 0; d < draws; ++d) {
    const Readings again = court.drawn(truth, random);
    std::size_t best = 0;
    double most = -HUGE_VAL;
    for (std::size_t h = 0; h < hypotheses.size(); ++h) {
      const double evidence = court.judge(hypotheses[h], again).log_evidence;
      if (evidence > most) {
        most = evidence;
        best = h;
      }
    }
    share[best] += 1.0 / static_cast<double>(draws);
  }
  return share;
}

} // namespace scree
