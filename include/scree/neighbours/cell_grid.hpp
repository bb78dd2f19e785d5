#pragma once
/// \file
/// A grid of cells as wide as the longest reach of a contact.

#include "scree/core/error.hpp"
#include "scree/core/pack.hpp"
#include "scree/neighbours/concept.hpp"

#include <array>
#include <bit>
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
          append_within(i, balls[i], margin, start_[line + low[0]], start_[line + high[0] + 1], row);
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
    // The last pack reads beyond the end.
    for (std::vector<double>* values : {&x_, &y_, &z_, &radius_, &number_}) {
      values->resize(balls.size() + Pack<double>::width);
    }
    next_.assign(start_.begin(), start_.end() - 1);
    for (std::size_t i = 0; i < balls.size(); ++i) {
      const std::size_t place = next_[cell_of_[i]]++;
      members_[place] = static_cast<std::uint32_t>(i);
      x_[place] = balls[i].centre.x;
      y_[place] = balls[i].centre.y;
      z_[place] = balls[i].centre.z;
      radius_[place] = balls[i].radius;
      number_[place] = static_cast<double>(i);
    }
  }

  /// Appends those of the members `begin` to `end` with a number above i that are within the margin.
  void append_within(std::size_t i, const Ball& ball, double margin, std::size_t begin, std::size_t end,
                     std::vector<std::uint32_t>& row) const {
    using T = Pack<double>;
    const T x{ball.centre.x}, y{ball.centre.y}, z{ball.centre.z}, radius{ball.radius}, gap{margin}, own{i};
    for (std::size_t m = begin; m < end; m += T::width) {
      const Vec3<T> apart{T::loaded(&x_[m]) - x, T::loaded(&y_[m]) - y, T::loaded(&z_[m]) - z};
      const T reach = radius + T::loaded(&radius_[m]) + gap;
      std::uint32_t near =
          (T::loaded(&number_[m]) > own).bits() & ~(squared_norm(apart) > reach * reach).bits();
      if (end - m < T::width) {
        near &= (1U << (end - m)) - 1U;
      }
      for (; near != 0; near &= near - 1U) {
        row.push_back(members_[m + static_cast<std::size_t>(std::countr_zero(near))]);
      }
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
  std::vector<double> x_, y_, z_, radius_, number_; // m, of the members, in their order; what they are
};

} // namespace scree
