#pragma once
/// \file
/// Curves of the reference data, and how far simulated ones are from them.

#include "finding.hpp"

#include "scree/core/error.hpp"
#include "scree/io/csv.hpp"
#include "scree/io/number_text.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

namespace validation {

/// The first two columns of a table of numbers.
inline Series read_curve(const std::filesystem::path& file, std::string label, Origin origin) {
  const scree::CsvTable table = scree::read_csv(file);
  Series out{std::move(label), origin, {}, {}};
  out.x = table.data.at(0);
  out.y = table.data.at(1);
  return out;
}

/// The points of one series and quantity of a table "series,quantity,x,value".
/// \throws Error naming file and line.
inline Series read_series(const std::filesystem::path& file, const std::string& series,
                          const std::string& quantity, std::string label, Origin origin) {
  std::ifstream in{file};
  if (!in) {
    throw scree::Error(scree::message(file.string(), ": cannot be opened"));
  }
  Series out{std::move(label), origin, {}, {}};
  std::string line;
  std::getline(in, line); // the header
  for (std::size_t number = 2; std::getline(in, line); ++number) {
    std::istringstream words{line};
    std::string a, b, x, y;
    std::getline(words, a, ',');
    std::getline(words, b, ',');
    std::getline(words, x, ',');
    std::getline(words, y, ',');
    if (a != series || b != quantity) {
      continue;
    }
    const auto vx = scree::parse_number(x), vy = scree::parse_number(y);
    if (!vx || !vy) {
      throw scree::Error(scree::message(file.string(), ":", number, ": not a number"));
    }
    out.x.push_back(*vx);
    out.y.push_back(*vy);
  }
  if (out.x.empty()) {
    throw scree::Error(scree::message(file.string(), ": has no points of ", series, ", ", quantity));
  }
  return out;
}

/// The value of a joined series at `x`, linear between its points and held beyond them.
inline double value_at(const Series& series, double x) {
  const auto above = std::upper_bound(series.x.begin(), series.x.end(), x);
  if (above == series.x.begin()) {
    return series.y.front();
  }
  if (above == series.x.end()) {
    return series.y.back();
  }
  const auto k = static_cast<std::size_t>(above - series.x.begin());
  const double share = (x - series.x[k - 1]) / (series.x[k] - series.x[k - 1]);
  return series.y[k - 1] + share * (series.y[k] - series.y[k - 1]);
}

/// Root mean square of the distance between points and a curve: each point's distance to the nearest place
/// of the curve, both axes in units of the points' range. So a steep part counts no more than a flat one.
inline double rms_distance(const Series& points, const Series& curve) {
  const auto range = [](const std::vector<double>& v) {
    const auto [low, high] = std::minmax_element(v.begin(), v.end());
    return std::max(1e-300, *high - *low);
  };
  const double width = range(points.x), height = range(points.y);
  double sum = 0.0;
  for (std::size_t p = 0; p < points.x.size(); ++p) {
    double nearest = 1e300;
    for (std::size_t k = 0; k + 1 < curve.x.size(); ++k) {
      const double ax = curve.x[k] / width, ay = curve.y[k] / height;
      const double bx = curve.x[k + 1] / width - ax, by = curve.y[k + 1] / height - ay;
      const double px = points.x[p] / width - ax, py = points.y[p] / height - ay;
      const double along = std::clamp((px * bx + py * by) / std::max(1e-300, bx * bx + by * by), 0.0, 1.0);
      nearest = std::min(nearest, std::pow(px - along * bx, 2) + std::pow(py - along * by, 2));
    }
    sum += nearest;
  }
  return height * std::sqrt(sum / static_cast<double>(points.x.size()));
}

} // namespace validation
