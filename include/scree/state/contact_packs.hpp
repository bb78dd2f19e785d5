#pragma once
/// \file
/// Pairs of spheres that touch or are about to, in packs, with the histories of their contacts.

#include "scree/state/pair_list.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace scree {

/// All that is known of the pairs of one pack beside their spheres, lanes behind each other.
template <class Real, int history_size, std::size_t width>
struct alignas(width == 1 ? sizeof(double) : 64) ContactPack {
  template <class Number>
  using Lane = std::array<Number, width>;

  Lane<std::uint32_t> sphere_i, sphere_j; ///< bytes from the first sphere record to theirs
  Lane<std::uint32_t> force_i, force_j;   ///< bytes from the first force record to theirs
  Lane<double> reach;                     ///< m, sum of the radii
  Lane<Real> root_mass;                   ///< sqrt(kg), of the reduced mass
  std::array<Lane<Real>, static_cast<std::size_t>(history_size)> history;
};

/// Some pairs of a `PairList`, in its order, of which `width` at a time are computed together. The lanes that
/// are left over in the last pack hold a sphere and itself.
template <class Real, int history_size, std::size_t width>
class ContactPacks {
public:
  static constexpr std::size_t lanes = width;
  /// How many spheres can be told apart by the bytes before their records.
  static constexpr std::size_t most_spheres = 0xffffffffU / sizeof(SphereRecord<Real>);
  static_assert(most_spheres <= Partner::most);
  using OnePack = ContactPack<Real, history_size, width>;
  using History = std::array<Real, static_cast<std::size_t>(history_size)>;
  struct Pair {
    std::uint32_t i, j;
    std::uint32_t image;  ///< of j, see Partner
    std::uint32_t number; ///< in the list of pairs
  };
  /// Of the spheres of a pack, if they are the same in all lanes.
  struct Materials {
    std::uint32_t i, j;
    bool alike;
  };

  /// Number of pairs; that of lanes is larger.
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] std::size_t pack_count() const { return packs_.size(); }
  /// Of number k, or of a lane left over.
  [[nodiscard]] const Pair& pair(std::size_t k) const { return pairs_[k]; }
  [[nodiscard]] const Materials& materials(std::size_t pack) const { return materials_[pack]; }
  [[nodiscard]] OnePack& pack(std::size_t p) { return packs_[p]; }
  [[nodiscard]] const OnePack& pack(std::size_t p) const { return packs_[p]; }
  [[nodiscard]] History history(std::size_t k) const {
    History out{};
    for (std::size_t h = 0; h < out.size(); ++h) {
      out[h] = packs_[k / width].history[h][k % width];
    }
    return out;
  }

  /// Drops all pairs and their histories.
  void clear() {
    size_ = 0;
    pairs_.clear();
    packs_.clear();
    materials_.clear();
  }
  /// Appends a pair. \param number in the list of pairs
  void add(std::size_t i, Partner j, std::size_t number) {
    pairs_.push_back({static_cast<std::uint32_t>(i), j.sphere, j.image, static_cast<std::uint32_t>(number)});
  }
  /// To be called when all are there. \param history (number): that of a pair of the list
  template <class HistoryOf>
  void finish(std::span<const SphereRecord<Real>> spheres, HistoryOf history) {
    size_ = pairs_.size();
    packs_.resize((size_ + width - 1) / width);
    materials_.resize(packs_.size());
    if (size_ > 0) {
      const std::uint32_t last = pairs_.back().i;
      pairs_.resize(packs_.size() * width, {last, last, Partner::here, 0});
    }
    for (std::size_t k = 0; k < pairs_.size(); ++k) {
      const Pair& pair = pairs_[k];
      const SphereRecord<Real>&i = spheres[pair.i], &j = spheres[pair.j];
      const std::size_t lane = k % width;
      OnePack& pack = packs_[k / width];
      pack.sphere_i[lane] = static_cast<std::uint32_t>(pair.i * sizeof i);
      pack.sphere_j[lane] = static_cast<std::uint32_t>(pair.j * sizeof j);
      pack.force_i[lane] = static_cast<std::uint32_t>(pair.i * sizeof(ForceRecord<Real>));
      pack.force_j[lane] = static_cast<std::uint32_t>(pair.j * sizeof(ForceRecord<Real>));
      pack.reach[lane] = i.radius + j.radius;
      pack.root_mass[lane] = Real{1} / std::sqrt(i.inverse_mass + j.inverse_mass);
      const History known = k < size_ ? history(pair.number) : History{};
      for (std::size_t h = 0; h < known.size(); ++h) {
        pack.history[h][lane] = known[h];
      }
      Materials& of = materials_[k / width];
      if (lane == 0) {
        of = {i.material, j.material, true};
      }
      of.alike = of.alike && (k >= size_ || (i.material == of.i && j.material == of.j));
    }
  }

private:
  std::size_t size_ = 0;
  std::vector<Pair> pairs_;
  std::vector<OnePack> packs_;
  std::vector<Materials> materials_;
};

} // namespace scree
