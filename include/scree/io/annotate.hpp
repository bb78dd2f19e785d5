#pragma once
/// \file
/// Writing on a picture: text, a scale bar and a colour bar.
///
/// Letters are drawn on a grid of 5 x 7 points. Neighbouring points are joined by strokes of even width,
/// which gives smooth letters of any size out of a table of one short word per letter.

#include "scree/core/error.hpp"
#include "scree/io/image.hpp"
#include "scree/io/number_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>

namespace scree {

namespace detail {

/// Seven rows of each letter from ' ' to '~', then the degree sign and a box for everything else. A row is a
/// digit to base 32 (0-9, A-V), its highest bit the left-most point. Letters of `descending` are shown two
/// rows lower.
inline constexpr std::string_view glyphs =
    "00000004444404AA00000AAVAVAA4FKE5U4OP248J3CIK8LID44000002488842842224804LEL40044V4400000048"
    "000V0000000004122488GEHHHHHE4C4444EEH1248VEH161HE26AIV22VGU11HE68GUHHEV124444EHHEHHEEHHF12C"
    "00400400040048248G84200V0V008421248EH12404EHNLNGE4AHHVHHUHHUHHUEHGGGHEUHHHHHUVGGUGGVVGGUGGG"
    "EHGJHHEHHHVHHHE44444E72222ICHIKOKIHGGGGGGVHRLHHHHHPPLJJHEHHHHHEUHHUGGGEHHHLIDUHHUKIHEHGE1HE"
    "V444444HHHHHHEHHHHAA4HHHHLRHHHA4AHHHHA4444V1248GVE88888EG884221E22222E4AH0000000000V8400000"
    "00E1FHFGGUHHHU00EGGGE11FHHHF00EHVGE68U8888FHHHF1EGGUHHHH4044444202222CGGIKOKIC44444E00ULLLL"
    "00UHHHH00EHHHEUHHHUGGFHHHF1100MOGGG00FGE1U88U888600HHHHF00HHHA400HLLLA00HA4AHHHHHF1E00V248V"
    "34484434444444O44244O008L200CIIC000VHHHHHV";
inline constexpr std::string_view descending = "gpqy";

/// The points of a letter.
class Glyph {
public:
  /// \param index place in `glyphs`.
  explicit Glyph(std::size_t index) {
    for (std::size_t row = 0; row < 7; ++row) {
      const char digit = glyphs[7 * index + row];
      rows_[row] = static_cast<unsigned>(digit <= '9' ? digit - '0' : digit - 'A' + 10);
    }
  }
  [[nodiscard]] bool on(int column, int row) const {
    return column >= 0 && column < 5 && row >= 0 && row < 7 &&
           (rows_[static_cast<std::size_t>(row)] >> static_cast<unsigned>(4 - column) & 1U) != 0U;
  }

private:
  std::array<unsigned, 7> rows_{};
};

/// The place in `glyphs` of the letter that begins at `place`, which moves past it (UTF-8).
inline std::size_t next_glyph(std::string_view text, std::size_t& place) {
  const auto first = static_cast<unsigned char>(text[place++]);
  if (first >= 32 && first < 127) {
    return first - 32U;
  }
  const bool degree = first == 0xC2 && place < text.size() && static_cast<unsigned char>(text[place]) == 0xB0;
  while (place < text.size() && (static_cast<unsigned char>(text[place]) & 0xC0U) == 0x80U) {
    ++place;
  }
  return degree ? 95 : 96;
}

/// Draws a stroke with round ends and soft edges.
inline void draw_stroke(Image& image, double x0, double y0, double x1, double y1, double width, Rgb colour) {
  const double reach = 0.5 * width + 1.0;
  const double dx = x1 - x0;
  const double dy = y1 - y0;
  const double squared_length = dx * dx + dy * dy;
  const auto first = [reach](double a, double b) {
    return static_cast<int>(std::max(0.0, std::floor(std::min(a, b) - reach)));
  };
  const auto last = [reach](double a, double b, int size) {
    return static_cast<int>(std::min(size - 1.0, std::ceil(std::max(a, b) + reach)));
  };
  for (int y = first(y0, y1); y <= last(y0, y1, image.height()); ++y) {
    for (int x = first(x0, x1); x <= last(x0, x1, image.width()); ++x) {
      const double px = x + 0.5 - x0;
      const double py = y + 0.5 - y0;
      const double along =
          squared_length > 0.0 ? std::clamp((px * dx + py * dy) / squared_length, 0.0, 1.0) : 0.0;
      const double cover = 0.5 * width + 0.5 - std::hypot(px - along * dx, py - along * dy);
      if (cover > 0.0) {
        auto& pixel = image.at(x, y);
        pixel = blend(pixel, colour, cover);
      }
    }
  }
}

/// Draws a letter with its upper left point at (left, top) and its points `pitch` pixels apart.
inline void draw_glyph(Image& image, double left, double top, double pitch, const Glyph& glyph, Rgb colour) {
  const auto stroke = [&](int c0, int r0, int c1, int r1) {
    draw_stroke(image, left + c0 * pitch, top + r0 * pitch, left + c1 * pitch, top + r1 * pitch, 0.9 * pitch,
                colour);
  };
  for (int row = 0; row < 7; ++row) {
    for (int column = 0; column < 5; ++column) {
      if (!glyph.on(column, row)) {
        continue;
      }
      const bool right = glyph.on(column + 1, row);
      const bool below = glyph.on(column, row + 1);
      stroke(column, row, column, row); // a dot, where no stroke begins
      if (right) {
        stroke(column, row, column + 1, row);
      }
      if (below) {
        stroke(column, row, column, row + 1);
      }
      // A diagonal only where no third point joins the two, or every corner would be filled in.
      if (!right && !below && glyph.on(column + 1, row + 1)) {
        stroke(column, row, column + 1, row + 1);
      }
      if (!glyph.on(column - 1, row) && !below && glyph.on(column - 1, row + 1)) {
        stroke(column, row, column - 1, row + 1);
      }
    }
  }
}

/// The largest of 1, 2 and 5 times a power of ten that is at most `most`, which is above 0.
inline double round_length(double most) {
  const double decade = std::pow(10.0, std::floor(std::log10(most) + 1e-12));
  const double digit = most / decade * (1.0 + 1e-12);
  return decade * (digit >= 5.0 ? 5.0 : digit >= 2.0 ? 2.0 : 1.0);
}

} // namespace detail

/// How text is drawn.
struct TextStyle {
  Rgb colour{30, 30, 30};
  double height = 18.0; ///< pixels, of a capital letter; above 0, and 7 or more to be read
  double align = 0.0;   ///< share of the text left of its place: 0 starts there, 0.5 is centred, 1 ends there
};

/// The width of `text` (UTF-8) in pixels.
inline double text_width(std::string_view text, double height) {
  int letters = 0;
  for (std::size_t place = 0; place < text.size(); ++letters) {
    detail::next_glyph(text, place);
  }
  return letters == 0 ? 0.0 : (6 * letters - 2) * height / 6.0;
}

/// Writes one line of text (ASCII and the degree sign; a box stands for all else). What lies outside of the
/// image is left out.
/// \param x, y pixels: the place that `style.align` speaks of, and the top of the capital letters.
inline void draw_text(Image& image, double x, double y, std::string_view text, const TextStyle& style = {}) {
  const double pitch = style.height / 6.0; // seven rows of points are six steps high
  double left = x - style.align * text_width(text, style.height);
  for (std::size_t place = 0; place < text.size(); left += 6.0 * pitch) {
    const double drop = detail::descending.find(text[place]) == std::string_view::npos ? 0.0 : 2.0 * pitch;
    const detail::Glyph glyph{detail::next_glyph(text, place)};
    detail::draw_glyph(image, left, y + drop, pitch, glyph, style.colour);
  }
}

namespace detail {

/// Draws text centred at x, or as near to it as keeps it off the sides of the image.
inline void draw_centred(Image& image, double x, double y, std::string_view text, TextStyle style) {
  const double half = 0.5 * text_width(text, style.height) + 0.3 * style.height;
  style.align = 0.5;
  draw_text(image, std::max(half, std::min(x, image.width() - half)), y, text, style);
}

} // namespace detail

/// Draws a bar of a round length, at most 15 % of the width, at the lower left, with its length above it.
/// \param pixels_per_metre scale of the picture, above 0.
/// \throws Error for a scale that is no finite number above 0.
inline void draw_scale_bar(Image& image, double pixels_per_metre, const TextStyle& style = {}) {
  require_positive("scale of the picture", pixels_per_metre, "pixels/m");
  const double metres = detail::round_length(0.15 * image.width() / pixels_per_metre);
  const double margin = 1.2 * style.height;
  const double left = margin;
  const double right = margin + metres * pixels_per_metre;
  const double y = image.height() - margin;
  const double tick = 0.35 * style.height;
  const double thickness = std::max(1.5, 0.12 * style.height);
  for (const double x : {left, right}) {
    detail::draw_stroke(image, x, y - tick, x, y + tick, thickness, style.colour);
  }
  detail::draw_stroke(image, left, y, right, y, thickness, style.colour);
  const auto text = metres < 1.0 ? message(1e3 * metres, " mm") : message(metres, " m");
  detail::draw_centred(image, 0.5 * (left + right), y - tick - 1.4 * style.height, text, style);
}

/// Draws the colours of `sequential_colour` at the lower right, with the values at both ends and their name.
inline void draw_colour_bar(Image& image, double least, double most, std::string_view name,
                            const TextStyle& style = {}) {
  const double margin = 1.2 * style.height;
  const int length = image.width() / 6;
  const int height = std::max(3, static_cast<int>(0.6 * style.height));
  // The values stand centred below the ends, so that half of the right one lies beyond the bar.
  const double beyond = 0.5 * text_width(message(most), style.height);
  const int left = static_cast<int>(image.width() - margin - beyond) - length;
  const int top = static_cast<int>(image.height() - margin - style.height) - height - height / 2;
  for (int y = std::max(0, top); y < std::min(top + height, image.height()); ++y) {
    for (int x = std::max(0, left); x < std::min(left + length, image.width()); ++x) {
      image.at(x, y) = sequential_colour((x - left + 0.5) / length);
    }
  }
  detail::draw_centred(image, left, top + 1.6 * height, message(least), style);
  detail::draw_centred(image, left + length, top + 1.6 * height, message(most), style);
  detail::draw_centred(image, left + 0.5 * length, top - 1.5 * style.height, name, style);
}

} // namespace scree
