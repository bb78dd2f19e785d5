#pragma once
/// \file
/// The curves of a drag as a few numbers: means over pieces of the way.

#include "scree/core/error.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace scree {

/// One line of the record of a drag, measured or simulated.
struct DragRow {
  double drag = 0.0;  ///< m
  double force = 0.0; ///< N, as the load cell reads it
  double pitch = 0.0; ///< rad, teeth up
  double depth = 0.0; ///< m
  double mass = 0.0;  ///< kg, in the bucket
  double lag = 0.0;   ///< m, of rope wound in less drag
};

/// Means over equal pieces of the way, by distance, so that they do not depend on how often was read.
struct DragPieces {
  std::vector<double> force, pitch, depth, mass, lag; ///< in the units of the rows
  /// Of the force about a straight line through each piece, root mean square, over the mean force. Depends on
  /// how often is read.
  double roughness = 0.0;
};

namespace detail {

/// Of `y` over `x` between two places, where `x` may also go back for a while; not a number where the rows do
/// not reach that far.
inline double mean_between(std::span<const double> x, std::span<const double> y, double from, double to) {
  double area = 0.0, way = 0.0;
  for (std::size_t k = 1; k < x.size(); ++k) {
    const double a = std::clamp(x[k - 1], from, to), b = std::clamp(x[k], from, to);
    if (a != b) {
      const double slope = (y[k] - y[k - 1]) / (x[k] - x[k - 1]);
      area += (b - a) * (y[k - 1] + slope * (0.5 * (a + b) - x[k - 1]));
      way += b - a;
    }
  }
  return way < (1.0 - 1e-6) * (to - from) ? std::numeric_limits<double>::quiet_NaN() : area / way;
}

/// Sum of squares of what a straight line leaves of the rows between two places, and their number less the
/// two that the line takes.
inline double scatter_between(std::span<const double> x, std::span<const double> y, double from, double to,
                              double& freedom) {
  double n = 0.0, sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0, syy = 0.0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    if (from <= x[k] && x[k] < to) {
      const double u = x[k] - from;
      n += 1.0;
      sx += u;
      sy += y[k];
      sxx += u * u;
      sxy += u * y[k];
      syy += y[k] * y[k];
    }
  }
  if (n < 3.0) {
    return 0.0;
  }
  freedom += n - 2.0;
  const double xx = sxx - sx * sx / n, xy = sxy - sx * sy / n, yy = syy - sy * sy / n;
  return std::max(0.0, yy - (xx > 0.0 ? xy * xy / xx : 0.0));
}

} // namespace detail

/// \param distance m, of drag, above 0
/// \param pieces 1 or more
/// \return not a number where the rows end before `distance`
/// \throws Error for a number out of its range.
inline DragPieces pieces_of(std::span<const DragRow> rows, double distance, std::size_t pieces) {
  require_positive("drag distance", distance, "m");
  require("pieces of the drag", static_cast<double>(pieces), {1.0, 1e4});
  std::vector<double> x;
  for (const DragRow& row : rows) {
    x.push_back(row.drag);
  }
  const auto edge = [&](std::size_t k) {
    return distance * static_cast<double>(k) / static_cast<double>(pieces);
  };
  const auto means = [&](double DragRow::*what) {
    std::vector<double> y, out;
    for (const DragRow& row : rows) {
      y.push_back(row.*what);
    }
    for (std::size_t k = 0; k < pieces; ++k) {
      out.push_back(detail::mean_between(x, y, edge(k), edge(k + 1)));
    }
    return out;
  };
  DragPieces out{means(&DragRow::force), means(&DragRow::pitch), means(&DragRow::depth),
                 means(&DragRow::mass),  means(&DragRow::lag),   0.0};
  std::vector<double> force;
  for (const DragRow& row : rows) {
    force.push_back(row.force);
  }
  double squares = 0.0, freedom = 0.0, mean = 0.0;
  for (std::size_t k = 0; k < pieces; ++k) {
    squares += detail::scatter_between(x, force, edge(k), edge(k + 1), freedom);
    mean += out.force[k] / static_cast<double>(pieces);
  }
  out.roughness = freedom > 0.0 ? std::sqrt(squares / freedom) / std::abs(mean)
                                : std::numeric_limits<double>::quiet_NaN();
  return out;
}

} // namespace scree
