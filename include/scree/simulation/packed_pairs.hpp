#pragma once
/// \file
/// The pairs that are computed in each step, in packs.

#include "scree/contact/concept.hpp"
#include "scree/simulation/domain.hpp"
#include "scree/simulation/held_pairs.hpp"
#include "scree/simulation/pair_loop.hpp"
#include "scree/simulation/wall_contacts.hpp"
#include "scree/state/blocks.hpp"
#include "scree/state/contact_packs.hpp"
#include "scree/state/pair_list.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace scree {

/// Those pairs of a list that touch or may soon, each in the block of its first sphere. Their histories are
/// here as long as they are.
/// \tparam rests whether bodies may rest (simulation/resting.hpp): pairs of two that do are in no pack
template <class Real, ContactLaw Law, bool rests>
class PackedPairs {
public:
  static constexpr int history_size = Law::history_size;
  using Pairs = PairList<Real, history_size>;
  using OneWallBlock = WallBlock<Real, history_size>;
  using Packs = ContactPacks<Real, history_size, Lanes<KernelNumber<Law, Real>>::width>;
  /// The pairs whose first sphere is in a block.
  struct BlockPairs {
    Packs within;   ///< the second is in the block too
    Packs crossing; ///< it is in another one
    Packs wrapped;  ///< its periodic image is meant

    /// A pair of spheres that is held from now on, or no longer.
    struct Changed {
      std::size_t i;
      Partner j;
      std::size_t number; ///< in the list of pairs
    };
    std::vector<Changed> changed;
    std::vector<std::uint32_t> touched; ///< spheres on which the force can change
    bool begun = false;                 ///< the forces on all others are what is held

    [[nodiscard]] std::array<const Packs*, 3> all() const { return {&within, &crossing, &wrapped}; }
  };

  [[nodiscard]] BlockPairs& block_pairs(std::size_t b) { return block_pairs_[b]; }
  [[nodiscard]] std::span<const BlockPairs> block_pairs() const { return block_pairs_; }
  /// Where the forces on the second spheres of crossing and wrapped pairs are laid down; those of one block.
  [[nodiscard]] std::span<ForceRecord<Real>> slots(std::size_t b, const Block& block) {
    return std::span{slots_}.subspan(block.first_slot, slot_count(block_pairs_[b]));
  }
  [[nodiscard]] std::span<const ForceRecord<Real>> slots() const { return slots_; }

  /// Drops all pairs and their histories.
  void clear() {
    held_.forget();
    block_pairs_.clear();
  }
  /// Begins anew with as many blocks, all empty.
  void divide(std::size_t blocks) {
    clear();
    block_pairs_.resize(blocks);
  }

  /// Deals out the pairs of a list anew. What histories there are must have been laid down before, and where
  /// the blocks or the list are others, `divide` comes first.
  /// \param skin [m] gap up to which a pair is in a pack
  /// \param wall_blocks with their candidates
  /// \param blocks in which is noted what they lay down for each other
  void renew(double skin, const Domain& domain, const Bodies<Real>& bodies, const Pairs& pairs,
             std::span<const OneWallBlock> wall_blocks, std::span<Block> blocks, Workers& workers) {
    if constexpr (rests) {
      held_.note(bodies, blocks, pairs, workers);
    }
    workers.for_each(blocks.size(), [&](std::size_t b) { renew(b, skin, domain, bodies, pairs, blocks[b]); });
    std::size_t slots = 0;
    for (Block& block : blocks) {
      block.incoming.clear();
      block.feeds.clear();
      block.feeders = 0;
    }
    constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
    std::vector<std::size_t> fed_by(blocks.size(), none);
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      blocks[b].first_slot = slots;
      for (const Packs* packs : {&block_pairs_[b].crossing, &block_pairs_[b].wrapped}) {
        for (std::size_t k = 0; k < packs->size(); ++k) {
          const std::uint32_t j = packs->pair(k).j;
          const std::size_t owner = block_of(blocks, j);
          blocks[owner].incoming.push_back({j, static_cast<std::uint32_t>(slots + k)});
          if (owner != b && fed_by[owner] != b) {
            fed_by[owner] = b;
            blocks[b].feeds.push_back(static_cast<std::uint32_t>(owner));
            ++blocks[owner].feeders;
          }
        }
        slots += packs->pack_count() * Packs::lanes;
      }
    }
    slots_.resize(slots);
    if (held_.any()) {
      workers.for_each(blocks.size(), [&](std::size_t b) { find_touched(b, blocks[b], wall_blocks[b]); });
    }
  }

  /// Calls `visit(number of the pair in its list, history)` for all.
  template <class Visit>
  void for_each_history(Visit visit) const {
    for (const BlockPairs& block : block_pairs_) {
      for_each_history(block, visit);
    }
  }
  /// Brings the histories of the packs to the list that they come from.
  void lay_down(Pairs& pairs, Workers& workers) const {
    workers.for_each(block_pairs_.size(), [&](std::size_t b) {
      for_each_history(block_pairs_[b],
                       [&pairs](std::uint32_t pair, const auto& history) { pairs.history(pair) = history; });
    });
  }

private:
  template <class Visit>
  static void for_each_history(const BlockPairs& block, Visit visit) {
    for (const Packs* packs : block.all()) {
      for (std::size_t k = 0; k < packs->size(); ++k) {
        visit(packs->pair(k).number, packs->history(k));
      }
    }
  }

  static std::size_t slot_count(const BlockPairs& pairs) {
    return (pairs.crossing.pack_count() + pairs.wrapped.pack_count()) * Packs::lanes;
  }

  void renew(std::size_t b, double skin, const Domain& domain, const Bodies<Real>& bodies, const Pairs& pairs,
             const Block& block) {
    const auto spheres = bodies.spheres();
    BlockPairs& out = block_pairs_[b];
    out.within.clear();
    out.crossing.clear();
    out.wrapped.clear();
    out.changed.clear();
    if (held_.all_held(b)) {
      return;
    }
    for (std::size_t i = block.first_sphere; i < block.end_sphere; ++i) {
      const SphereRecord<Real>& own = spheres[i];
      for (std::size_t pair = pairs.begin_of(i); pair < pairs.begin_of(i + 1); ++pair) {
        const Partner partner = pairs.partner(pair);
        bool held = false;
        if constexpr (rests) {
          if (held_.any()) {
            held = held_.held(i, partner.sphere);
            if (held != held_.was_held(i, partner.sphere)) {
              out.changed.push_back({i, partner, pair});
            }
          }
        }
        if (held) {
          continue;
        }
        const SphereRecord<Real>& other = spheres[partner.sphere];
        const double reach = own.radius + other.radius + skin;
        const Vec3<double> apart = own.position - other.position - domain.shift(partner.image);
        if (squared_norm(apart) <= reach * reach) {
          Packs& packs = partner.image != Partner::here      ? out.wrapped
                         : partner.sphere < block.end_sphere ? out.within
                                                             : out.crossing;
          packs.add(i, partner, pair);
        }
      }
    }
    const auto history = [&pairs](std::uint32_t pair) -> const auto& {
      return pairs.history(pair);
    };
    out.within.finish(spheres, history);
    out.crossing.finish(spheres, history);
    out.wrapped.finish(spheres, history);
  }

  /// Lists the spheres of a block on which the force can change.
  void find_touched(std::size_t b, const Block& block, const OneWallBlock& walls) {
    BlockPairs& pairs = block_pairs_[b];
    pairs.touched.clear();
    pairs.begun = false;
    const std::size_t first = block.first_sphere;
    std::vector<std::uint8_t> touched(block.end_sphere - first);
    for (std::size_t s = first; s < block.end_sphere; ++s) {
      touched[s - first] = held_.rests(s) ? 0 : 1;
    }
    for (const Packs* packs : pairs.all()) {
      for (std::size_t k = 0; k < packs->size(); ++k) {
        touched[packs->pair(k).i - first] = 1;
      }
    }
    for (std::size_t k = 0; k < pairs.within.size(); ++k) {
      touched[pairs.within.pair(k).j - first] = 1;
    }
    for (const Block::Incoming& in : block.incoming) {
      touched[in.sphere - first] = 1;
    }
    for (const WallCandidate& candidate : walls.candidates) {
      touched[candidate.sphere - first] = 1;
    }
    for (std::size_t k = 0; k < touched.size(); ++k) {
      if (touched[k] != 0) {
        pairs.touched.push_back(static_cast<std::uint32_t>(first + k));
      }
    }
  }

  std::vector<BlockPairs> block_pairs_;
  std::vector<ForceRecord<Real>> slots_;
  HeldPairs held_;
};

} // namespace scree
