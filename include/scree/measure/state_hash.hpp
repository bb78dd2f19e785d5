#pragma once
/// \file
/// A number that tells two states apart to the bit.

#include "scree/state/bodies.hpp"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace scree {

/// FNV-1a over id, position, velocity and spin of all bodies in the order of their ids: equal for equal bits,
/// whatever the order in memory.
template <class Real>
std::uint64_t state_hash(const Bodies<Real>& bodies) {
  std::vector<std::size_t> order(bodies.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return bodies.id(a) < bodies.id(b); });
  std::uint64_t hash = 14695981039346656037ULL;
  const auto add = [&hash](std::uint64_t bits) {
    for (int byte = 0; byte < 8; ++byte) {
      hash = (hash ^ (bits >> (8 * byte) & 0xffU)) * 1099511628211ULL;
    }
  };
  for (const std::size_t b : order) {
    add(bodies.id(b));
    for (const Vector& v : {bodies.position(b), bodies.velocity(b), bodies.angular_velocity(b)}) {
      for (int d = 0; d < 3; ++d) {
        add(std::bit_cast<std::uint64_t>(v[d]));
      }
    }
  }
  return hash;
}

} // namespace scree
