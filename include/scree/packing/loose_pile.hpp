#pragma once
/// \file
/// Bodies dropped one by one and stuck where they land: a denser start for settling than a lattice.

#include "scree/core/error.hpp"
#include "scree/core/random.hpp"
#include "scree/packing/assembly.hpp"
#include "scree/packing/packing.hpp"
#include "scree/packing/placement.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

namespace scree {

namespace detail {

/// Spheres binned by x and y, to find how far another one can come down from above.
class LandingField {
public:
  /// \param footprint box [m] that all centres lie in, seen from above
  /// \param largest_radius of the spheres [m]
  LandingField(const Eigen::AlignedBox3d& footprint, double largest_radius)
      : corner_{footprint.min()},
        bin_{2.0 * largest_radius},
        nx_{bins(footprint.sizes().x())},
        ny_{bins(footprint.sizes().y())},
        spheres_(nx_ * ny_) {}

  void add(const Sphere& s) {
    // Each bin is in ascending order of the tops, so that landing() need not look far down.
    auto& bin = spheres_[column(s.centre.x(), nx_, 0) + nx_ * column(s.centre.y(), ny_, 1)];
    const auto lower = [](const Sphere& a, const Sphere& b) { return top(a) < top(b); };
    bin.insert(std::upper_bound(bin.begin(), bin.end(), s, lower), s);
  }

  /// Least height of the centre of `s`, at or above `height`, at which it overlaps no sphere when it comes
  /// from above.
  [[nodiscard]] double landing(const Sphere& s, double height) const {
    const std::size_t i = column(s.centre.x(), nx_, 0);
    const std::size_t j = column(s.centre.y(), ny_, 1);
    for (std::size_t jj = j - std::min<std::size_t>(j, 1); jj <= std::min(j + 1, ny_ - 1); ++jj) {
      for (std::size_t ii = i - std::min<std::size_t>(i, 1); ii <= std::min(i + 1, nx_ - 1); ++ii) {
        const auto& bin = spheres_[ii + nx_ * jj];
        for (auto it = bin.rbegin(); it != bin.rend() && top(*it) + s.radius > height; ++it) {
          const Sphere& other = *it;
          const double reach = s.radius + other.radius;
          const double dx = s.centre.x() - other.centre.x();
          const double dy = s.centre.y() - other.centre.y();
          const double squared = reach * reach - dx * dx - dy * dy;
          if (squared > 0.0) {
            height = std::max(height, other.centre.z() + std::sqrt(squared));
          }
        }
      }
    }
    return height;
  }

private:
  static double top(const Sphere& s) { return s.centre.z() + s.radius; }
  [[nodiscard]] std::size_t bins(double length) const {
    return static_cast<std::size_t>(std::max(1.0, std::floor(length / bin_)));
  }
  [[nodiscard]] std::size_t column(double x, std::size_t count, Eigen::Index axis) const {
    const double bin = std::floor((x - corner_[axis]) / bin_);
    return static_cast<std::size_t>(std::clamp(bin, 0.0, static_cast<double>(count - 1)));
  }

  Vector corner_;
  double bin_;
  std::size_t nx_, ny_;
  std::vector<std::vector<Sphere>> spheres_;
};

/// What a body in its orientation needs around its place.
struct BodyReach {
  Vector least = Vector::Zero(), most = Vector::Zero(); ///< m, of its box
  double aside = 0.0; ///< m, of its farthest point from the vertical through its place
};

/// Ballistic deposition on the plane z = floor. `place(random, BodyReach)` gives where, seen from above.
template <class Place>
Packing piled(const std::vector<Clump>& shapes, std::span<const DrawnClump> drawn,
              const Eigen::AlignedBox3d& footprint, const Place& place, Random& random, double gap,
              std::size_t trials) {
  require("gap of the loose pile", gap, {0.0, 1.0});
  require("places tried for each body", static_cast<double>(trials), {1.0, 1000.0});
  require_placeable(shapes, drawn, footprint, gap);
  Packing packing{shapes, {}};
  if (drawn.empty()) {
    return packing;
  }
  double largest_radius = 0.0; // m, of a sphere with its gap
  for (const DrawnClump& d : drawn) {
    for (const Sphere& s : shapes[d.shape].spheres) {
      largest_radius = std::max(largest_radius, (1.0 + gap) * d.scale * s.radius);
    }
  }

  LandingField field{footprint, largest_radius};
  packing.bodies.reserve(drawn.size());
  for (const DrawnClump& d : drawn) {
    PackedBody best;
    std::vector<Sphere> best_spheres;
    double lowest = std::numeric_limits<double>::infinity();
    for (std::size_t trial = 0; trial < trials; ++trial) {
      PackedBody body;
      body.shape = static_cast<std::uint32_t>(d.shape);
      body.scale = d.scale;
      body.orientation = random.orientation();
      auto spheres = spheres_in_space(packing, body); // about the origin
      BodyReach reach;
      for (Sphere& s : spheres) {
        s.radius *= 1.0 + gap;
        reach.least = reach.least.cwiseMin((s.centre.array() - s.radius).matrix());
        reach.most = reach.most.cwiseMax((s.centre.array() + s.radius).matrix());
        reach.aside = std::max(reach.aside, s.centre.head<2>().norm() + s.radius);
      }
      body.position << place(random, reach), footprint.min().z() - reach.least.z();
      for (Sphere& s : spheres) {
        s.centre += Vector{body.position.x(), body.position.y(), 0.0};
        const double landed = field.landing(s, body.position.z() + s.centre.z());
        body.position.z() = std::max(body.position.z(), landed - s.centre.z());
      }
      if (body.position.z() < lowest) {
        lowest = body.position.z();
        best = body;
        best_spheres = std::move(spheres);
      }
    }
    for (Sphere& s : best_spheres) {
      s.centre.z() += lowest;
      field.add(s);
    }
    packing.bodies.push_back(best);
  }
  return packing;
}

} // namespace detail

/// Piles the drawn clumps, at rest, on the bottom of `footprint` as high as they need; the top of the box
/// plays no part. No two bodies overlap, and all lie within the sides and above the bottom of the box.
///
/// Ballistic deposition: each body in turn comes straight down and stays where one of its spheres first meets
/// another or the bottom. Of several random places and orientations the one where it comes lowest is taken.
/// \param shapes clumps at unit scale
/// \param drawn the bodies, in the order in which they are placed and returned
/// \param footprint box [m], wider than the largest bounding sphere
/// \param random places and orientations
/// \param gap distance at which spheres meet, as a fraction of the sum of their radii, 0 to 1
/// \param trials places tried for each body, 1 to 1000; more give a denser pile
/// \throws Error for a shape that does not exist, a scale not above zero, or a footprint that is too small.
inline Packing loose_pile(const std::vector<Clump>& shapes, std::span<const DrawnClump> drawn,
                          const Eigen::AlignedBox3d& footprint, Random& random, double gap = 0.01,
                          std::size_t trials = 10) {
  const auto place = [&footprint](Random& from, const detail::BodyReach& reach) {
    const Vector low = footprint.min() - reach.least;
    const Vector high = footprint.max() - reach.most;
    const double x = from.uniform(low.x(), high.x());
    return Eigen::Vector2d{x, from.uniform(low.y(), high.y())};
  };
  return detail::piled(shapes, drawn, footprint, place, random, gap, trials);
}

/// A circle about the vertical through the origin, to pile grains on.
struct RoundFootprint {
  double radius = 0.0; ///< m
  double floor = 0.0;  ///< m, its height
};

/// As above, within a circle.
/// \throws Error as above.
inline Packing loose_pile(const std::vector<Clump>& shapes, std::span<const DrawnClump> drawn,
                          const RoundFootprint& footprint, Random& random, double gap = 0.01,
                          std::size_t trials = 10) {
  require_positive("radius of the footprint", footprint.radius, "m");
  const double r = footprint.radius;
  const Eigen::AlignedBox3d around{Vector{-r, -r, footprint.floor}, Vector{r, r, footprint.floor + 2.0 * r}};
  const auto place = [r](Random& from, const detail::BodyReach& reach) {
    const double distance = (r - reach.aside) * std::sqrt(from.uniform());
    const double angle = from.uniform(0.0, 2.0 * std::numbers::pi);
    return Eigen::Vector2d{distance * std::cos(angle), distance * std::sin(angle)};
  };
  return detail::piled(shapes, drawn, around, place, random, gap, trials);
}

} // namespace scree
