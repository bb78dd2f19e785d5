#pragma once
/// \file
/// Draws triangles into the samples of a picture.

#include "scree/core/linear.hpp"
#include "scree/io/camera.hpp"
#include "scree/io/image.hpp"
#include "scree/io/render_cut.hpp"
#include "scree/io/render_fragments.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace scree::detail {

/// The samples that a triangle may cover.
inline std::optional<FragmentBuffer::Box> triangle_box(const FragmentBuffer& picture,
                                                       const std::array<Vector, 3>& corners) {
  std::array<Vector, 3> pixels;
  for (std::size_t i = 0; i < 3; ++i) {
    if (corners[i].z() < picture.view().least_depth()) {
      return picture.whole(); // reaches behind the eye: rare, so simply all of the picture
    }
    pixels[i] = picture.view().to_pixels(corners[i]);
  }
  const auto across = std::minmax({pixels[0].x(), pixels[1].x(), pixels[2].x()});
  const auto down = std::minmax({pixels[0].y(), pixels[1].y(), pixels[2].y()});
  return picture.clipped(across.first, across.second, down.first, down.second);
}

/// Depth at which a ray meets a triangle (Möller & Trumbore 1997), or nothing. The slack closes the seam
/// between triangles that share an edge.
inline std::optional<double> triangle_depth(const View::Ray& ray, const Vector& corner, const Vector& edge1,
                                            const Vector& edge2) {
  constexpr double slack = 1e-9;
  const Vector p = ray.step.cross(edge2);
  const double determinant = edge1.dot(p);
  if (determinant == 0.0) {
    return std::nullopt;
  }
  const Vector s = ray.origin - corner;
  const double u = s.dot(p) / determinant;
  const Vector q = s.cross(edge1);
  const double v = ray.step.dot(q) / determinant;
  if (u < -slack || v < -slack || u + v > 1.0 + slack) {
    return std::nullopt;
  }
  return edge2.dot(q) / determinant;
}

/// Draws a triangle (view coordinates), seen from both sides.
inline void draw_triangle(FragmentBuffer& picture, const std::array<Vector, 3>& corners,
                          const std::optional<KeptHalf>& cut, Rgb colour, std::uint32_t object) {
  const Vector edge1 = corners[1] - corners[0];
  const Vector edge2 = corners[2] - corners[0];
  const Vector normal = edge1.cross(edge2).stableNormalized();
  const auto box = triangle_box(picture, corners);
  if (!(normal.squaredNorm() > 0.5) || !box) { // without area, or out of sight
    return;
  }
  for (int y = box->top; y < box->bottom; ++y) {
    for (int x = box->left; x < box->right; ++x) {
      const auto ray = picture.ray(x, y);
      const auto depth = triangle_depth(ray, corners[0], edge1, edge2);
      if (depth && *depth >= picture.view().least_depth() &&
          !(cut && cut->distance(ray.origin + *depth * ray.step) > 0.0)) {
        const double side = normal.dot(ray.step) > 0.0 ? -1.0 : 1.0;
        picture.at(x, y).place(*depth, side * normal, colour, object, FragmentKind::facet);
      }
    }
  }
}

} // namespace scree::detail
