#pragma once
/// \file
/// When a block may move.

#include "scree/state/blocks.hpp"

#include <atomic>
#include <cstddef>
#include <span>
#include <vector>

namespace scree::detail {

/// A block moves as soon as the forces on it are complete: its own pairs are done, and those of the blocks
/// before it that reach into it. Its spheres are then still in the processor's cache, and nobody needs their
/// old positions any more: all pairs of two blocks are computed by the first of them.
class Gates {
public:
  /// Shuts all, for another step.
  void shut(std::span<const Block> blocks) {
    if (waiting_.size() != blocks.size()) {
      waiting_ = std::vector<std::atomic<std::size_t>>(blocks.size());
    }
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      waiting_[b].store(blocks[b].feeders + 1, std::memory_order_relaxed);
    }
  }

  /// Says that the pairs of block b are done and calls `open(block)` for those that waited for this alone.
  template <class Open>
  void done(std::size_t b, const Block& block, Open open) {
    const auto one_less = [&](std::size_t k) {
      if (waiting_[k].fetch_sub(1, std::memory_order_acq_rel) == 1) {
        open(k);
      }
    };
    one_less(b);
    for (const std::uint32_t later : block.feeds) {
      one_less(later);
    }
  }

private:
  std::vector<std::atomic<std::size_t>> waiting_;
};

} // namespace scree::detail
