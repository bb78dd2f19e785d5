#pragma once
/// \file
/// The nearest surface at every sample of a picture, found by a test of depth.

#include "scree/core/linear.hpp"
#include "scree/io/camera.hpp"
#include "scree/io/image.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace scree::detail {

enum class FragmentKind : std::uint8_t { background, sphere, face, facet, line };

/// What one sample of the picture shows.
struct Fragment {
  float depth = std::numeric_limits<float>::infinity();
  std::array<float, 3> normal{};
  std::uint32_t object = 0;
  Rgb colour;
  FragmentKind kind = FragmentKind::background;

  /// Shows a surface unless a nearer one is here already.
  void place(double at_depth, const Vector& its_normal, Rgb its_colour, std::uint32_t its_object,
             FragmentKind its_kind) {
    const auto nearer = static_cast<float>(at_depth);
    if (nearer < depth) {
      const Eigen::Vector3f n = its_normal.cast<float>();
      *this = {nearer, {n.x(), n.y(), n.z()}, its_object, its_colour, its_kind};
    }
  }
};

/// The samples of a picture and the view in which they are taken.
class FragmentBuffer {
public:
  /// Samples from `left` to before `right` and from `top` to before `bottom`.
  struct Box {
    int left, right, top, bottom;
  };

  /// \param columns, rows samples across and down.
  /// \throws Error for a camera outside its range.
  FragmentBuffer(const Camera& camera, int columns, int rows)
      : columns_{columns},
        rows_{rows},
        view_{camera, columns, rows},
        fragments_(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows)) {}

  [[nodiscard]] int columns() const { return columns_; }
  [[nodiscard]] int rows() const { return rows_; }
  /// The view, whose pixels are the samples.
  [[nodiscard]] const View& view() const { return view_; }

  [[nodiscard]] bool contains(int x, int y) const { return x >= 0 && x < columns_ && y >= 0 && y < rows_; }
  [[nodiscard]] Fragment& at(int x, int y) { return fragments_[index(x, y)]; }
  [[nodiscard]] const Fragment& at(int x, int y) const { return fragments_[index(x, y)]; }

  /// The ray through the middle of a sample.
  [[nodiscard]] View::Ray ray(int x, int y) const { return view_.ray(x + 0.5, y + 0.5); }
  /// The place that a sample shows, in view coordinates.
  [[nodiscard]] Vector seen(int x, int y) const {
    const auto through = ray(x, y);
    return through.origin + static_cast<double>(at(x, y).depth) * through.step;
  }

  /// All of the picture.
  [[nodiscard]] Box whole() const { return {0, columns_, 0, rows_}; }
  /// The part of the picture between two corners, or nothing. Corners may lie far outside, or be NaN.
  [[nodiscard]] std::optional<Box> clipped(double left, double right, double top, double bottom) const {
    if (!(left < columns_ && right > 0.0 && top < rows_ && bottom > 0.0)) {
      return std::nullopt;
    }
    return Box{static_cast<int>(std::max(left, 0.0)),
               static_cast<int>(std::ceil(std::min(right, static_cast<double>(columns_)))),
               static_cast<int>(std::max(top, 0.0)),
               static_cast<int>(std::ceil(std::min(bottom, static_cast<double>(rows_))))};
  }

private:
  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(x);
  }

  int columns_;
  int rows_;
  View view_;
  std::vector<Fragment> fragments_;
};

} // namespace scree::detail
