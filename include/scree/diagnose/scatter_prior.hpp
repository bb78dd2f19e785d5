#pragma once
/// \file
/// What simulated scatter says of measured scatter beforehand.

#include "scree/calibrate/measured.hpp"

#include <boost/math/special_functions/digamma.hpp>
#include <boost/math/special_functions/trigamma.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace scree {

/// Three or four specimens hardly tell how much specimens scatter, but simulated ones scatter much alike, but
/// for a factor. How alike is seen from all observables at once (Smyth, Stat. Appl. Genet. Mol. Biol. 3(1),
/// 2004, section 6.2): variances of the specimens over simulated ones are taken for F-distributed. Those that
/// are far off, as the simulation lacks their scatter or has too much of it, are left out (ours).
struct ScatterPrior {
  double ratio = 1.0;        ///< variance of measured over that of simulated specimens
  double freedom = 0.0;      ///< degrees that this is worth; 0: it is not known
  std::vector<bool> holds{}; ///< for each observable

  static constexpr double most_freedom = 20.0; ///< ours
  static constexpr std::size_t fewest = 5;     ///< observables that it is seen from; ours

  /// \param simulated variance of each observable in single runs, as compared
  static ScatterPrior seen_from(std::span<const Measured> measured, const Eigen::VectorXd& simulated) {
    ScatterPrior out{.holds = std::vector<bool>(measured.size(), false)};
    std::vector<double> logs(measured.size()); // of the ratio, with the mean that it has by chance taken off
    std::vector<double> sorted;
    for (std::size_t k = 0; k < measured.size(); ++k) {
      const Measured& m = measured[k];
      const double seen = m.variance_of_mean() * static_cast<double>(m.replicates.size());
      if (m.error > 0.0 || m.replicates.size() < 2 || !(seen > 0.0)) {
        continue;
      }
      const double half = 0.5 * m.freedom();
      logs[k] = std::log(seen / simulated[static_cast<Eigen::Index>(k)]) - boost::math::digamma(half) +
                std::log(half);
      out.holds[k] = true;
      sorted.push_back(logs[k]);
    }
    std::sort(sorted.begin(), sorted.end());
    double sum = 0.0, squares = 0.0, by_chance = 0.0, count = 0.0;
    for (std::size_t k = 0; k < measured.size(); ++k) {
      if (!out.holds[k]) {
        continue;
      }
      const double chance = boost::math::trigamma(0.5 * measured[k].freedom());
      const double aside = logs[k] - sorted[sorted.size() / 2];
      out.holds[k] = std::abs(aside) <= 5.0 * std::sqrt(chance);
      if (out.holds[k]) {
        sum += aside;
        squares += aside * aside;
        by_chance += chance;
        count += 1.0;
      }
    }
    if (count < static_cast<double>(fewest)) {
      out.holds.assign(measured.size(), false);
      return out;
    }
    const double mean = sum / count;
    const double beyond = (squares - count * mean * mean) / (count - 1.0) - by_chance / count;
    out.freedom = freedom_of(beyond);
    out.ratio = std::exp(sorted[sorted.size() / 2] + mean + boost::math::digamma(0.5 * out.freedom) -
                         std::log(0.5 * out.freedom));
    return out;
  }

private:
  /// The degrees of freedom whose logarithm of chi-squared has this variance.
  static double freedom_of(double variance) {
    double low = 0.1, high = most_freedom;
    if (variance <= boost::math::trigamma(0.5 * high)) {
      return high;
    }
    while (high - low > 1e-6) {
      const double middle = 0.5 * (low + high);
      (boost::math::trigamma(0.5 * middle) > variance ? low : high) = middle;
    }
    return low;
  }
};

} // namespace scree
