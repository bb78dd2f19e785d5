#pragma once
/// \file
/// Draws the grains of a material from its shapes and their sieve curves.

#include "scree/core/error.hpp"
#include "scree/core/random.hpp"
#include "scree/packing/sieve_curve.hpp"
#include "scree/packing/templates.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

namespace scree {

/// One shape of a material: how frequent it is, and in what sizes.
struct ShapeFraction {
  Clump shape;      ///< at unit scale, that is of any size
  double fraction;  ///< of the number of grains, 0 to 1
  SieveCurve sizes; ///< of this shape, in terms of sieve_size()
};

/// The paper's four shapes with the default sieve curve. Their fractions are not in the text of the paper
/// (its Fig. 7 has them) and are ours.
inline std::vector<ShapeFraction> default_rock(MassConvention convention = MassConvention::union_of_spheres) {
  const auto shapes = paper_shapes(convention);
  return {{shapes[0], 0.30, default_sieve_curve()},
          {shapes[1], 0.30, default_sieve_curve()},
          {shapes[2], 0.25, default_sieve_curve()},
          {shapes[3], 0.15, default_sieve_curve()}};
}

/// One grain: which shape, and by what factor it is scaled.
struct DrawnClump {
  std::size_t shape;
  double scale;
};

/// A material as a set of shapes with sizes, from which any number of grains can be drawn.
///
/// The draw is stratified: n grains come from n equal parts of the distribution over shape and size, one from
/// each, in random order. The number of grains of any shape and sieve class then differs from its expected
/// value by less than 2, where independent draws would be off by its square root.
class Assembly {
public:
  /// \param shapes shapes with fractions that sum to 1 (within 1e-6)
  /// \param size_factor multiplies all sizes, for a model with fewer, larger grains
  /// \throws Error for fractions that are negative or do not sum to 1, or a size factor not above zero.
  explicit Assembly(std::vector<ShapeFraction> shapes, double size_factor = 1.0)
      : shapes_{std::move(shapes)}, size_factor_{require_positive("size factor", size_factor)} {
    double sum = 0.0;
    for (const ShapeFraction& s : shapes_) {
      sum += require(message("fraction of shape \"", s.shape.name, "\""), s.fraction, {0.0, 1.0});
      sieve_sizes_.push_back(sieve_size(s.shape));
    }
    require("sum of the shape fractions", sum, {1.0 - 1e-6, 1.0 + 1e-6});
    for (ShapeFraction& s : shapes_) {
      s.fraction /= sum;
    }
  }

  /// The shapes, with fractions normalised to a sum of 1.
  [[nodiscard]] const std::vector<ShapeFraction>& shapes() const { return shapes_; }
  [[nodiscard]] double size_factor() const { return size_factor_; }

  /// The clumps at unit scale, in the order of shapes().
  [[nodiscard]] std::vector<Clump> clumps() const {
    std::vector<Clump> result;
    for (const ShapeFraction& s : shapes_) {
      result.push_back(s.shape);
    }
    return result;
  }

  /// Sieve size [m] of a drawn clump in the material, that is before the size factor.
  [[nodiscard]] double material_size(const DrawnClump& drawn) const {
    return drawn.scale * sieve_sizes_[drawn.shape] / size_factor_;
  }

  /// Mean solid volume of a grain [m3], size factor included.
  [[nodiscard]] double mean_volume() const {
    double sum = 0.0;
    for (std::size_t i = 0; i < shapes_.size(); ++i) {
      const ShapeFraction& s = shapes_[i];
      sum += s.fraction * s.shape.union_volume * s.sizes.mean_cubed_size() *
             std::pow(size_factor_ / sieve_sizes_[i], 3);
    }
    return sum;
  }

  /// m, of a sphere with that volume.
  [[nodiscard]] double mean_diameter() const { return std::cbrt(6.0 / std::numbers::pi * mean_volume()); }

  /// m, across the largest clump that can be drawn.
  [[nodiscard]] double largest_diameter() const {
    double largest = 0.0;
    for (std::size_t i = 0; i < shapes_.size(); ++i) {
      if (shapes_[i].fraction > 0.0) {
        largest = std::max(largest, bounding_diameter(scaled_to(i, 1.0)));
      }
    }
    return largest;
  }

  /// m, across a drawn clump where it is longest.
  [[nodiscard]] double bounding_diameter(const DrawnClump& drawn) const {
    return 2.0 * drawn.scale * shapes_[drawn.shape].shape.bounding_radius;
  }

  /// Draws `count` grains.
  [[nodiscard]] std::vector<DrawnClump> draw(std::size_t count, Random& random) const {
    std::vector<DrawnClump> grains;
    grains.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      grains.push_back(grain((static_cast<double>(i) + random.uniform()) / static_cast<double>(count)));
    }
    random.shuffle(std::span{grains});
    return grains;
  }

  /// Draws as many grains as have a solid volume (of the union) of `solid_volume` [m3] on average, at least
  /// one. What is drawn has that volume to within two of the largest grains of each shape.
  /// \throws Error unless the volume is finite, above zero, and that of at most 10^9 grains.
  [[nodiscard]] std::vector<DrawnClump> draw_volume(double solid_volume, Random& random) const {
    require_positive("solid volume to draw", solid_volume, "m3");
    const double count = require("number of grains to draw", solid_volume / mean_volume(), {0.0, 1e9});
    return draw(static_cast<std::size_t>(std::max(1.0, std::round(count))), random);
  }

private:
  /// The grain at `u` in [0, 1] of the distribution ordered by shape and then by size.
  [[nodiscard]] DrawnClump grain(double u) const {
    double below = 0.0;
    std::size_t last = 0;
    for (std::size_t i = 0; i < shapes_.size(); ++i) {
      const double fraction = shapes_[i].fraction;
      if (fraction > 0.0) {
        last = i;
        if (u < below + fraction) {
          return scaled_to(i, (u - below) / fraction);
        }
      }
      below += fraction;
    }
    return scaled_to(last, 1.0); // u within rounding of 1
  }

  [[nodiscard]] DrawnClump scaled_to(std::size_t shape, double u) const {
    const double size = shapes_[shape].sizes.number_quantile(std::clamp(u, 0.0, 1.0));
    return {shape, size_factor_ * size / sieve_sizes_[shape]};
  }

  std::vector<ShapeFraction> shapes_;
  std::vector<double> sieve_sizes_; // m, of each shape at unit scale
  double size_factor_;
};

} // namespace scree
