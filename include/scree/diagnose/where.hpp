#pragma once
/// \file
/// Where a model goes wrong: the observable, and the stretch of its curve.

#include "scree/calibrate/measured.hpp"
#include "scree/diagnose/local_model.hpp"
#include "scree/diagnose/noise.hpp"

#include <Eigen/Dense>

#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace scree {

struct Where {
  /// Of each observable: measured less what a fit to all others says, over the standard error of that. Points
  /// of one curve are left out together.
  std::vector<double> residuals;
  std::size_t observable = 0; ///< that is said worst
  /// The stretch of its curve, from onset to end, as observables: neighbours with residuals above 2 to the
  /// same side. Both are the observable itself where it is no point of a curve.
  std::size_t onset = 0, end = 0;
};

/// \param local the model, straightened where it suits all readings
/// \param base prior of the base parameters
inline Where where_wrong(const Noise& noise, std::span<const Measured> measured, const LocalModel& local,
                         const Prior& base) {
  const auto together = [&](std::size_t a, std::size_t b) {
    return a == b || (!measured[a].curve.empty() && measured[a].curve == measured[b].curve &&
                      measured[a].specimens == measured[b].specimens);
  };
  const Readings& seen = noise.readings();
  Where out;
  LocalFit fit;
  for (std::size_t k = 0; k < measured.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    if (k == 0 || measured[k].curve.empty() || !together(k - 1, k)) {
      Readings without = seen;
      for (std::size_t other = 0; other < measured.size(); ++other) {
        without.variance[static_cast<Eigen::Index>(other)] *= together(k, other) ? 1e12 : 1.0;
      }
      fit = fitted(noise, without, local, base);
    }
    const Eigen::RowVectorXd slopes = local.slopes.row(row);
    const double left = seen.mean[row] - local.mean[row] - slopes.dot(fit.base - local.base);
    const double variance =
        seen.variance[row] + local.variance[row] + slopes.dot(fit.precision.llt().solve(slopes.transpose()));
    out.residuals.push_back(left / std::sqrt(variance));
    if (std::abs(out.residuals[k]) > std::abs(out.residuals[out.observable])) {
      out.observable = k;
    }
  }
  const double side = out.residuals[out.observable] < 0.0 ? -1.0 : 1.0;
  const auto goes_on = [&](std::size_t k) {
    return together(out.observable, k) && side * out.residuals[k] > 2.0;
  };
  out.onset = out.end = out.observable;
  while (out.onset > 0 && goes_on(out.onset - 1)) {
    --out.onset;
  }
  while (out.end + 1 < measured.size() && goes_on(out.end + 1)) {
    ++out.end;
  }
  return out;
}

} // namespace scree
