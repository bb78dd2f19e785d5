#pragma once
/// \file
/// Which pairs are held, as both of their bodies rest.

#include "scree/core/parallel.hpp"
#include "scree/state/blocks.hpp"
#include "scree/state/pair_list.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace scree {

/// What the loops over lists ask of bodies that may rest, close together in memory.
class HeldPairs {
public:
  /// Says that the blocks or the pairs are others than before.
  void forget() { reach_.clear(); }

  /// Looks at what rests now. Fixed bodies hold nothing by themselves: where no free one rests, no pair is
  /// held.
  template <class Real, int history_size>
  void note(const Bodies<Real>& bodies, std::span<const Block> blocks,
            const PairList<Real, history_size>& pairs, Workers& workers) {
    any_ = false;
    for (std::size_t b = 0; b < bodies.size() && !any_; ++b) {
      any_ = bodies.activity(b) > Activity::fresh && !bodies.is_fixed(b);
    }
    if (!any_) {
      return;
    }
    const bool others = reach_.size() != blocks.size();
    reach_.resize(blocks.size());
    settled_.assign(blocks.size(), 1);
    activities_.resize(bodies.sphere_count());
    workers.for_each(blocks.size(), [&](std::size_t b) {
      for (std::size_t s = blocks[b].first_sphere; s < blocks[b].end_sphere; ++s) {
        activities_[s] = bodies.activity(bodies.body_of(s));
        settled_[b] = settled_[b] != 0 && activities_[s] == Activity::resting ? 1 : 0;
      }
      if (others) {
        reach_[b] = blocks_reached(blocks, blocks[b], pairs);
      }
    });
  }

  /// Whether a free body rests, or did so until now.
  [[nodiscard]] bool any() const { return any_; }
  [[nodiscard]] bool rests(std::size_t sphere) const { return any_ && at_rest(activities_[sphere]); }
  /// Whether both spheres of a pair rest, so that its force stays what it is.
  [[nodiscard]] bool held(std::size_t i, std::size_t j) const {
    return at_rest(activities_[i]) && at_rest(activities_[j]);
  }
  /// Whether they rested before some bodies went to rest or woke.
  [[nodiscard]] bool was_held(std::size_t i, std::size_t j) const {
    return was_at_rest(activities_[i]) && was_at_rest(activities_[j]);
  }
  /// Whether all pairs of a block are held, and were so before.
  [[nodiscard]] bool all_held(std::size_t b) const {
    return any_ && settled_[b] != 0 &&
           std::all_of(reach_[b].begin(), reach_[b].end(),
                       [this](std::uint32_t k) { return settled_[k] != 0; });
  }

private:
  /// The blocks that hold the second spheres of a block's pairs.
  template <class Pairs>
  static std::vector<std::uint32_t> blocks_reached(std::span<const Block> blocks, const Block& from,
                                                   const Pairs& pairs) {
    std::vector<std::uint32_t> reached;
    for (std::size_t pair = pairs.begin_of(from.first_sphere); pair < pairs.begin_of(from.end_sphere);
         ++pair) {
      const std::uint32_t sphere = pairs.partner(pair).sphere;
      const bool known = std::any_of(reached.rbegin(), reached.rend(), [&](std::uint32_t k) {
        return sphere >= blocks[k].first_sphere && sphere < blocks[k].end_sphere;
      });
      if (!known) {
        reached.push_back(static_cast<std::uint32_t>(block_of(blocks, sphere)));
      }
    }
    return reached;
  }

  bool any_ = false;
  std::vector<Activity> activities_;              // of each sphere's body
  std::vector<std::uint8_t> settled_;             // for each block, whether all of it has been at rest
  std::vector<std::vector<std::uint32_t>> reach_; // for each block
};

} // namespace scree
