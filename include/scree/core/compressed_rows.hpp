#pragma once
/// \file
/// Rows of unequal length in one stretch of memory.

#include "scree/core/parallel.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace scree {

/// Rows 0 .. size() - 1 of items, one behind the other.
template <class T>
class CompressedRows {
public:
  [[nodiscard]] std::size_t size() const { return start_.size() - 1; }
  /// Number of items in all rows.
  [[nodiscard]] std::size_t total() const { return items_.size(); }
  /// Number of the first item of row i; `total()` for i = size().
  [[nodiscard]] std::size_t begin_of(std::size_t i) const { return start_[i]; }
  [[nodiscard]] const T& operator[](std::size_t item) const { return items_[item]; }
  [[nodiscard]] std::span<const T> row(std::size_t i) const {
    return {items_.data() + start_[i], start_[i + 1] - start_[i]};
  }

  /// Makes `count` new rows in parallel: `fill(i, row)` appends the items of row i to the vector `row`, which
  /// may hold those of other rows before it.
  template <class Fill>
  void build(std::size_t count, Workers& workers, Fill fill) {
    const std::size_t chunks = (count + chunk - 1) / chunk;
    std::vector<std::vector<T>> parts(chunks);
    start_.assign(count + 1, 0);
    workers.for_each(chunks, [&](std::size_t c) {
      auto& part = parts[c];
      for (std::size_t i = c * chunk; i < std::min(count, (c + 1) * chunk); ++i) {
        const std::size_t before = part.size();
        fill(i, part);
        start_[i + 1] = part.size() - before;
      }
    });
    for (std::size_t i = 0; i < count; ++i) {
      start_[i + 1] += start_[i];
    }
    items_.resize(start_[count]);
    workers.for_each(chunks, [&](std::size_t c) {
      std::copy(parts[c].begin(), parts[c].end(),
                items_.begin() + static_cast<std::ptrdiff_t>(start_[c * chunk]));
      parts[c] = {};
    });
  }

  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {
    archive(self.start_, self.items_);
    if constexpr (Archive::reading) {
      if (self.start_.empty() || self.start_.front() != 0 || self.start_.back() != self.items_.size() ||
          !std::is_sorted(self.start_.begin(), self.start_.end())) {
        archive.fail("rows do not fit their items");
      }
    }
  }

private:
  static constexpr std::size_t chunk = 512;

  std::vector<std::size_t> start_{0};
  std::vector<T> items_;
};

} // namespace scree
