#pragma once
/// \file
/// How far each pixel of a picture lies in a hollow between surfaces, for the darkening of gaps.

#include "scree/core/linear.hpp"
#include "scree/io/render_fragments.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace scree::detail {

/// Looks from every pixel at its surroundings in a finished buffer of fragments, which must outlive it.
class Hollows {
public:
  /// \param samples of the buffer per pixel and direction.
  /// \param reach m, how far neighbours close off a surface.
  Hollows(const FragmentBuffer& picture, int samples, double reach)
      : picture_{picture},
        samples_{samples},
        width_{picture.columns() / samples},
        height_{picture.rows() / samples},
        reach_{reach} {}

  /// How far each pixel lies in a hollow, 0 to 1, row by row. `hollow` looks into other directions at each
  /// pixel of a tile; the mean over a tile then has the smoothness of many directions at the price of a few.
  [[nodiscard]] std::vector<float> smoothed() const {
    std::vector<float> raw(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        raw[index(x, y)] = static_cast<float>(hollow(x, y));
      }
    }
    auto smooth = raw;
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        const auto& here = middle(x, y);
        float sum = 0.0F;
        float count = 0.0F;
        for (int ny = std::max(0, y - tile / 2); ny < std::min(y + tile / 2, height_); ++ny) {
          for (int nx = std::max(0, x - tile / 2); nx < std::min(x + tile / 2, width_); ++nx) {
            // Only over the same surface, so that the darkness of a gap does not leak onto the grain before
            // it.
            if (const auto& there = middle(nx, ny); there.object == here.object && there.kind == here.kind) {
              sum += raw[index(nx, ny)];
              count += 1.0F;
            }
          }
        }
        smooth[index(x, y)] = sum / count;
      }
    }
    return smooth;
  }

private:
  static constexpr int tile = 4; ///< pixels
  /// Directions, with lengths of 0.75 to 1.25, for each pixel of a tile.
  using Directions = std::array<std::array<Eigen::Vector2d, 6>, static_cast<std::size_t>(tile) * tile>;

  static Directions directions() {
    constexpr double turn = 2.0 * 3.14159265358979323846;
    Directions result;
    for (std::size_t k = 0; k < result.size(); ++k) {
      auto& star = result[k];
      // Steps of 7 and 11, which share no factor with 16, spread angles and lengths over the tile.
      const double turned = static_cast<double>(7 * k % result.size()) / static_cast<double>(result.size());
      const double length =
          0.75 + 0.5 * static_cast<double>(11 * k % result.size()) / static_cast<double>(result.size());
      for (std::size_t i = 0; i < star.size(); ++i) {
        const double angle = turn * (static_cast<double>(i) + turned) / static_cast<double>(star.size());
        star[i] = length * Eigen::Vector2d{std::cos(angle), std::sin(angle)};
      }
    }
    return result;
  }

  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }
  /// The column or row of the sample that stands for a pixel where one is enough.
  [[nodiscard]] int middle(int pixel) const { return pixel * samples_ + samples_ / 2; }
  [[nodiscard]] const Fragment& middle(int pixel_x, int pixel_y) const {
    return picture_.at(middle(pixel_x), middle(pixel_y));
  }

  /// How much neighbours close off the surface seen at a pixel, 0 to 1: the mean rise of the surroundings
  /// above its tangent plane (after the horizon-based ambient occlusion of Bavoil, Sainz & Dimitrov 2008).
  [[nodiscard]] double hollow(int pixel_x, int pixel_y) const {
    const auto& here = middle(pixel_x, pixel_y);
    if (here.kind != FragmentKind::sphere && here.kind != FragmentKind::facet) {
      return 0.0;
    }
    const int x = middle(pixel_x);
    const int y = middle(pixel_y);
    const Vector place = picture_.seen(x, y);
    const Vector normal{here.normal[0], here.normal[1], here.normal[2]};
    const double pixels = reach_ * picture_.view().pixels_per_metre(place.z());
    double closed = 0.0;
    const int of_tile = tile * (pixel_y % tile) + pixel_x % tile;
    for (const auto& direction : directions_[static_cast<std::size_t>(of_tile)]) {
      double most = 0.0;
      for (const double radius : {0.3, 0.7, 1.3}) {
        const double sx = x + std::round(radius * pixels * direction.x());
        const double sy = y + std::round(radius * pixels * direction.y());
        if (!(sx >= 0.0 && sx < picture_.columns() && sy >= 0.0 && sy < picture_.rows())) {
          continue;
        }
        const auto& there = picture_.at(static_cast<int>(sx), static_cast<int>(sy));
        if (there.kind == FragmentKind::background || there.kind == FragmentKind::line) {
          continue;
        }
        const Vector rise = picture_.seen(static_cast<int>(sx), static_cast<int>(sy)) - place;
        const double distance = rise.norm();
        if (distance > 0.0) {
          // What is far in front belongs to another layer: it hides, but does not close off.
          const double fade = std::clamp(2.0 - distance / (1.5 * reach_), 0.0, 1.0);
          most = std::max(most, fade * (rise.dot(normal) / distance - 0.1));
        }
      }
      closed += most;
    }
    return std::min(1.0, closed / static_cast<double>(directions_.front().size()));
  }

  const FragmentBuffer& picture_;
  int samples_;
  int width_;  ///< pixels
  int height_; ///< pixels
  double reach_;
  Directions directions_ = directions();
};

} // namespace scree::detail
