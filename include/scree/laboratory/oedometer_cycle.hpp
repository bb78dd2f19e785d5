#pragma once
/// \file
/// The curve of confined compression, and what one of its cycles says.

#include "scree/core/error.hpp"

#include <boost/math/statistics/linear_regression.hpp>

#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace scree {

/// A row of the curve. Forces are means over the time since the row before, positive in compression.
struct OedometerPoint {
  double time = 0.0;         ///< s, since the lid carried the low load for the first time
  double displacement = 0.0; ///< m, of the lid since then, down is positive
  double lid_force = 0.0;    ///< N
  double base_force = 0.0;   ///< N, on the floor
  double mantle_force = 0.0; ///< N, by which the mantle is drawn down
  std::size_t cycle = 0;     ///< from 0
  bool loading = true;
};

/// What the slopes of a curve are taken from.
struct SlopeWindow {
  double low_force = 0.0;  ///< N, on the lid, between which and
  double high_force = 0.0; ///< N, the loading and unloading branches are looked at
  double height = 0.0;     ///< m, of the grains at first, above 0
  double area = 0.0;       ///< m2, of the lid, above 0
};

/// One loading and the unloading after it.
struct OedometerCycle {
  double slope = 0.0;       ///< N/m, of the loading between the two points
  double slope_error = 0.0; ///< N/m, standard error of the straight line's slope
  double modulus = 0.0;     ///< Pa, that slope as one of stress against strain
  double compressed = 0.0;  ///< m, displacement at the end of the loading
  /// Of the lid's force, what reaches the base between the two points of the loading, with the weight of the
  /// grains: the mantle bears the rest.
  double base_share = 0.0;
  bool unloaded = false;          ///< whether there is an unloading, and with it the rest
  double unloading_modulus = 0.0; ///< Pa, of the unloading between the same loads
  double permanent = 0.0;         ///< m, displacement at the end of the unloading
  /// J, area between loading and unloading, closed by a straight line where these do not meet.
  double hysteresis = 0.0;
};

namespace detail {

struct Line {
  double slope = 0.0, error = 0.0;
};

/// Through displacement and force of those rows of one branch whose force is within the window.
inline Line line_of_branch(std::span<const OedometerPoint> curve, std::size_t cycle, bool loading,
                           const SlopeWindow& window) {
  std::vector<double> x, y;
  for (const OedometerPoint& p : curve) {
    if (p.cycle == cycle && p.loading == loading && p.lid_force >= window.low_force &&
        p.lid_force <= window.high_force) {
      x.push_back(p.displacement);
      y.push_back(p.lid_force);
    }
  }
  if (x.size() < 3) {
    throw Error(message("oedometer: the slope of ", loading ? "loading " : "unloading ", cycle + 1, " has ",
                        x.size(), " points between its two loads, which is too few"));
  }
  const auto [offset, slope] = boost::math::statistics::simple_ordinary_least_squares(x, y);
  double mean = 0.0, spread = 0.0, misfit = 0.0;
  for (const double value : x) {
    mean += value / static_cast<double>(x.size());
  }
  for (std::size_t k = 0; k < x.size(); ++k) {
    spread += (x[k] - mean) * (x[k] - mean);
    misfit += std::pow(y[k] - offset - slope * x[k], 2);
  }
  return {slope, std::sqrt(misfit / (static_cast<double>(x.size() - 2) * spread))};
}

} // namespace detail

/// What the rows of `cycle` (from 0) say.
/// \throws Error for fewer than three rows of a branch within the window.
inline OedometerCycle oedometer_cycle(std::span<const OedometerPoint> curve, std::size_t cycle,
                                      const SlopeWindow& window) {
  OedometerCycle out;
  double work = 0.0, lid = 0.0, base = 0.0;
  const OedometerPoint *first = nullptr, *before = nullptr;
  for (const OedometerPoint& p : curve) {
    if (p.cycle != cycle) {
      continue;
    }
    if (before != nullptr) {
      work += 0.5 * (p.lid_force + before->lid_force) * (p.displacement - before->displacement);
    }
    if (p.loading && p.lid_force >= window.low_force && p.lid_force <= window.high_force) {
      lid += p.lid_force;
      base += p.base_force;
    }
    (p.loading ? out.compressed : out.permanent) = p.displacement;
    out.unloaded = out.unloaded || !p.loading;
    first = first == nullptr ? &p : first;
    before = &p;
  }
  const double to_modulus = window.height / window.area;
  const detail::Line loading = detail::line_of_branch(curve, cycle, true, window);
  out.slope = loading.slope;
  out.slope_error = loading.error;
  out.modulus = loading.slope * to_modulus;
  out.base_share = base / lid;
  if (out.unloaded) {
    out.unloading_modulus = detail::line_of_branch(curve, cycle, false, window).slope * to_modulus;
    out.hysteresis =
        work - 0.5 * (first->lid_force + before->lid_force) * (before->displacement - first->displacement);
  }
  return out;
}

} // namespace scree
