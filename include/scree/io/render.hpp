#pragma once
/// \file
/// Pictures of spheres and triangle surfaces, drawn by the processor: the same input gives the same picture.
///
/// Each sample of the picture keeps the nearest surface with its normal, colour and object; shading, the
/// darkening of hollows and outlines follow once at the end. Spheres of one object (a clump) have one
/// outline.

#include "scree/core/error.hpp"
#include "scree/core/linear.hpp"
#include "scree/io/camera.hpp"
#include "scree/io/image.hpp"
#include "scree/io/render_cut.hpp"
#include "scree/io/render_fragments.hpp"
#include "scree/io/render_hollows.hpp"
#include "scree/io/render_line.hpp"
#include "scree/io/render_shading.hpp"
#include "scree/io/render_sphere.hpp"
#include "scree/io/render_style.hpp"
#include "scree/io/render_triangle.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace scree {

/// Collects spheres, surfaces and lines and turns them into an image.
class Renderer {
public:
  /// \param width, height of the image, pixels.
  /// \throws Error for a size, camera or style outside its range.
  Renderer(int width, int height, const Camera& camera, const RenderStyle& style = {})
      : style_{detail::checked_style(style)},
        blank_{width, height, style.background},
        picture_{camera, width * style.samples, height * style.samples} {}

  /// Pixels of the image per metre at the camera's target, for a scale bar.
  [[nodiscard]] double pixels_per_metre() const { return view().pixels_per_metre() / style_.samples; }

  /// The place in the image (pixels from the top left) where `place` (m) is seen, for labels.
  [[nodiscard]] Eigen::Vector2d pixel(const Vector& place) const {
    return view().to_pixels(view().to_view(place)).head<2>() / style_.samples;
  }

  /// Cuts all that is drawn from now on, until `uncut`.
  /// \throws Error for a plane without a direction.
  void cut(const CutPlane& plane) { cut_ = detail::kept_half(plane, view()); }
  void uncut() { cut_.reset(); }

  /// Draws a sphere (m, radius above 0). A cut sphere shows a flat face.
  void sphere(const Vector& centre, double radius, Rgb colour, std::uint32_t object) {
    const Vector c = view().to_view(centre);
    if (!(radius > 0.0) || (cut_ && cut_->distance(c) >= radius)) {
      return;
    }
    radius_sum_ += radius;
    ++sphere_count_;
    const Rgb face = blend(colour, {255, 255, 255}, style_.cut_lightness);
    detail::draw_sphere(picture_, c, radius, cut_, colour, face, object);
  }

  /// Draws triangles over shared vertices (m), seen from both sides, with lines along their sharp edges.
  /// Where a cut passes through them it shows as a line, so that a plate is seen edge-on too.
  /// \throws Error for a facet that names no vertex.
  void surface(std::span<const Vector> vertices, std::span<const std::array<std::uint32_t, 3>> facets,
               Rgb colour, std::uint32_t object) {
    std::vector<Vector> seen(vertices.size());
    std::transform(vertices.begin(), vertices.end(), seen.begin(),
                   [this](const Vector& vertex) { return view().to_view(vertex); });
    for (const auto& facet : facets) {
      if (*std::max_element(facet.begin(), facet.end()) >= vertices.size()) {
        throw Error(message("a facet names a vertex beyond the ", vertices.size(), " of its surface"));
      }
      const std::array<Vector, 3> corners{seen[facet[0]], seen[facet[1]], seen[facet[2]]};
      detail::draw_triangle(picture_, corners, cut_, colour, object);
      if (!cut_) {
        continue;
      }
      if (const auto ends = detail::cut_section(corners, *cut_)) {
        // Not cut again: it lies in the plane of the cut.
        detail::draw_line(picture_, ends->front(), ends->back(), std::nullopt,
                          style_.section_width * style_.samples, blend(colour, style_.outline, 0.25), object);
      }
    }
  }

  /// Draws a straight line (m) of `width` pixels; what is in front of it hides it.
  void line(const Vector& from, const Vector& to, Rgb colour, double width = 2.0) {
    detail::draw_line(picture_, view().to_view(from), view().to_view(to), cut_, width * style_.samples,
                      colour, line_object);
  }

  /// The picture of all that was drawn.
  [[nodiscard]] Image image() const {
    Image image = blank_;
    const auto hollows = style_.hollow_strength == 0.0
                             ? std::vector<float>(image.pixels().size())
                             : detail::Hollows{picture_, style_.samples, hollow_reach()}.smoothed();
    auto hollow = hollows.begin();
    for (int y = 0; y < image.height(); ++y) {
      for (int x = 0; x < image.width(); ++x) {
        image.at(x, y) = colour(x, y, 1.0 - style_.hollow_strength * *hollow++);
      }
    }
    return image;
  }

private:
  static constexpr std::uint32_t line_object = std::numeric_limits<std::uint32_t>::max();

  [[nodiscard]] const View& view() const { return picture_.view(); }

  [[nodiscard]] double hollow_reach() const {
    if (style_.hollow_reach > 0.0) {
      return style_.hollow_reach;
    }
    return sphere_count_ > 0 ? radius_sum_ / static_cast<double>(sphere_count_) : 20.0 / pixels_per_metre();
  }

  /// Colour of a pixel, the mean over its samples; `open` is 1 in the open and falls in a hollow.
  [[nodiscard]] Rgb colour(int x, int y, double open) const {
    const int samples = style_.samples;
    std::array<double, 3> sum{};
    for (int sub = 0; sub < samples * samples; ++sub) {
      const auto sample =
          detail::shaded(picture_, x * samples + sub % samples, y * samples + sub / samples, open, style_);
      for (std::size_t channel = 0; channel < 3; ++channel) {
        sum[channel] += sample[channel];
      }
    }
    const auto channel = [&](std::size_t i) {
      return static_cast<std::uint8_t>(std::lround(sum[i] / (samples * samples)));
    };
    return {channel(0), channel(1), channel(2)};
  }

  RenderStyle style_;
  Image blank_;
  detail::FragmentBuffer picture_;
  std::optional<detail::KeptHalf> cut_;
  double radius_sum_ = 0.0; ///< m
  std::size_t sphere_count_ = 0;
};

} // namespace scree
