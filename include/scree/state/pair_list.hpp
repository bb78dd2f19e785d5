#pragma once
/// \file
/// Pairs of spheres that touch or may touch soon, with the history of those that touch.

#include "scree/core/compressed_rows.hpp"
#include "scree/state/bodies.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace scree {

/// The second sphere of a pair, and which periodic image of it is meant.
struct Partner {
  static constexpr std::uint32_t here = 13; ///< the image with no shift
  static constexpr std::uint32_t most = (1U << 27U) - 1U;

  std::uint32_t sphere : 27;
  std::uint32_t image : 5; ///< ix + 3 iy + 9 iz, each shift -1, 0, 1 stored as 0, 1, 2
};

/// Rows of partners j > i, ascending in j, each pair with the history numbers of its contact law: all 0 for a
/// pair that does not touch, as for a contact that begins.
template <class Real, int history_size>
class PairList {
public:
  using History = std::array<Real, static_cast<std::size_t>(history_size)>;

  [[nodiscard]] std::size_t size() const { return rows_.total(); }
  [[nodiscard]] std::size_t row_count() const { return rows_.size(); }
  [[nodiscard]] std::size_t begin_of(std::size_t i) const { return rows_.begin_of(i); }
  [[nodiscard]] const Partner& partner(std::size_t pair) const { return rows_[pair]; }
  [[nodiscard]] const History& history(std::size_t pair) const { return history_[pair]; }
  [[nodiscard]] History& history(std::size_t pair) { return history_[pair]; }
  [[nodiscard]] const std::vector<History>& histories() const { return history_; }

  /// Replaces the pairs: `partners(i, row)` appends the partners of sphere i, in any order. A pair that stays
  /// keeps its history.
  template <class Partners>
  void renew(std::size_t spheres, Workers& workers, Partners partners) {
    const CompressedRows<Partner> old_rows = std::exchange(rows_, {});
    const std::vector<History> old_history = std::exchange(history_, {});
    rows_.build(spheres, workers, [&](std::size_t i, std::vector<Partner>& row) {
      const auto before = static_cast<std::ptrdiff_t>(row.size());
      partners(i, row);
      std::sort(row.begin() + before, row.end(), [](Partner a, Partner b) { return a.sphere < b.sphere; });
    });
    history_.assign(rows_.total(), History{});
    constexpr std::size_t chunk = 1024;
    const std::size_t kept = std::min(spheres, old_rows.size());
    workers.for_each((kept + chunk - 1) / chunk, [&](std::size_t c) {
      for (std::size_t i = c * chunk; i < std::min(kept, (c + 1) * chunk); ++i) {
        carry_over(i, old_rows, old_history);
      }
    });
  }

  /// Follows spheres to new numbers (`Bodies::gone` for those removed). `parity` says which history numbers
  /// change sign when the spheres of a pair change places. Pairs without history are dropped: renew the list
  /// before use.
  void rearrange(std::span<const std::uint32_t> moved_to, std::size_t spheres,
                 const std::array<int, static_cast<std::size_t>(history_size)>& parity, Workers& workers) {
    struct Moved {
      std::uint32_t first;
      Partner second;
      History history;
    };
    std::vector<Moved> moved;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      for (std::size_t pair = rows_.begin_of(i); pair < rows_.begin_of(i + 1); ++pair) {
        Partner partner = rows_[pair];
        const std::uint32_t first = moved_to[i], second = moved_to[partner.sphere];
        constexpr auto gone = Bodies<Real>::gone;
        if (history_[pair] == History{} || first == gone || second == gone) {
          continue;
        }
        History history = history_[pair];
        if (first > second) {
          for (std::size_t h = 0; h < history.size(); ++h) {
            history[h] *= static_cast<Real>(parity[h]);
          }
        }
        partner.sphere = std::max(first, second) & Partner::most;
        moved.push_back({std::min(first, second), partner, history});
      }
    }
    std::sort(moved.begin(), moved.end(), [](const Moved& a, const Moved& b) {
      return a.first != b.first ? a.first < b.first : a.second.sphere < b.second.sphere;
    });
    std::vector<std::size_t> start(spheres + 1, 0);
    for (const Moved& m : moved) {
      ++start[m.first + 1];
    }
    for (std::size_t i = 0; i < spheres; ++i) {
      start[i + 1] += start[i];
    }
    rows_.build(spheres, workers, [&](std::size_t i, std::vector<Partner>& row) {
      for (std::size_t m = start[i]; m < start[i + 1]; ++m) {
        row.push_back(moved[m].second);
      }
    });
    history_.resize(moved.size());
    for (std::size_t m = 0; m < moved.size(); ++m) {
      history_[m] = moved[m].history;
    }
  }

  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {
    archive(self.rows_, self.history_);
    if constexpr (Archive::reading) {
      if (self.history_.size() != self.rows_.total()) {
        archive.fail("pairs and histories do not belong together");
      }
    }
  }

private:
  void carry_over(std::size_t i, const CompressedRows<Partner>& old_rows,
                  const std::vector<History>& old_history) {
    std::size_t old = old_rows.begin_of(i);
    const std::size_t old_end = old_rows.begin_of(i + 1);
    for (std::size_t pair = rows_.begin_of(i); pair < rows_.begin_of(i + 1); ++pair) {
      while (old < old_end && old_rows[old].sphere < rows_[pair].sphere) {
        ++old;
      }
      if (old < old_end && old_rows[old].sphere == rows_[pair].sphere) {
        history_[pair] = old_history[old];
      }
    }
  }

  CompressedRows<Partner> rows_;
  std::vector<History> history_;
};

} // namespace scree
