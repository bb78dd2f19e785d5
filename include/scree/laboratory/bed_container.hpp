#pragma once
/// \file
/// The trough that a bed of rock lies in.

#include "scree/core/error.hpp"
#include "scree/geometry/triangle_mesh.hpp"
#include "scree/walls/wall.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace scree {

/// A trough along x from 0 to `length`, between y = -width/2 and width/2, with its brim at z = 0 and the
/// floor below: flat, or shaped along x as the path of a bucket asks (Coetzee et al. 2010 Fig. 11; the
/// drawing's dimensions are not in the text).
struct BedContainer {
  /// A corner of the floor in the side view.
  struct FloorPoint {
    double x;     ///< m, from 0 to the length, ascending
    double depth; ///< m, below the brim, above 0
  };

  double length = 0.0;             ///< m, above 0
  double width = 0.0;              ///< m, above 0
  std::vector<FloorPoint> floor{}; ///< at least two points, the first at 0 and the last at the length

  /// A box of one depth [m].
  static BedContainer box(double length, double width, double depth) {
    return {length, width, {{0.0, depth}, {length, depth}}};
  }

  /// A floor that follows the parabolic path of a bucket: shallow where it enters, deepest where it has
  /// filled, and rising again in front. Holds 0.76 of the box, where the paper's saves 25 % of the particles;
  /// the numbers are ours.
  static BedContainer shaped(double length, double width, double depth) {
    return {length,
            width,
            {{0.0, 0.25 * depth}, {0.35 * length, depth}, {0.75 * length, depth}, {length, 0.15 * depth}}};
  }

  /// m.
  [[nodiscard]] double depth_at(double x) const {
    for (std::size_t k = 1; k < floor.size(); ++k) {
      if (x <= floor[k].x || k + 1 == floor.size()) {
        const double share = (x - floor[k - 1].x) / (floor[k].x - floor[k - 1].x);
        return floor[k - 1].depth + std::clamp(share, 0.0, 1.0) * (floor[k].depth - floor[k - 1].depth);
      }
    }
    return 0.0;
  }
  [[nodiscard]] double deepest() const {
    double most = 0.0;
    for (const FloorPoint& point : floor) {
      most = std::max(most, point.depth);
    }
    return most;
  }
  [[nodiscard]] double shallowest() const {
    double least = deepest();
    for (const FloorPoint& point : floor) {
      least = std::min(least, point.depth);
    }
    return least;
  }
  /// m3, up to the brim.
  [[nodiscard]] double volume() const {
    double area = 0.0;
    for (std::size_t k = 1; k < floor.size(); ++k) {
      area += 0.5 * (floor[k].depth + floor[k - 1].depth) * (floor[k].x - floor[k - 1].x);
    }
    return area * width;
  }

  /// The trough as surfaces: four planes without end, and the floor as a plane or a mesh.
  /// \throws Error for a dimension of 0 or below or a floor that does not reach from end to end.
  [[nodiscard]] std::vector<WallSurface> surfaces(MaterialId material) const {
    check();
    const Vector ahead = Vector::UnitX(), left = Vector::UnitY(), up = Vector::UnitZ();
    std::vector<WallSurface> out{{Plane{Vector::Zero(), ahead}, material},
                                 {Plane{length * ahead, -ahead}, material},
                                 {Plane{-0.5 * width * left, left}, material},
                                 {Plane{0.5 * width * left, -left}, material}};
    if (flat()) {
      out.emplace_back(Plane{-floor.front().depth * up, up}, material);
      return out;
    }
    TriangleMesh mesh;
    for (const FloorPoint& point : floor) {
      // The floor goes a little into the side walls, so that no seam is left open there.
      mesh.vertices.emplace_back(point.x, -0.55 * width, -point.depth);
      mesh.vertices.emplace_back(point.x, 0.55 * width, -point.depth);
    }
    for (std::uint32_t k = 0; k + 1 < floor.size(); ++k) {
      const std::uint32_t v = 2 * k;
      mesh.facets.push_back({v, v + 2, v + 1});
      mesh.facets.push_back({v + 1, v + 2, v + 3});
    }
    out.emplace_back(std::move(mesh), material);
    return out;
  }

private:
  [[nodiscard]] bool flat() const {
    return std::all_of(floor.begin(), floor.end(),
                       [&](const FloorPoint& p) { return p.depth == floor.front().depth; });
  }

  void check() const {
    require_positive("bed length", length, "m");
    require_positive("bed width", width, "m");
    if (floor.size() < 2 || floor.front().x != 0.0 || floor.back().x != length) {
      throw Error(message("bed floor: needs at least two points, from x = 0 to the length ", length, " m"));
    }
    for (std::size_t k = 0; k < floor.size(); ++k) {
      require_positive(message("bed floor depth ", k), floor[k].depth, "m");
      if (k > 0 && !(floor[k].x > floor[k - 1].x)) {
        throw Error(message("bed floor: x of point ", k, " must be above that of the point before"));
      }
    }
  }
};

} // namespace scree
