#pragma once
/// \file
/// Draws straight lines of a given width into the samples of a picture.

#include "scree/core/linear.hpp"
#include "scree/io/camera.hpp"
#include "scree/io/image.hpp"
#include "scree/io/render_cut.hpp"
#include "scree/io/render_fragments.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>

namespace scree::detail {

/// Draws a line between two places in view coordinates, `width` samples wide. It is brought forward by its
/// own width so that a surface in which it lies does not hide it.
inline void draw_line(FragmentBuffer& picture, Vector from, Vector to, const std::optional<KeptHalf>& cut,
                      double width, Rgb colour, std::uint32_t object) {
  const View& view = picture.view();
  auto& nearer = from.z() < to.z() ? from : to;
  const auto& farther = from.z() < to.z() ? to : from;
  if (farther.z() < view.least_depth()) {
    return;
  }
  if (nearer.z() < view.least_depth()) {
    nearer += (view.least_depth() - nearer.z()) / (farther.z() - nearer.z()) * (farther - nearer);
  }
  const Vector a = view.to_pixels(from);
  const Vector b = view.to_pixels(to);
  const double half = 0.5 * width;
  const auto box = picture.clipped(std::min(a.x(), b.x()) - half, std::max(a.x(), b.x()) + half,
                                   std::min(a.y(), b.y()) - half, std::max(a.y(), b.y()) + half);
  if (!box) {
    return;
  }
  const Eigen::Vector2d along = (b - a).head<2>();
  const double squared_length = along.squaredNorm();
  for (int y = box->top; y < box->bottom; ++y) {
    for (int x = box->left; x < box->right; ++x) {
      const Eigen::Vector2d offset{x + 0.5 - a.x(), y + 0.5 - a.y()};
      const double share =
          squared_length > 0.0 ? std::clamp(offset.dot(along) / squared_length, 0.0, 1.0) : 0.0;
      if ((offset - share * along).squaredNorm() > half * half) {
        continue;
      }
      // Along a straight line depth is linear in the picture, with perspective its inverse is.
      const double depth = view.perspective() ? 1.0 / ((1.0 - share) / a.z() + share / b.z())
                                              : a.z() + share * (b.z() - a.z());
      const auto ray = picture.ray(x, y);
      if (!cut || cut->distance(ray.origin + depth * ray.step) <= 0.0) {
        const double forward = 2.0 * half / view.pixels_per_metre(depth);
        picture.at(x, y).place(depth - forward, -Vector::UnitZ(), colour, object, FragmentKind::line);
      }
    }
  }
}

} // namespace scree::detail
