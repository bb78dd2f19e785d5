#pragma once
/// \file
/// The fixed division of the bodies into blocks that makes results independent of the number of threads.

#include "scree/state/bodies.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace scree {

/// Consecutive bodies that one task computes. Forces within a block are added directly; those on spheres of
/// other blocks are laid down in numbered slots and fetched by their owner in a fixed order. The division
/// depends on the bodies only, never on the threads.
struct Block {
  std::size_t first_body = 0, end_body = 0;
  std::size_t first_sphere = 0, end_sphere = 0;
  std::size_t first_slot = 0; ///< of the forces on spheres of other blocks, in the order of the pairs

  struct Incoming {
    std::uint32_t sphere;
    std::uint32_t slot;
  };
  std::vector<Incoming> incoming;   ///< in the order of the blocks and pairs that they come from
  std::vector<std::uint32_t> feeds; ///< later blocks with spheres that pairs of this one act on, once each
  std::size_t feeders = 0;          ///< number of earlier blocks that feed this one
};

/// Divides bodies into blocks that fit into a core's own cache with all that belongs to them: some 0.6 MB
/// each. Smaller ones have more pairs with each other, larger ones keep fewer threads busy.
template <class Real>
std::vector<Block> divided(const Bodies<Real>& bodies) {
  constexpr std::size_t wanted = 2048; // spheres; ours, 512 to 4096 were timed
  std::vector<Block> blocks;
  Block block;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    block.end_body = b + 1;
    block.end_sphere = bodies.first_sphere(b + 1);
    if (block.end_sphere - block.first_sphere >= wanted || b + 1 == bodies.size()) {
      blocks.push_back(block);
      block = {};
      block.first_body = b + 1;
      block.first_sphere = bodies.first_sphere(b + 1);
    }
  }
  return blocks;
}

/// The block that holds sphere `s`.
inline std::size_t block_of(std::span<const Block> blocks, std::size_t s) {
  const auto owner =
      std::upper_bound(blocks.begin(), blocks.end(), s,
                       [](std::size_t sphere, const Block& of) { return sphere < of.end_sphere; });
  return static_cast<std::size_t>(owner - blocks.begin());
}

} // namespace scree
