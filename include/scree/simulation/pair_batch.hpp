#pragma once
/// \file
/// A few pairs at a time, sorted into those that touch and those that do not.

#include "scree/core/pack.hpp"
#include "scree/simulation/touch.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace scree {

/// Whether two listed spheres touch cannot be predicted, and a wrong guess costs as much as a third of a
/// contact. So each pair is written to the end of both lists, and one of the two grows. Columns, from which
/// packs are loaded; the last pack reads beyond the end, harmless left-overs of another batch or zeros.
template <class Real>
class PairBatch {
public:
  static constexpr std::size_t room = 128;

  /// Where a pair stands in the pair list, its spheres, and where the force on the second goes if that is in
  /// another block.
  struct Place {
    std::uint32_t pair, i, j, slot;
  };

  void add(const Place& place, const Vec3<double>& apart, double radius_i, double radius_j) {
    const double squared_distance = squared_norm(apart), reach = radius_i + radius_j;
    const double closeness = reach * reach - squared_distance;
    places_[touching_] = place;
    const std::array<double, 7> numbers{
        apart.x, apart.y, apart.z, squared_distance, closeness, reach, radius_i - radius_j};
    for (std::size_t n = 0; n < numbers.size(); ++n) {
      columns_[n][touching_] = static_cast<Real>(numbers[n]);
    }
    parted_[parted_count_] = place.pair;
    const bool touches = closeness > 0.0;
    touching_ += touches ? 1 : 0;
    parted_count_ += touches ? 0 : 1;
  }
  [[nodiscard]] bool full() const { return touching_ + parted_count_ == room; }
  void clear() { touching_ = parted_count_ = 0; }

  /// How many touch.
  [[nodiscard]] std::size_t touching() const { return touching_; }
  [[nodiscard]] const Place& place(std::size_t k) const { return places_[k]; }
  /// The geometry of those that touch, from number k on, in the lanes of T.
  template <class T>
  void read(std::size_t k, SpherePair<T>& out) const {
    const auto column = [&](std::size_t n) { return Lanes<T>::loaded(&columns_[n][k]); };
    out.apart = {column(0), column(1), column(2)};
    out.squared_distance = column(3);
    out.closeness = column(4);
    out.reach = column(5);
    out.difference = column(6);
  }
  /// The pairs that do not touch, as numbered in the pair list.
  [[nodiscard]] std::span<const std::uint32_t> parted() const { return {parted_.data(), parted_count_}; }

private:
  static constexpr std::size_t room_for_last_pack = room + Pack<Real>::width;

  std::array<std::array<Real, room_for_last_pack>, 7> columns_{};
  std::array<Place, room_for_last_pack> places_{};
  std::array<std::uint32_t, room> parted_{};
  std::size_t touching_ = 0, parted_count_ = 0;
};

} // namespace scree
