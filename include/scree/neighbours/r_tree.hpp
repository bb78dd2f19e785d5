#pragma once
/// \file
/// Search through an R-tree of Boost.Geometry.

#include "scree/neighbours/concept.hpp"

#include <boost/geometry/core/cs.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>

#include <iterator>
#include <utility>

namespace scree {

/// A packed R-tree (sort-tile-recursive) made anew at each search. Slower than a grid where all balls are of
/// one size, indifferent to how widely the sizes are spread.
struct RTree {
  [[nodiscard]] static double skin(double) { return 0.0; }

  void find(std::span<const Ball> balls, std::size_t owned, double margin, Workers& workers,
            CandidateRows& rows) const {
    namespace bg = boost::geometry;
    using Point = bg::model::point<double, 3, bg::cs::cartesian>;
    using Box = bg::model::box<Point>;
    using Value = std::pair<Box, std::uint32_t>;
    const auto box = [](const Ball& b, double extra) {
      const double r = b.radius + extra;
      return Box{Point{b.centre.x - r, b.centre.y - r, b.centre.z - r},
                 Point{b.centre.x + r, b.centre.y + r, b.centre.z + r}};
    };
    std::vector<Value> values;
    values.reserve(balls.size());
    for (std::size_t k = 0; k < balls.size(); ++k) {
      values.emplace_back(box(balls[k], 0.0), static_cast<std::uint32_t>(k));
    }
    const bg::index::rtree<Value, bg::index::rstar<16>> tree{values};
    rows.build(owned, workers, [&](std::size_t i, std::vector<std::uint32_t>& row) {
      for (auto hit = tree.qbegin(bg::index::intersects(box(balls[i], margin))); hit != tree.qend(); ++hit) {
        if (hit->second > i && within(balls[i], balls[hit->second], margin)) {
          row.push_back(hit->second);
        }
      }
    });
  }
};

} // namespace scree
