#pragma once
/// \file
/// How a picture of a scene is drawn: colours, lines, the darkening of hollows, samples per pixel.

#include "scree/core/error.hpp"
#include "scree/io/image.hpp"

namespace scree {

/// How a picture is drawn.
struct RenderStyle {
  Rgb background{255, 255, 255};
  Rgb outline{25, 22, 20};
  double outline_strength = 0.65; ///< 0 (none) to 1
  double hollow_strength = 0.9;   ///< darkening of gaps between grains, 0 (none) to 1
  double hollow_reach = 0.0;      ///< m, how far neighbours darken; 0 for the mean radius of the spheres
  double cut_lightness = 0.25;    ///< share of white in the faces of cut spheres, 0 to 1
  double section_width = 4.5;     ///< pixels, of the line in which a cut surface shows
  int samples = 2;                ///< per pixel and direction, 1 to 4, against ragged edges
};

namespace detail {

/// The style itself. \throws Error for a field outside its range.
inline const RenderStyle& checked_style(const RenderStyle& style) {
  require("samples per pixel", style.samples, {1, 4});
  require("outline strength", style.outline_strength, {0, 1});
  require("hollow strength", style.hollow_strength, {0, 1});
  require("hollow reach", style.hollow_reach, {0, 1e9, "m"});
  require("cut lightness", style.cut_lightness, {0, 1});
  require("section width", style.section_width, {0, 100, "pixels"});
  return style;
}

} // namespace detail

} // namespace scree
