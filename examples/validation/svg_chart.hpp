#pragma once
/// \file
/// A chart as inline SVG: reference points over simulated lines.

#include "finding.hpp"

#include "scree/io/xml_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace validation {

namespace detail {

/// One axis: its ends, and marks at round numbers between them.
struct Axis {
  double low = 0.0, high = 1.0;
  std::vector<double> marks;

  Axis(double least, double most) : low{least}, high{most} {
    const double span = high > low ? high - low : std::max(1e-300, std::abs(high));
    const double power = std::pow(10.0, std::floor(std::log10(span / 4.0)));
    const double over = span / 4.0 / power;
    const double step = power * (over < 1.5 ? 1.0 : over < 3.5 ? 2.0 : over < 7.5 ? 5.0 : 10.0);
    low = std::floor(low / step + 1e-9) * step;
    high = std::max(low + step, std::ceil(high / step - 1e-9) * step);
    for (double at = low; at <= high + 0.5 * step; at += step) {
      marks.push_back(std::abs(at) < 1e-9 * step ? 0.0 : at);
    }
  }
  [[nodiscard]] double share(double value) const { return (value - low) / (high - low); }
};

} // namespace detail

/// The chart as an <svg> element of 520 by 340 pixels.
inline std::string svg_chart(const Chart& chart) {
  constexpr double width = 520.0, height = 340.0, left = 64.0, right = 14.0, top = 30.0, bottom = 44.0;
  // Of Okabe & Ito (2008), which colour-blind readers tell apart.
  static constexpr std::array<const char*, 4> lines{"#0072b2", "#009e73", "#cc79a7", "#e69f00"};
  double x0 = 1e300, x1 = -1e300, y0 = 1e300, y1 = -1e300;
  for (const auto* group : {&chart.references, &chart.simulated}) {
    for (const Series& s : *group) {
      for (std::size_t k = 0; k < s.x.size(); ++k) {
        x0 = std::min(x0, s.x[k]);
        x1 = std::max(x1, s.x[k]);
        y0 = std::min(y0, s.y[k]);
        y1 = std::max(y1, s.y[k]);
      }
    }
  }
  const detail::Axis ax{x0, x1}, ay{y0, y1};
  const auto px = [&](double x) { return left + ax.share(x) * (width - left - right); };
  const auto py = [&](double y) { return height - bottom - ay.share(y) * (height - top - bottom); };

  std::string out = fmt::format("<svg viewBox='0 0 {0} {1}' width='{0}' height='{1}' role='img'>"
                                "<text x='{2}' y='18' class='title'>{3}</text>",
                                width, height, left, scree::xml_escaped(chart.title));
  for (const double mark : ax.marks) {
    out += fmt::format("<line x1='{0:.1f}' x2='{0:.1f}' y1='{1:.1f}' y2='{2:.1f}' class='grid'/>"
                       "<text x='{0:.1f}' y='{3:.1f}' text-anchor='middle'>{4:.4g}</text>",
                       px(mark), py(ay.low), py(ay.high), py(ay.low) + 15.0, mark);
  }
  for (const double mark : ay.marks) {
    out += fmt::format("<line x1='{0:.1f}' x2='{1:.1f}' y1='{2:.1f}' y2='{2:.1f}' class='grid'/>"
                       "<text x='{3:.1f}' y='{4:.1f}' text-anchor='end'>{5:.4g}</text>",
                       px(ax.low), px(ax.high), py(mark), left - 6.0, py(mark) + 4.0, mark);
  }
  out += fmt::format("<text x='{:.1f}' y='{:.1f}' text-anchor='middle'>{}</text>"
                     "<text transform='translate(13 {:.1f}) rotate(-90)' text-anchor='middle'>{}</text>",
                     0.5 * (px(ax.low) + px(ax.high)), height - 8.0, scree::xml_escaped(chart.x_label),
                     0.5 * (py(ay.low) + py(ay.high)), scree::xml_escaped(chart.y_label));

  double legend = top + 8.0;
  const auto say = [&](const std::string& sign, const std::string& label) {
    out += fmt::format("<g transform='translate({:.1f} {:.1f})'>{}<text x='24' y='4'>{}</text></g>",
                       left + 10.0, legend, sign, scree::xml_escaped(label));
    legend += 15.0;
  };
  for (std::size_t n = 0; n < chart.simulated.size(); ++n) {
    const Series& s = chart.simulated[n];
    std::string points;
    for (std::size_t k = 0; k < s.x.size(); ++k) {
      points += fmt::format("{:.1f},{:.1f} ", px(s.x[k]), py(s.y[k]));
    }
    out += fmt::format("<polyline points='{}' fill='none' stroke='{}' stroke-width='1.8'/>", points,
                       lines[n % lines.size()]);
    say(fmt::format("<line x1='0' x2='18' stroke='{}' stroke-width='1.8'/>", lines[n % lines.size()]),
        s.label);
  }
  for (const Series& s : chart.references) {
    // Measured: filled discs. Theory: crosses. Other codes: open squares.
    const std::string sign = s.origin == Origin::experiment ? "<circle r='3.2' fill='#222'/>"
                             : s.origin == Origin::theory
                                 ? "<path d='M-3 -3L3 3M-3 3L3 -3' stroke='#222' fill='none'/>"
                                 : "<rect x='-3' y='-3' width='6' height='6' stroke='#d55e00' fill='none'/>";
    for (std::size_t k = 0; k < s.x.size(); ++k) {
      out += fmt::format("<g transform='translate({:.1f} {:.1f})'>{}</g>", px(s.x[k]), py(s.y[k]), sign);
    }
    say("<g transform='translate(9 0)'>" + sign + "</g>", s.label + " (" + name(s.origin) + ")");
  }
  return out + "</svg>\n";
}

} // namespace validation
