#pragma once
/// \file
/// The order of bodies in memory.

#include "scree/state/bodies.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace scree {

namespace detail {

/// Spreads the low 21 bits of v so that two zero bits stand between each.
inline std::uint64_t spread(std::uint64_t v) {
  v &= 0x1fffff;
  v = (v | v << 32U) & 0x1f00000000ffffULL;
  v = (v | v << 16U) & 0x1f0000ff0000ffULL;
  v = (v | v << 8U) & 0x100f00f00f00f00fULL;
  v = (v | v << 4U) & 0x10c30c30c30c30c3ULL;
  return (v | v << 2U) & 0x1249249249249249ULL;
}

} // namespace detail

/// The numbers of all bodies along a Morton curve over cells of the largest body, so that neighbours in space
/// are neighbours in memory; bodies of one cell in the order of their ids.
template <class Real>
std::vector<std::uint32_t> spatial_order(const Bodies<Real>& bodies) {
  std::vector<std::uint32_t> order(bodies.size());
  std::iota(order.begin(), order.end(), 0U);
  if (bodies.empty()) {
    return order;
  }
  Eigen::AlignedBox3d box;
  double widest = 0.0;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    box.extend(bodies.position(b));
    widest = std::max(widest, 2.0 * bodies.bounding_radius(b));
  }
  const double width = std::max(widest, box.sizes().maxCoeff() / 2e6);
  std::vector<std::pair<std::uint64_t, std::uint64_t>> keys(bodies.size());
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const Vector at = (bodies.position(b) - box.min()) / width;
    const auto cell = [&](int d) { return detail::spread(static_cast<std::uint64_t>(at[d])); };
    keys[b] = {cell(0) | cell(1) << 1U | cell(2) << 2U, bodies.id(b)};
  }
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return keys[a] < keys[b]; });
  return order;
}

} // namespace scree
