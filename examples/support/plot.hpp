#pragma once
/// \file
/// Plots by gnuplot: a script beside the data, an SVG and a PNG from it.

#include "scree/core/error.hpp"
#include "scree/io/atomic_file.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

namespace scree::examples {

/// A curve from two columns of a CSV file.
struct Curve {
  std::filesystem::path file; ///< relative to the folder of the plot
  std::string x, y;           ///< column names
  std::string title;
  double factor = 1.0; ///< on y
};

/// A value from elsewhere, drawn as a point with its label.
struct StatedPoint {
  double x, y;
  std::string label;
  int kind = 0; ///< points of one kind look alike: 0 measured, 1 simulated by others
};

struct Panel {
  std::string title, x_label, y_label; ///< with units
  std::vector<Curve> curves;
  std::vector<StatedPoint> points{};
};

/// The gnuplot script that draws `panels` one below the other into `name`.svg and `name`.png.
inline std::string plot_script(const std::string& name, const std::string& title,
                               const std::vector<Panel>& panels) {
  const auto quoted = [](const std::string& text) {
    std::string out = "'";
    for (const char c : text) {
      out += c == '\'' ? "''" : std::string{c};
    }
    return out + "'";
  };
  std::string body =
      fmt::format("set multiplot layout {},1 title {} font ',14'\n", panels.size(), quoted(title));
  body += "set datafile separator ','\nset datafile commentschars '#'\nset grid lc rgb '#d8d8d8'\n"
          "set key outside right top width 1 samplen 2\nset border 3\nset tics nomirror\nset lmargin 11\nset "
          "rmargin 30\n";
  static constexpr const char* colours[] = {"#1b6ca8", "#c44536", "#5c8a3a", "#8a5a9e"};
  for (const Panel& panel : panels) {
    body += fmt::format("set title {}\nset xlabel {}\nset ylabel {}\n", quoted(panel.title),
                        quoted(panel.x_label), quoted(panel.y_label));
    std::string parts, data;
    std::size_t n = 0;
    for (const Curve& c : panel.curves) {
      parts += fmt::format("{} {} using (column({})):(column({})*{}) with lines lw 2 lc rgb '{}' title {}",
                           parts.empty() ? "plot" : ",", quoted(c.file.string()), quoted(c.x), quoted(c.y),
                           c.factor, colours[n++ % 4], quoted(c.title));
    }
    for (const StatedPoint& p : panel.points) {
      parts += fmt::format("{} '-' using 1:2 with points pt {} ps 1.6 lw 2 lc rgb '{}' title {}",
                           parts.empty() ? "plot" : ",", p.kind == 0 ? 7 : 8,
                           p.kind == 0 ? "#222222" : "#d08b2c", quoted(p.label));
      data += fmt::format("{},{}\ne\n", p.x, p.y);
    }
    body += parts + "\n" + data;
  }
  body += "unset multiplot\n";
  const std::size_t height = 300 * panels.size() + 40;
  return fmt::format(
      "# Drawn by gnuplot from the tables beside it.\n"
      "set terminal svg size 1000,{0} font 'sans,12' background 'white'\nset output '{1}.svg'\n{2}"
      "set output\nreset\n"
      "set terminal pngcairo size 1000,{0} font 'sans,11'\nset output '{1}.png'\n{2}set output\n",
      height, name, body);
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
