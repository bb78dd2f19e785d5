#pragma once
/// \file
/// Who may touch whom: pairs, wall candidates and blocks, and when they must be found anew.

#include "scree/core/error.hpp"
#include "scree/simulation/domain.hpp"
#include "scree/simulation/packed_pairs.hpp"
#include "scree/simulation/spatial_order.hpp"
#include "scree/simulation/wall_contacts.hpp"
#include "scree/state/blocks.hpp"
#include "scree/state/pair_list.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace scree {

/// Two lists, one within the other. Pairs and wall candidates hold as long as nothing has moved further than
/// half of the search's skin. Of those pairs, each block has in packs what touches or may do so within some
/// steps, as they hold for half of a far smaller skin: most pairs of the list never touch (`PackedPairs`).
/// When what is made anew is decided here. \tparam rests whether bodies may rest (simulation/resting.hpp):
/// pairs of two that do are in no pack
template <class Real, ContactLaw Law, NeighbourSearch Search, class AnyWall, bool rests>
class ContactLists {
public:
  static constexpr int history_size = Law::history_size;
  using Pairs = PairList<Real, history_size>;
  using OneWallBlock = WallBlock<Real, history_size>;
  using Packed = PackedPairs<Real, Law, rests>;
  using BlockPairs = typename Packed::BlockPairs;

  ContactLists(Search search, std::size_t sort_interval)
      : search_{std::move(search)}, sort_interval_{sort_interval} {}

  [[nodiscard]] const Pairs& pairs() const { return pairs_; }
  /// Of all pairs, in their order.
  [[nodiscard]] std::vector<typename Pairs::History> histories() const {
    std::vector<typename Pairs::History> out = pairs_.histories();
    packed_.for_each_history([&](std::uint32_t pair, const auto& history) { out[pair] = history; });
    return out;
  }
  /// What of a block is computed in each step.
  [[nodiscard]] BlockPairs& block_pairs(std::size_t b) { return packed_.block_pairs(b); }
  [[nodiscard]] std::span<const BlockPairs> block_pairs() const { return packed_.block_pairs(); }
  /// Where the forces on the second spheres of crossing and wrapped pairs are laid down; those of one block.
  [[nodiscard]] std::span<ForceRecord<Real>> slots(std::size_t b) { return packed_.slots(b, blocks_[b]); }
  [[nodiscard]] std::span<const ForceRecord<Real>> slots() const { return packed_.slots(); }
  [[nodiscard]] std::span<const Block> blocks() const { return blocks_; }
  [[nodiscard]] std::span<const OneWallBlock> wall_blocks() const { return wall_blocks_; }
  [[nodiscard]] OneWallBlock& wall_block(std::size_t b) { return wall_blocks_[b]; }
  /// For each wall, how many spheres touch it or may soon; empty before the lists were made.
  [[nodiscard]] std::span<const std::size_t> near_walls() const { return near_walls_; }
  [[nodiscard]] std::size_t renewals() const { return renewals_; }

  /// Says that bodies, walls or what is fixed have changed.
  void invalidate() { valid_ = false; }

  /// Says how far grains and walls can have come in one step [m].
  void note_travel(double grains, double walls) {
    travel_ += grains;
    pack_travel_ += grains;
    step_travel_ = grains;
    wall_travel_ += walls;
  }

  /// Makes the lists anew where they may no longer hold. Returns whether it did.
  /// \throws Error for a body whose position is not a number or out of all bounds, with `time` [s].
  bool keep_valid(std::size_t step, double time, const Domain& domain, Bodies<Real>& bodies,
                  std::span<const AnyWall> walls, Workers& workers) {
    const bool sort = sort_due(step);
    // At fixed steps, not at renewals, so that all searches wrap, and round, alike; seldom, as lists are made
    // anew after it.
    const bool wrap_now =
        domain.periodic() && (!valid_ || step % wrap_interval == 0) && domain.strayed(bodies);
    if (valid_ && !sort && !wrap_now && !outlived(bodies)) {
      if (2.0 * pack_travel_ > pack_skin_) {
        packed_.lay_down(pairs_, workers);
        renew_packs(domain, bodies, workers);
      }
      return false;
    }
    packed_.lay_down(pairs_, workers);
    check_positions(bodies, time);
    if (wrap_now) {
      wrap(domain, bodies, walls);
    }
    if (sort) {
      rearrange(spatial_order(bodies), bodies, workers);
      sorted_at_ = step;
    }
    renew_pairs(domain, bodies, workers);
    blocks_ = divided(bodies);
    packed_.divide(blocks_.size());
    renew_wall_candidates(bodies, walls, workers);
    renew_packs(domain, bodies, workers); // asks for the candidates of walls
    listed_at_.resize(bodies.sphere_count());
    for (std::size_t s = 0; s < listed_at_.size(); ++s) {
      listed_at_[s] = bodies.spheres()[s].position;
    }
    travel_ = wall_travel_ = 0.0;
    valid_ = true;
    ++renewals_;
    return true;
  }

  /// Deals the pairs out to the packs anew, after some bodies went to rest or woke.
  void change_over(const Domain& domain, const Bodies<Real>& bodies, Workers& workers) {
    packed_.lay_down(pairs_, workers);
    renew_packs(domain, bodies, workers);
  }

  /// Puts the bodies of `order` in that order and drops the others; histories follow. The lists are no longer
  /// valid.
  void rearrange(std::span<const std::uint32_t> order, Bodies<Real>& bodies, Workers& workers) {
    packed_.lay_down(pairs_, workers);
    packed_.clear();
    const std::vector<std::uint32_t> moved_to = bodies.rearrange(order);
    pairs_.rearrange(moved_to, bodies.sphere_count(), Law::history_parity, workers);
    std::vector<WallContact<Real, history_size>> contacts;
    for (OneWallBlock& block : wall_blocks_) {
      for (auto& contact : block.contacts) {
        contact.sphere = moved_to[contact.sphere];
        if (contact.sphere != Bodies<Real>::gone) {
          contacts.push_back(contact);
        }
      }
      block.contacts.clear();
    }
    std::stable_sort(contacts.begin(), contacts.end(),
                     [](const auto& a, const auto& b) { return a.key() < b.key(); });
    if (!wall_blocks_.empty()) {
      wall_blocks_.front().contacts = std::move(contacts);
    }
    valid_ = false;
  }

  /// All but what `rebuild` makes (core/archive.hpp).
  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {
    if constexpr (Archive::reading) {
      archive(self.pairs_);
    } else {
      Pairs laid_down = self.pairs_;
      self.packed_.for_each_history(
          [&](std::uint32_t pair, const auto& history) { laid_down.history(pair) = history; });
      archive(laid_down);
    }
    archive(self.wall_blocks_, self.near_walls_, self.listed_at_, self.skin_, self.travel_, self.wall_travel_,
            self.step_travel_, self.valid_, self.sorted_at_, self.renewals_);
  }
  /// After reading, with the bodies that were there. Returns whether all belongs together.
  bool rebuild(const Domain& domain, const Bodies<Real>& bodies, std::span<const AnyWall> walls,
               Workers& workers) {
    packed_.clear();
    blocks_ = divided(bodies);
    if (!consistent(bodies, walls)) {
      return false;
    }
    if (valid_) {
      packed_.divide(blocks_.size());
      renew_packs(domain, bodies, workers);
    }
    return true;
  }

private:
  static constexpr std::size_t wrap_interval = 100; // steps between two looks; ours
  static constexpr std::size_t never = std::numeric_limits<std::size_t>::max();

  /// Whether pairs and wall contacts name only what there is.
  [[nodiscard]] bool consistent(const Bodies<Real>& bodies, std::span<const AnyWall> walls) const {
    const std::size_t spheres = bodies.sphere_count();
    const auto known = [&](const auto& item) {
      return item.sphere < spheres && item.wall < walls.size() &&
             item.surface < walls[item.wall].surfaces.size();
    };
    bool well = pairs_.row_count() <= spheres &&
                (!valid_ || (pairs_.row_count() == spheres && listed_at_.size() == spheres &&
                             wall_blocks_.size() == blocks_.size() && near_walls_.size() == walls.size()));
    for (std::size_t pair = 0; well && pair < pairs_.size(); ++pair) {
      well = pairs_.partner(pair).sphere < spheres && pairs_.partner(pair).image < 27;
    }
    for (std::size_t k = 0; well && k < wall_blocks_.size(); ++k) {
      const OneWallBlock& block = wall_blocks_[k];
      well = std::all_of(block.contacts.begin(), block.contacts.end(), known) &&
             std::all_of(block.candidates.begin(), block.candidates.end(), [&](const WallCandidate& c) {
               return known(c) && c.first_facet + std::size_t{c.facet_count} <= block.facets.size() &&
                      walls[c.wall].surfaces[c.surface].has_facets(
                          std::span{block.facets}.subspan(c.first_facet, c.facet_count));
             });
    }
    return well;
  }

  [[nodiscard]] bool sort_due(std::size_t step) const {
    return sort_interval_ > 0 && (sorted_at_ == never || (step % sort_interval_ == 0 && step != sorted_at_));
  }

  /// Brings bodies back into a periodic domain, and what is known of their wall contacts with them.
  void wrap(const Domain& domain, Bodies<Real>& bodies, std::span<const AnyWall> walls) {
    std::vector<Vector> shift(bodies.size(), Vector::Zero());
    if (!domain.wrap(bodies, [&](std::size_t b, const Vector& by) { shift[b] = by; })) {
      return;
    }
    for (OneWallBlock& block : wall_blocks_) {
      for (auto& contact : block.contacts) {
        const Vector& by = shift[bodies.body_of(contact.sphere)];
        contact.point += by;
        contact.at += walls[contact.wall].motion.orientation.conjugate() * by;
      }
    }
  }

  static void check_positions(const Bodies<Real>& bodies, double time) {
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      // Beyond this a cell number would overflow; nothing that scree is for is that large.
      if (const Vector x = bodies.position(b); !(x.cwiseAbs().maxCoeff() < 1e9)) {
        throw Trouble(message("body ", bodies.id(b), " has left the domain at t = ", time, " s: position (",
                              x.x(), ", ", x.y(), ", ", x.z(), ") m"));
      }
    }
  }

  /// Whether something may have closed the gap that the lists allow for.
  bool outlived(const Bodies<Real>& bodies) {
    const auto over = [this] { return 2.0 * travel_ > skin_ || travel_ + wall_travel_ > skin_; };
    if (skin_ == 0.0 || !over()) {
      return skin_ == 0.0;
    }
    // The sum of the largest speeds overstates how far any one sphere has come: look.
    double most2 = 0.0;
    for (std::size_t s = 0; s < listed_at_.size(); ++s) {
      most2 = std::max(most2, squared_norm(bodies.spheres()[s].position - listed_at_[s]));
    }
    travel_ = std::sqrt(most2) * 1.25; // ours: leaves a few steps before the next look
    return over();
  }

  void renew_pairs(const Domain& domain, const Bodies<Real>& bodies, Workers& workers) {
    const auto spheres = bodies.spheres();
    if (spheres.size() > Packed::Packs::most_spheres) {
      throw Error(message("bodies: ", spheres.size(), " spheres are more than the ",
                          Packed::Packs::most_spheres, " that one simulation holds"));
    }
    // None of this is kept: it would be a fifth of all memory.
    std::vector<Ball> balls(spheres.size());
    std::vector<Domain::Image> images;
    CandidateRows candidates;
    double smallest = std::numeric_limits<double>::infinity(), largest = 0.0;
    for (std::size_t s = 0; s < spheres.size(); ++s) {
      balls[s] = {spheres[s].position, spheres[s].radius};
      smallest = std::min(smallest, spheres[s].radius);
      largest = std::max(largest, spheres[s].radius);
    }
    skin_ = balls.empty() ? 0.0 : search_.skin(smallest);
    domain.add_images(balls, 2.0 * largest + skin_, images);
    search_.find(balls, spheres.size(), skin_, workers, candidates);
    pairs_.renew(spheres.size(), workers, [&](std::size_t i, std::vector<Partner>& row) {
      for (const std::uint32_t k : candidates.row(i)) {
        append_partner(bodies, images, i, k, row);
      }
    });
  }

  /// Members of one body do not touch, nor do two fixed bodies.
  static void append_partner(const Bodies<Real>& bodies, std::span<const Domain::Image> images, std::size_t i,
                             std::uint32_t k, std::vector<Partner>& row) {
    const std::size_t owned = bodies.sphere_count();
    const bool image = k >= owned;
    const std::uint32_t j = image ? images[k - owned].owner : k;
    const auto spheres = bodies.spheres();
    const bool both_fixed = !(spheres[i].inverse_mass > 0) && !(spheres[j].inverse_mass > 0);
    if (j > i && bodies.body_of(i) != bodies.body_of(j) && !both_fixed) {
      row.push_back({j & Partner::most, image ? images[k - owned].image & 31U : Partner::here});
    }
  }

  /// A larger skin brings more pairs that do not touch, a smaller one more renewals. Both cost the least
  /// together where the skin is about the root of the list's skin times twice the way of a step: a renewal
  /// looks at all pairs of the list, whose gaps are spread evenly over its skin.
  [[nodiscard]] double pack_skin() const {
    constexpr double least = 0.01; // of the list's skin, ours
    return std::min(skin_, std::max(least * skin_, std::sqrt(1.5 * step_travel_ * skin_)));
  }

  void renew_packs(const Domain& domain, const Bodies<Real>& bodies, Workers& workers) {
    pack_skin_ = pack_skin();
    pack_travel_ = 0.0;
    packed_.renew(pack_skin_, domain, bodies, pairs_, wall_blocks_, blocks_, workers);
  }

  void renew_wall_candidates(const Bodies<Real>& bodies, std::span<const AnyWall> walls, Workers& workers) {
    // The contacts of all blocks, in the order of the spheres, are dealt out to the new blocks.
    std::vector<WallContact<Real, history_size>> contacts;
    for (const OneWallBlock& block : wall_blocks_) {
      contacts.insert(contacts.end(), block.contacts.begin(), block.contacts.end());
    }
    wall_blocks_.resize(blocks_.size());
    near_walls_.assign(walls.size(), 0);
    workers.for_each(blocks_.size(), [&](std::size_t b) {
      find_wall_candidates(blocks_[b], bodies, walls, skin_, wall_blocks_[b]);
      const auto before = [](const auto& contact, std::size_t s) { return contact.sphere < s; };
      wall_blocks_[b].contacts.assign(
          std::lower_bound(contacts.begin(), contacts.end(), blocks_[b].first_sphere, before),
          std::lower_bound(contacts.begin(), contacts.end(), blocks_[b].end_sphere, before));
    });
    for (const OneWallBlock& block : wall_blocks_) {
      for (const WallCandidate& candidate : block.candidates) {
        ++near_walls_[candidate.wall];
      }
    }
  }

  Search search_;
  std::size_t sort_interval_;
  Pairs pairs_;
  std::vector<Block> blocks_;
  std::vector<OneWallBlock> wall_blocks_;
  Packed packed_;
  std::vector<std::size_t> near_walls_;
  std::vector<Vec3<double>> listed_at_;
  double skin_ = 0.0, travel_ = 0.0, wall_travel_ = 0.0;
  double pack_skin_ = 0.0, pack_travel_ = 0.0, step_travel_ = 0.0;
  bool valid_ = false;
  std::size_t sorted_at_ = never, renewals_ = 0;
};

} // namespace scree
