#pragma once
/// \file
/// Draws spheres, whole or cut, into the samples of a picture.

#include "scree/core/linear.hpp"
#include "scree/io/image.hpp"
#include "scree/io/render_cut.hpp"
#include "scree/io/render_fragments.hpp"

#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

namespace scree::detail {

/// The samples that a sphere may cover; nothing for one that reaches behind the eye.
inline std::optional<FragmentBuffer::Box> sphere_box(const FragmentBuffer& picture, const Vector& c,
                                                     double radius) {
  const View& view = picture.view();
  if (!view.perspective()) {
    const Vector low = view.to_pixels(c - Vector{radius, -radius, 0.0});
    const Vector high = view.to_pixels(c + Vector{radius, -radius, 0.0});
    return picture.clipped(low.x(), high.x(), low.y(), high.y());
  }
  if (c.z() - radius < view.least_depth()) {
    return std::nullopt;
  }
  // Seen along one axis a sphere is a circle, bounded by its two tangents from the eye.
  const auto tangents = [&](double sideways) {
    const double middle = std::atan2(sideways, c.z());
    const double half = std::asin(radius / std::hypot(sideways, c.z()));
    return std::pair{std::tan(middle - half), std::tan(middle + half)};
  };
  const auto across = tangents(c.x());
  const auto upright = tangents(c.y());
  const Vector low = view.to_pixels({across.first, upright.second, 1.0});
  const Vector high = view.to_pixels({across.second, upright.first, 1.0});
  return picture.clipped(low.x(), high.x(), low.y(), high.y());
}

/// Draws a sphere about `c` (view coordinates). Where it is cut it shows a flat face of another colour.
inline void draw_sphere(FragmentBuffer& picture, const Vector& c, double radius,
                        const std::optional<KeptHalf>& cut, Rgb colour, Rgb face_colour,
                        std::uint32_t object) {
  const auto box = sphere_box(picture, c, radius);
  if (!box) {
    return;
  }
  const bool may_be_cut = cut && cut->distance(c) > -radius;
  for (int y = box->top; y < box->bottom; ++y) {
    for (int x = box->left; x < box->right; ++x) {
      const auto ray = picture.ray(x, y);
      const Vector to_centre = c - ray.origin;
      const double a = ray.step.squaredNorm();
      const double b = ray.step.dot(to_centre);
      const double discriminant = b * b - a * (to_centre.squaredNorm() - radius * radius);
      if (discriminant < 0.0) {
        continue;
      }
      const double root = std::sqrt(discriminant);
      const double depth = (b - root) / a;
      auto& fragment = picture.at(x, y);
      if (static_cast<float>(depth) >= fragment.depth) {
        continue;
      }
      const Vector hit = ray.origin + depth * ray.step;
      if (!may_be_cut || cut->distance(hit) <= 0.0) {
        fragment.place(depth, (hit - c) / radius, colour, object, FragmentKind::sphere);
      } else if (cut->distance(ray.origin + (b + root) / a * ray.step) < 0.0) {
        fragment.place(cut->crossing(ray.origin, ray.step), cut->normal, face_colour, object,
                       FragmentKind::face);
      }
    }
  }
}

} // namespace scree::detail
