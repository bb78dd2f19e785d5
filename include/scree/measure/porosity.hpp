#pragma once
/// \file
/// Porosity of a region.

#include "scree/core/error.hpp"
#include "scree/state/bodies.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace scree {

/// Share of `region` [m] that no sphere covers, by counting the points of a lattice with about `points`
/// points, which is right for overlapping spheres and for grains that the region cuts. Standard error about
/// 0.4 / sqrt(points).
template <class Real>
double porosity(const Bodies<Real>& bodies, const Eigen::AlignedBox3d& region, std::size_t points = 200'000) {
  if (region.isEmpty() || !(region.volume() > 0.0)) {
    throw Error("porosity: the region is empty");
  }
  const double pitch = std::cbrt(region.volume() / static_cast<double>(points));
  std::array<std::size_t, 3> count{};
  Vector step;
  for (std::size_t d = 0; d < 3; ++d) {
    const double size = region.sizes()[static_cast<int>(d)];
    count[d] = std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(size / pitch)));
    step[static_cast<int>(d)] = size / static_cast<double>(count[d]);
  }
  std::vector<bool> solid(count[0] * count[1] * count[2], false);
  for (const auto& sphere : bodies.spheres()) {
    const Vector at = to_eigen(sphere.position);
    if (region.squaredExteriorDistance(at) >= sphere.radius * sphere.radius) {
      continue;
    }
    // Lattice points stand in the middle of their cells.
    std::array<std::size_t, 3> low{}, high{};
    for (std::size_t d = 0; d < 3; ++d) {
      const auto k = static_cast<int>(d);
      const double first = (at[k] - sphere.radius - region.min()[k]) / step[k] - 0.5;
      const double last = (at[k] + sphere.radius - region.min()[k]) / step[k] + 0.5;
      const auto most = static_cast<double>(count[d]);
      low[d] = static_cast<std::size_t>(std::clamp(std::ceil(first), 0.0, most));
      high[d] = static_cast<std::size_t>(std::clamp(std::floor(last), 0.0, most));
    }
    for (std::size_t z = low[2]; z < high[2]; ++z) {
      for (std::size_t y = low[1]; y < high[1]; ++y) {
        for (std::size_t x = low[0]; x < high[0]; ++x) {
          const Vector place{static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)};
          const Vector point = region.min() + step.cwiseProduct(place + Vector::Constant(0.5));
          if ((point - at).squaredNorm() < sphere.radius * sphere.radius) {
            solid[(z * count[1] + y) * count[0] + x] = true;
          }
        }
      }
    }
  }
  const auto filled = static_cast<double>(std::count(solid.begin(), solid.end(), true));
  return 1.0 - filled / static_cast<double>(solid.size());
}

} // namespace scree
