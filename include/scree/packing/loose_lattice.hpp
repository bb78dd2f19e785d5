#pragma once
/// \file
/// Bodies set apart from each other on a jittered lattice: where a packing that settles under gravity begins.

#include "scree/core/error.hpp"
#include "scree/core/random.hpp"
#include "scree/packing/assembly.hpp"
#include "scree/packing/packing.hpp"
#include "scree/packing/placement.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace scree {

namespace detail {

/// Hands out the cells of a lattice from the bottom up. A cell of level k has half the edges of one of level
/// k - 1, of which eight are cut on demand, so that small grains do not each take the place of a large one.
class NestedLattice {
public:
  /// \param corner lower corner of the lattice [m]
  /// \param edges of a cell of level 0 [m]
  /// \param nx, ny cells in a layer, at least 1
  NestedLattice(const Vector& corner, const Vector& edges, std::size_t nx, std::size_t ny)
      : corner_{corner}, edges_{edges}, nx_{nx}, ny_{ny} {}

  [[nodiscard]] Vector edges(std::size_t level) const {
    return std::ldexp(1.0, -static_cast<int>(level)) * edges_;
  }

  /// Lower corner of a cell of that level that was not handed out before.
  Vector take(std::size_t level) {
    if (level == 0) {
      const std::size_t i = taken_++;
      const std::size_t row = i / nx_, layer = row / ny_;
      const Vector place{static_cast<double>(i % nx_), static_cast<double>(row % ny_),
                         static_cast<double>(layer)};
      return corner_ + edges_.cwiseProduct(place);
    }
    if (free_.size() <= level) {
      free_.resize(level + 1);
    }
    if (free_[level].empty()) {
      const Vector parent = take(level - 1);
      for (unsigned octant = 8; octant-- > 0;) { // the lower four end on top of the stack
        const Vector place{static_cast<double>(octant & 1U), static_cast<double>(octant >> 1U & 1U),
                           static_cast<double>(octant >> 2U)};
        free_[level].emplace_back(parent + edges(level).cwiseProduct(place));
      }
    }
    Vector cell = free_[level].back();
    free_[level].pop_back();
    return cell;
  }

private:
  Vector corner_;
  Vector edges_;
  std::size_t nx_;
  std::size_t ny_;
  std::size_t taken_ = 0;
  std::vector<std::vector<Vector>> free_; // by level
};

} // namespace detail

/// Places the drawn clumps, at rest and in random orientation, above the bottom of `footprint`, layer upon
/// layer as high as they need; the top of the box plays no part. No two bounding spheres touch, and all lie
/// within the sides and above the bottom of the box.
///
/// Each body has a cell of the lattice and a random place in it. The largest bodies set the cell; the smaller
/// share one between eight, sixty-four and so on, in the order of the list, so that sizes stay mixed.
/// \param shapes clumps at unit scale
/// \param drawn the bodies, in the order in which they are placed and returned
/// \param footprint box [m], wider than the largest bounding sphere
/// \param random orientation and jitter
/// \param gap least distance between bounding spheres, as a fraction of the mean of their diameters, 0 to 10
/// \throws Error for a shape that does not exist, a scale not above zero, or a footprint that is too small.
inline Packing loose_lattice(const std::vector<Clump>& shapes, std::span<const DrawnClump> drawn,
                             const Eigen::AlignedBox3d& footprint, Random& random, double gap = 0.02) {
  require("gap of the loose lattice", gap, {0.0, 10.0});
  const double largest = detail::require_placeable(shapes, drawn, footprint, gap);
  Packing packing{shapes, {}};
  if (drawn.empty()) {
    return packing;
  }
  const Vector size = footprint.sizes();
  const double nx = std::floor(size.x() / largest);
  const double ny = std::floor(size.y() / largest);
  detail::NestedLattice lattice{footprint.min(),
                                {size.x() / nx, size.y() / ny, largest},
                                static_cast<std::size_t>(nx),
                                static_cast<std::size_t>(ny)};
  packing.bodies.reserve(drawn.size());
  for (const DrawnClump& d : drawn) {
    const double diameter = 2.0 * (1.0 + gap) * d.scale * shapes[d.shape].bounding_radius;
    std::size_t level = 0;
    while (level < 20 && std::ldexp(diameter, static_cast<int>(level) + 1) <= largest) {
      ++level;
    }
    const Vector slack = lattice.edges(level).array() - diameter;
    const Vector jitter{random.uniform(), random.uniform(), random.uniform()};
    PackedBody body;
    body.shape = static_cast<std::uint32_t>(d.shape);
    body.scale = d.scale;
    body.position =
        lattice.take(level) + slack.cwiseMax(0.0).cwiseProduct(jitter) + Vector::Constant(0.5 * diameter);
    body.orientation = random.orientation();
    packing.bodies.push_back(body);
  }
  return packing;
}

} // namespace scree
