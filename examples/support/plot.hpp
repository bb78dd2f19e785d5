#pragma once
/// \file
/// Plots by gnuplot: a script beside the data, an SVG and a PNG from it.

#include "scree/core/error.hpp"
#include "scree/io/atomic_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace scree::examples {

/// A curve from two columns of a CSV file.
struct Curve {
  std::filesystem::path file; ///< relative to the folder of the plot
  std::string x, y;           ///< column names
  std::string title;
  double factor = 1.0; ///< on y
  std::string error{}; ///< column of the standard error of y, drawn as bars; none
};

/// A value from elsewhere, drawn as a point. Points of one label look alike, others of a kind differ in
/// shape.
struct StatedPoint {
  double x, y;
  std::string label;
  int kind = 0; ///< 0 measured, drawn filled; 1 simulated by others, drawn open
};

struct Panel {
  std::string title, x_label, y_label; ///< with units
  std::vector<Curve> curves;
  std::vector<StatedPoint> points{};
  bool log_x = false;              ///< whether equal factors of x are equally far apart
  std::vector<std::string> rows{}; ///< names at y = 1, 2, ... downwards, instead of numbers
};

namespace detail {

/// A text as gnuplot reads it between single quotes.
inline std::string gnuplot_text(std::string_view text) {
  std::string out = "'";
  for (const char c : text) {
    out += c == '\'' ? "''" : std::string{c};
  }
  return out + "'";
}

/// The commands for the y axis of a panel, the room that it takes, and room within that keeps points off the
/// frame.
inline std::string y_axis(const Panel& panel) {
  if (panel.rows.empty()) {
    return "set ytics autofreq\nset yrange [*:*]\nset lmargin 10\n"
           "set offsets graph 0, graph 0.02, graph 0.07, graph 0.05\n";
  }
  std::string tics;
  std::size_t longest = 0;
  for (std::size_t k = 0; k < panel.rows.size(); ++k) {
    tics += fmt::format("{}{} {}", k == 0 ? "" : ",", gnuplot_text(panel.rows[k]), k + 1);
    longest = std::max(longest, panel.rows[k].size());
  }
  return fmt::format("set ytics ({})\nset yrange [{}.5:0.5]\nset lmargin {}\n"
                     "set offsets graph 0.04, graph 0.04, 0, 0\n",
                     tics, panel.rows.size(), longest + 3);
}

/// The commands that draw one panel.
inline std::string panel_commands(const Panel& panel) {
  // Blue, vermilion, green and purple of Okabe & Ito (2008), which colour-blind readers tell apart.
  static constexpr std::array<const char*, 4> colours{"#0072b2", "#d55e00", "#009e73", "#cc79a7"};
  std::string tics = "autofreq";
  if (panel.log_x) { // gnuplot's own are whole decades only, of which few panels have two
    tics.clear();
    for (int decade = -9; decade <= 12; ++decade) {
      tics += fmt::format("{}1e{},2e{},5e{}", tics.empty() ? "(" : ",", decade, decade, decade);
    }
    tics += ")";
  }
  std::string out = fmt::format("set title {}\nset xlabel {}\nset ylabel {}\n{} logscale x\nset xtics {}\n",
                                gnuplot_text(panel.title), gnuplot_text(panel.x_label),
                                gnuplot_text(panel.y_label), panel.log_x ? "set" : "unset", tics);
  out += y_axis(panel);
  std::string parts, data;
  for (std::size_t n = 0; n < panel.curves.size(); ++n) {
    const Curve& c = panel.curves[n];
    const std::string bars =
        c.error.empty() ? "" : fmt::format(":(column({})*{})", gnuplot_text(c.error), c.factor);
    parts += fmt::format("{} {} using (column({})):(column({})*{}){} with {} lw 1.8 lc rgb '{}' title {}",
                         parts.empty() ? "plot" : ",", gnuplot_text(c.file.string()), gnuplot_text(c.x),
                         gnuplot_text(c.y), c.factor, bars, bars.empty() ? "lines" : "yerrorlines",
                         colours[n % colours.size()], gnuplot_text(c.title));
  }
  std::array<std::vector<std::string>, 2> labels; // of each kind
  for (const StatedPoint& p : panel.points) {
    const bool measured = p.kind == 0;
    auto& known = labels[measured ? 0 : 1];
    const auto shape =
        static_cast<std::size_t>(std::find(known.begin(), known.end(), p.label) - known.begin());
    const bool fresh = shape == known.size();
    if (fresh) {
      known.push_back(p.label);
    }
    // gnuplot's circles, squares, diamonds and triangles: filled ones are odd, open ones even.
    static constexpr std::array<int, 4> filled{7, 5, 13, 9};
    static constexpr std::array<int, 4> open{8, 4, 12, 6};
    parts +=
        fmt::format("{} '-' using 1:2 with points pt {} ps 1.5 lw 2 lc rgb '{}' {}",
                    parts.empty() ? "plot" : ",", (measured ? filled : open)[shape % filled.size()],
                    measured ? "#222222" : "#d55e00", fresh ? "title " + gnuplot_text(p.label) : "notitle");
    data += fmt::format("{},{}\ne\n", p.x, p.y);
  }
  return out + parts + "\n" + data;
}

} // namespace detail

/// The gnuplot script that draws `panels`, two to a row, into `name`.svg and `name`.png.
inline std::string plot_script(const std::string& name, const std::string& title,
                               const std::vector<Panel>& panels) {
  const std::size_t columns = panels.size() > 1 ? 2 : 1;
  const std::size_t rows = (panels.size() + columns - 1) / columns;
  // Legends stand below the panels.
  std::string body = fmt::format(
      "set encoding utf8\nset multiplot layout {},{} title {} font ',14'\n"
      "set datafile separator ','\nset datafile commentschars '#'\n"
      "set border 3 lc rgb '#404040'\nset tics nomirror out scale 0.6\nset format '%g'\n"
      "set grid lt 1 lw 0.6 lc rgb '#dddddd'\nset autoscale noextend\n"
      "set key at graph 0, graph -0.24 left top Left reverse vertical maxrows 3 samplen 2 width 2\n"
      "set rmargin 3\nset bmargin 7.5\n",
      rows, columns, detail::gnuplot_text(title));
  for (const Panel& panel : panels) {
    body += detail::panel_commands(panel);
  }
  body += "unset multiplot\n";
  const std::size_t width = columns == 1 ? 900 : 1400;
  const std::size_t height = 430 * rows + 50;
  return fmt::format("# Drawn by gnuplot from the tables beside it.\n"
                     "set terminal svg noenhanced size {0},{1} font 'sans,13' background 'white'\n"
                     "set output '{2}.svg'\n{3}set output\nreset\n"
                     "set terminal pngcairo noenhanced size {0},{1} font 'sans,11'\n"
                     "set output '{2}.png'\n{3}set output\n",
                     width, height, name, body);
}

/// Writes `name`.gp into `folder` and has gnuplot draw `name`.svg and `name`.png there. Where that fails the
/// script stays, and the reason is returned; empty where all went well.
inline std::string draw_plot(const std::filesystem::path& folder, const std::string& name,
                             const std::string& title, const std::vector<Panel>& panels) {
  write_atomically(folder / (name + ".gp"), plot_script(name, title, panels));
  const std::string folder_text = folder.string();
  if (folder_text.find('\'') != std::string::npos) {
    return message("the folder's name holds a quote: run gnuplot on ", (folder / (name + ".gp")).string(),
                   " yourself");
  }
  const std::string log = name + ".gnuplot.log";
  const int status =
      std::system(fmt::format("cd '{}' && gnuplot {}.gp > {} 2>&1", folder_text, name, log).c_str());
  if (status != 0) {
    return message("gnuplot could not draw ", name, " (is it installed? see ", (folder / log).string(), ")");
  }
  std::error_code ignored;
  std::filesystem::remove(folder / log, ignored);
  return {};
}

} // namespace scree::examples
