#pragma once
/// \file
/// The colour of a sample of a picture: light on its surface, and outlines.

#include "scree/core/linear.hpp"
#include "scree/io/render_fragments.hpp"
#include "scree/io/render_style.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

namespace scree::detail {

/// Whether a sample lies at the border of its object, or at a sharp edge of a surface.
inline bool outlined(const FragmentBuffer& picture, int x, int y) {
  const auto& here = picture.at(x, y);
  if (here.kind == FragmentKind::line) {
    return false;
  }
  const auto borders = [&](int nx, int ny) {
    if (!picture.contains(nx, ny) || picture.at(nx, ny).kind == FragmentKind::line) {
      return false;
    }
    const auto& there = picture.at(nx, ny);
    if (here.object != there.object || there.kind == FragmentKind::background) {
      return true;
    }
    if (here.kind == FragmentKind::facet && there.kind == FragmentKind::facet) {
      const float cosine = here.normal[0] * there.normal[0] + here.normal[1] * there.normal[1] +
                           here.normal[2] * there.normal[2];
      return cosine < 0.9F;
    }
    return (here.kind == FragmentKind::face) != (there.kind == FragmentKind::face);
  };
  return borders(x + 1, y) || borders(x - 1, y) || borders(x, y + 1) || borders(x, y - 1);
}

/// Colour of one sample, channels 0 to 255; `open` is 1 in the open and falls in a hollow.
inline std::array<double, 3> shaded(const FragmentBuffer& picture, int x, int y, double open,
                                    const RenderStyle& style) {
  const auto& fragment = picture.at(x, y);
  if (fragment.kind == FragmentKind::background) {
    return {1.0 * style.background.red, 1.0 * style.background.green, 1.0 * style.background.blue};
  }
  double light = 1.0;
  if (fragment.kind == FragmentKind::sphere || fragment.kind == FragmentKind::facet) {
    // From the upper left behind the camera; surfaces that look up are a little lighter.
    const Vector towards_light = Vector{-0.4, 0.57, -0.72}.normalized();
    const Vector normal{fragment.normal[0], fragment.normal[1], fragment.normal[2]};
    light = (0.42 + 0.12 * normal.y() + 0.62 * std::max(0.0, normal.dot(towards_light))) * open;
  }
  const double ink = outlined(picture, x, y) ? style.outline_strength : 0.0;
  const auto channel = [light, ink](std::uint8_t value, std::uint8_t line) {
    return (1.0 - ink) * std::min(255.0, light * value) + ink * line;
  };
  return {channel(fragment.colour.red, style.outline.red),
          channel(fragment.colour.green, style.outline.green),
          channel(fragment.colour.blue, style.outline.blue)};
}

} // namespace scree::detail
