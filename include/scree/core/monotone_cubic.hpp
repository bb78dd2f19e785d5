#pragma once
/// \file
/// A smooth curve through points that goes up and down only where they do.

#include <boost/math/interpolators/cubic_hermite.hpp>

#include <cstddef>
#include <utility>
#include <vector>

namespace scree {

/// Cubic pieces whose slopes at the points are harmonic means of those of the chords beside them, or 0 where
/// the chords turn (Fritsch & Butland 1984). To be asked for places between the first and the last point.
using MonotoneCubic = boost::math::interpolators::cubic_hermite<std::vector<double>>;

/// \param x ascending, two or more
/// \param y as many
inline MonotoneCubic monotone_cubic(std::vector<double> x, std::vector<double> y) {
  const std::size_t last = x.size() - 1;
  std::vector<double> slope(x.size(), 0.0);
  const auto chord = [&](std::size_t k) { return (y[k] - y[k - 1]) / (x[k] - x[k - 1]); };
  slope.front() = chord(1);
  slope.back() = chord(last);
  for (std::size_t k = 1; k < last; ++k) {
    const double before = chord(k), after = chord(k + 1);
    if (before * after > 0.0) {
      const double left = x[k] - x[k - 1], right = x[k + 1] - x[k];
      const double w1 = 2.0 * right + left, w2 = right + 2.0 * left;
      slope[k] = (w1 + w2) / (w1 / before + w2 / after);
    }
  }
  return MonotoneCubic{std::move(x), std::move(y), std::move(slope)};
}

} // namespace scree
