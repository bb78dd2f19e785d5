#pragma once
/// \file
/// A picture in memory: rows of 8-bit red, green and blue from the top left.

#include "scree/core/error.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace scree {

struct Rgb {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;

  friend constexpr bool operator==(const Rgb&, const Rgb&) = default;
};

/// The colour between `a` (share 0) and `b` (share 1); a share outside [0, 1] is brought inside.
inline Rgb blend(Rgb a, Rgb b, double share) {
  const double s = std::fmin(std::fmax(share, 0.0), 1.0);
  const auto channel = [s](std::uint8_t from, std::uint8_t to) {
    return static_cast<std::uint8_t>(std::lround(from + s * (to - from)));
  };
  return {channel(a.red, b.red), channel(a.green, b.green), channel(a.blue, b.blue)};
}

/// Dark blue over green to yellow for a share of 0 to 1, of rising lightness so that it survives grey print
/// (nine colours of the map "viridis", Smith & van der Walt 2015, and straight lines between them).
inline Rgb sequential_colour(double share) {
  constexpr std::array<Rgb, 9> stops{{{68, 1, 84},
                                      {71, 45, 123},
                                      {59, 82, 139},
                                      {44, 114, 142},
                                      {33, 145, 140},
                                      {40, 174, 128},
                                      {94, 201, 98},
                                      {173, 220, 48},
                                      {253, 231, 37}}};
  const double place = std::fmin(std::fmax(share, 0.0), 1.0) * (stops.size() - 1);
  const auto below = static_cast<std::size_t>(std::fmin(place, static_cast<double>(stops.size() - 2)));
  return blend(stops[below], stops[below + 1], place - static_cast<double>(below));
}

/// A stone colour for a body: greys and browns that tell neighbours apart and stay the same from frame to
/// frame.
inline Rgb rock_colour(std::uint32_t body) {
  constexpr std::array<Rgb, 5> stones{
      {{176, 166, 150}, {150, 138, 122}, {190, 174, 144}, {140, 140, 140}, {168, 146, 122}}};
  std::uint32_t h = body * 2654435761U; // Knuth's multiplicative hash: consecutive ids land far apart
  h ^= h >> 15U;
  return blend(stones[h % stones.size()], {255, 250, 240}, 0.04 * (h / 8U % 8U));
}

class Image {
public:
  /// \param width, height pixels, 1 to 16384.
  /// \throws Error for a size outside that range.
  Image(int width, int height, Rgb background = {255, 255, 255}) : width_{width}, height_{height} {
    require("image width", width, {1, 16384, "pixels"});
    require("image height", height, {1, 16384, "pixels"});
    pixels_.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), background);
  }

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] bool contains(int x, int y) const { return x >= 0 && x < width_ && y >= 0 && y < height_; }

  [[nodiscard]] Rgb& at(int x, int y) { return pixels_[index(x, y)]; }
  [[nodiscard]] const Rgb& at(int x, int y) const { return pixels_[index(x, y)]; }

  /// All pixels, row by row from the top.
  [[nodiscard]] std::span<const Rgb> pixels() const { return pixels_; }

private:
  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }

  int width_;
  int height_;
  std::vector<Rgb> pixels_;
};

} // namespace scree
