#pragma once
/// \file
/// A grid of cells as wide as the longest reach of a contact.

#include "scree/core/error.hpp"
#include "scree/neighbours/concept.hpp"

#include <array>
#include <cmath>

namespace scree {

/// Sorts the balls into cells of the largest diameter plus the margin and looks at the 27 cells around each.
/// Cells are widened where a few balls are spread over a large space, so that memory stays in proportion to
/// the balls.
class CellGrid {
public:
  [[nodiscard]] static double skin(double) { return 0.0; }

  void find(std::span<const Ball> balls, std::size_t owned, double margin, Workers& workers,
            CandidateRows& rows) {
    fill(balls, margin);
    rows.build(owned, workers, [&](std::size_t i, std::vector<std::uint32_t>& row) {
      const auto at = cell(balls[i].centre);
      std::array<std::size_t, 3> low{}, high{};
      for (std::size_t d = 0; d < 3; ++d) {
        low[d] = at[d] > 0 ? at[d] - 1 : 0;
        high[d] = at[d] + 1 < cells_[d] ? at[d] + 1 : at[d];
      }
      for (std::size_t z = low[2]; z <= high[2]; ++z) {
        for (std::size_t y = low[1]; y <= high[1]; ++y) {
          // The cells of a row in x are neighbours in memory, so three of them are one stretch.
          const std::size_t line = (z * cells_[1] + y) * cells_[0];
          const std::size_t begin = start_[line + low[0]], end = start_[line + high[0] + 1];
          for (std::size_t m = begin; m < end; ++m) {
            const std::uint32_t k = members_[m];
            if (k > i && within(balls[i], balls[k], margin)) {
              row.push_back(k);
            }
          }
        }
      }
    });
  }

private:
  void fill(std::span<const Ball> balls, double margin) {
    if (balls.empty()) {
      return;
    }
    Vec3<double> high = low_ = balls.front().centre;
    double widest = 0.0;
    for (const Ball& ball : balls) {
      const Vec3<double>& c = ball.centre;
      low_ = {std::min(low_.x, c.x), std::min(low_.y, c.y), std::min(low_.z, c.z)};
      high = {std::max(high.x, c.x), std::max(high.y, c.y), std::max(high.z, c.z)};
      widest = std::max(widest, ball.radius);
    }
    const Vec3<double> size = high - low_;
    // A hair wider than the reach, so that rounding cannot put two neighbours two cells apart.
    double width = (2.0 * widest + margin) * (1.0 + 1e-9);
    const double most_cells = 8.0 * static_cast<double>(balls.size()) + 64.0;
    const auto count = [&](double extent) { return std::floor(extent / width) + 1.0; };
    while (count(size.x) * count(size.y) * count(size.z) > most_cells) {
      width *= 1.25;
    }
    inverse_width_ = 1.0 / width;
    cells_ = {static_cast<std::size_t>(count(size.x)), static_cast<std::size_t>(count(size.y)),
              static_cast<std::size_t>(count(size.z))};

    // Counting sort.
    start_.assign(cells_[0] * cells_[1] * cells_[2] + 1, 0);
    cell_of_.resize(balls.size());
    for (std::size_t i = 0; i < balls.size(); ++i) {
      const auto at = cell(balls[i].centre);
      cell_of_[i] = static_cast<std::uint32_t>((at[2] * cells_[1] + at[1]) * cells_[0] + at[0]);
      ++start_[cell_of_[i] + 1];
    }
    for (std::size_t c = 1; c < start_.size(); ++c) {
      start_[c] += start_[c - 1];
    }
    members_.resize(balls.size());
    next_.assign(start_.begin(), start_.end() - 1);
    for (std::size_t i = 0; i < balls.size(); ++i) {
      members_[next_[cell_of_[i]]++] = static_cast<std::uint32_t>(i);
    }
  }

  [[nodiscard]] std::array<std::size_t, 3> cell(const Vec3<double>& p) const {
    const auto along = [this](double offset, std::size_t cells) {
      return std::min(static_cast<std::size_t>(offset * inverse_width_), cells - 1);
    };
    return {along(p.x - low_.x, cells_[0]), along(p.y - low_.y, cells_[1]), along(p.z - low_.z, cells_[2])};
  }

  Vec3<double> low_;
  double inverse_width_ = 0.0;
  std::array<std::size_t, 3> cells_{};
  std::vector<std::size_t> start_, next_;
  std::vector<std::uint32_t> members_, cell_of_;
};

} // namespace scree
