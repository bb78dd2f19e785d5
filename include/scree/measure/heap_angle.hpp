#pragma once
/// \file
/// Angle of repose of a heap.

#include "scree/core/error.hpp"
#include "scree/state/bodies.hpp"

#include <boost/math/statistics/linear_regression.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

namespace scree {

/// Which part of a heap is measured. All numbers are ours.
struct FlankSetup {
  std::uint64_t azimuths = 36; ///< radial lines on which the surface is looked at, 8 or more
  double from = 0.2;           ///< share of the heap's height above which the flank begins
  double to = 0.8;             ///< and below which it ends: toe and apex are left out
  double spacing = 0.25;       ///< between two points of a line, in mean radii of the spheres, above 0

  /// \throws Error for a value out of its range.
  void check() const {
    require("flank azimuths", static_cast<double>(azimuths), {8.0, 1e6});
    require("flank from", from, {0.0, 0.9});
    require("flank to", to, {0.1, 1.0});
    if (!(to > from)) {
      throw Error(message("flank to = ", to, " must be above flank from = ", from));
    }
    require("flank spacing", spacing, {0.01, 10.0});
  }
};

struct HeapPoint {
  double radius = 0.0; ///< m, from the axis
  double height = 0.0; ///< m, of the surface, mean over all azimuths
};

struct HeapAngle {
  double angle = 0.0;               ///< rad, mean over the azimuths
  double standard_error = 0.0;      ///< rad, of that mean
  double independent = 0.0;         ///< azimuths that no grain shares with the next
  double inner = 0.0, outer = 0.0;  ///< m, radii between which the flank was measured
  std::vector<double> azimuths{};   ///< rad, the angle along each radial line
  std::vector<HeapPoint> profile{}; ///< from the axis to twice the outer radius
};

/// The angle of a heap about the z axis on the plane z = 0. The surface is the highest point of any sphere
/// above a point of the plan. Along each radial line a straight line is fitted to it between two radii, which
/// the mean profile gives: chosen by its own height, a rough line would come out too flat.
///
/// Neighbouring lines see the same grains. So the standard error is that of as many lines as there are mean
/// grains (twice the bounding radius) around the middle of the flank, if more are looked at.
/// \throws Error for a setup out of its range, or where there is no flank of at least four points a line.
template <class Real>
HeapAngle heap_angle(const Bodies<Real>& bodies, const FlankSetup& setup = {}) {
  setup.check();
  if (bodies.size() == 0) {
    throw Error("heap angle: there are no grains");
  }
  double grain = 0.0, sphere_radius = 0.0, farthest = 0.0;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    grain += 2.0 * bodies.bounding_radius(b) / static_cast<double>(bodies.size());
  }
  for (const auto& sphere : bodies.spheres()) {
    sphere_radius += static_cast<double>(sphere.radius) / static_cast<double>(bodies.sphere_count());
    farthest = std::max(farthest, std::hypot(sphere.position.x, sphere.position.y));
  }
  const double step = setup.spacing * sphere_radius;
  const auto points = static_cast<std::size_t>(std::min(1e5, std::ceil(farthest / step))) + 1;
  const std::size_t lines = setup.azimuths;

  // Heights by line and point; the plate is the least.
  std::vector<double> height(lines * points, 0.0);
  for (const auto& sphere : bodies.spheres()) {
    const Vector at = to_eigen(sphere.position);
    const auto radius = static_cast<double>(sphere.radius);
    const double off_axis = at.head<2>().norm();
    const auto first = static_cast<std::size_t>(std::max(0.0, std::floor((off_axis - radius) / step)));
    const auto last = std::min(points, static_cast<std::size_t>(std::ceil((off_axis + radius) / step)) + 1);
    for (std::size_t line = 0; line < lines; ++line) {
      const double azimuth = 2.0 * std::numbers::pi * static_cast<double>(line) / static_cast<double>(lines);
      const Eigen::Vector2d along{std::cos(azimuth), std::sin(azimuth)};
      const double aside = along.x() * at.y() - along.y() * at.x();
      if (std::abs(aside) >= radius || along.dot(at.head<2>()) < -radius) {
        continue;
      }
      for (std::size_t k = first; k < last; ++k) {
        const double apart2 = (static_cast<double>(k) * step * along - at.head<2>()).squaredNorm();
        if (apart2 < radius * radius) {
          double& known = height[line * points + k];
          known = std::max(known, at.z() + std::sqrt(radius * radius - apart2));
        }
      }
    }
  }

  HeapAngle out;
  double top = 0.0;
  for (std::size_t k = 0; k < points; ++k) {
    double mean = 0.0;
    for (std::size_t line = 0; line < lines; ++line) {
      mean += height[line * points + k] / static_cast<double>(lines);
    }
    top = std::max(top, mean);
    out.profile.push_back({static_cast<double>(k) * step, mean});
  }
  // Outwards from the last point as high as `to`, to the first below `from`.
  std::size_t inner = 0;
  for (std::size_t k = 0; k < points; ++k) {
    inner = out.profile[k].height >= setup.to * top ? k : inner;
  }
  std::size_t outer = inner;
  while (outer + 1 < points && out.profile[outer].height > setup.from * top) {
    ++outer;
  }
  if (outer < inner + 3) {
    throw Error(message("heap angle: the flank between ", setup.from, " and ", setup.to, " of the height ",
                        top, " m has only ", outer - inner + 1, " points: too few grains for a heap"));
  }
  out.inner = out.profile[inner].radius;
  out.outer = out.profile[outer].radius;
  // Single grains that rolled off are no part of it.
  out.profile.resize(std::min(points, 2 * outer));

  double spread = 0.0;
  std::vector<double> x, y;
  for (std::size_t line = 0; line < lines; ++line) {
    x.clear();
    y.clear();
    for (std::size_t k = inner; k <= outer; ++k) {
      x.push_back(out.profile[k].radius);
      y.push_back(height[line * points + k]);
    }
    const auto fit = boost::math::statistics::simple_ordinary_least_squares(x, y);
    out.azimuths.push_back(std::atan(-fit.second));
    out.angle += out.azimuths.back() / static_cast<double>(lines);
  }
  for (const double angle : out.azimuths) {
    spread += (angle - out.angle) * (angle - out.angle) / static_cast<double>(lines - 1);
  }
  out.independent = std::min(static_cast<double>(lines), std::numbers::pi * (out.inner + out.outer) / grain);
  out.standard_error = std::sqrt(spread / out.independent);
  return out;
}

} // namespace scree
