#pragma once
/// \file
/// The parts that a dragline bucket is made of, as closed shells: body, teeth, ears, arch and rail.

#include "scree/core/linear.hpp"
#include "scree/geometry/dragline_bucket_dimensions.hpp"
#include "scree/geometry/mesh_weld.hpp"
#include "scree/geometry/tessellation.hpp"
#include "scree/geometry/triangle_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

namespace scree {

/// How finely the bucket is modelled, after Fig. 12 of the paper.
enum class BucketDetail {
  simplified, ///< about 520 facets: sharp corners inside and outside, no arch, no rail
  detailed,   ///< about 5000 facets: with fillets, arch and rail
};

namespace detail {

using tessellation::Grid;
using tessellation::Polyline;

/// Numbers of facets along the parts of a bucket.
struct BucketTessellation {
  std::size_t bevel, lip, floor, half_heel, back; ///< along the side view, from lip to rim
  std::size_t half_width;                         ///< from the middle to a cheek
  std::size_t fillet;                             ///< across a fillet, 0 for a sharp corner
  std::size_t tooth;                              ///< along and across half a tooth
  std::size_t ear;                                ///< around the ear's round end, even

  /// Cells of the cheek's grid along the floor up to the middle of the heel, and along the back.
  [[nodiscard]] std::size_t along_floor() const { return bevel + lip + floor + half_heel; }
  [[nodiscard]] std::size_t along_back() const { return half_heel + back; }
};

inline BucketTessellation bucket_tessellation(BucketDetail level) {
  if (level == BucketDetail::simplified) {
    return {1, 1, 2, 2, 1, 2, 0, 1, 4};
  }
  return {3, 3, 5, 4, 5, 6, 3, 3, 12};
}

/// A point of the side view, where the plate of floor and back is built up from the outside to the inside.
struct BucketStation {
  Vector outside;   ///< at y = 0
  Vector inward;    ///< in the plane y = 0, to the inside; the inside is thickness * inward away
  double thickness; ///< m
};

/// Floor and back from the lip to the rim.
inline std::vector<BucketStation> bucket_stations(const DraglineBucket& b, const BucketTessellation& cells) {
  const double t = b.plate_thickness;
  const double r = b.heel_radius;
  const double turn = 0.5 * std::numbers::pi - b.back_rake;
  const Vector up = Vector::UnitZ();
  // At the two ends the inside is offset within the planes of mouth and rim, so that those cut all plates
  // flush. Towards the heel the direction turns into the normal of floor or back.
  const Vector in_mouth{-std::tan(b.mouth_rake), 0.0, 1.0};
  const Vector in_rim{1.0 / std::cos(b.back_rake), 0.0, 0.0};
  const Vector heel_centre{b.height * std::tan(b.back_rake) + r * std::tan(0.5 * turn), 0.0, r};

  std::vector<BucketStation> stations{{{b.length, 0.0, 0.0}, in_mouth, b.lip_edge}};
  const auto add_floor = [&](double to_x, double to_thickness, std::size_t count) {
    const auto start = stations.back();
    for (std::size_t i = 1; i <= count; ++i) {
      const double s = static_cast<double>(i) / static_cast<double>(count);
      const double x = (1.0 - s) * start.outside.x() + s * to_x;
      const double from_lip = (b.length - x) / (b.length - heel_centre.x());
      stations.push_back({{x, 0.0, 0.0},
                          (1.0 - from_lip) * in_mouth + from_lip * up,
                          (1.0 - s) * start.thickness + s * to_thickness});
    }
  };
  add_floor(b.length - b.lip_bevel, b.lip_thickness, cells.bevel);
  add_floor(b.length - b.lip_length, t, cells.lip);
  add_floor(heel_centre.x(), t, cells.floor);
  for (std::size_t i = 1; i <= 2 * cells.half_heel; ++i) {
    const double angle = turn * static_cast<double>(i) / static_cast<double>(2 * cells.half_heel);
    const Vector inward{std::sin(angle), 0.0, std::cos(angle)};
    stations.push_back({heel_centre - r * inward, inward, t});
  }
  const Vector back_foot = stations.back().outside;
  const Vector normal = stations.back().inward;
  const Vector rim{0.0, 0.0, b.height};
  for (std::size_t i = 1; i <= cells.back; ++i) {
    const double s = static_cast<double>(i) / static_cast<double>(cells.back);
    stations.push_back({(1.0 - s) * back_foot + s * rim, (1.0 - s) * normal + s * in_rim, t});
  }
  return stations;
}

/// The half at y >= 0 of one side of the bucket's body, without thickness: floor and back, and a cheek.
struct BucketSkin {
  Grid rows;            ///< floor and back: rows from the middle to the cheek, from the lip to the back's rim
  Polyline mouth;       ///< the cheek's front edge, from the floor to the rim
  Polyline rim;         ///< the cheek's rim, from the mouth to the back
  TriangleMesh surface; ///< seen from outside

  /// All of the skin's border but the cut at y = 0, from the lip round to the back's rim.
  [[nodiscard]] Polyline border() const {
    Polyline back_rim = rows.back();
    std::reverse(back_rim.begin(), back_rim.end());
    return tessellation::joined(tessellation::joined(tessellation::joined(rows.front(), mouth), rim),
                                back_rim);
  }
};

/// \param share of the plate's thickness at which the skin lies: 0 is the outside, 1 the inside.
/// \param half_width m, y of the cheek.
/// \param fillet m, radius of the corner between the cheek and floor or back.
inline BucketSkin bucket_skin(const DraglineBucket& b, const BucketTessellation& cells, double share,
                              double half_width, double fillet) {
  namespace tess = tessellation;
  BucketSkin skin;
  for (const auto& station : bucket_stations(b, cells)) {
    const Vector foot = station.outside + share * station.thickness * station.inward;
    auto row = tess::line(foot, foot + (half_width - fillet) * Vector::UnitY(), cells.half_width);
    const Vector corner = row.back();
    for (std::size_t i = 1; i <= cells.fillet; ++i) {
      const double angle =
          0.5 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(cells.fillet);
      row.push_back(corner +
                    fillet * (std::sin(angle) * Vector::UnitY() + (1.0 - std::cos(angle)) * station.inward));
    }
    skin.rows.push_back(std::move(row));
  }

  const std::size_t n = cells.along_floor();
  Polyline floor;
  Polyline back;
  for (std::size_t i = 0; i < skin.rows.size(); ++i) {
    if (i <= n) {
      floor.push_back(skin.rows[i].back());
    }
    if (i >= n) {
      back.push_back(skin.rows[i].back());
    }
  }
  const Vector front{b.length - b.height * std::tan(b.mouth_rake), half_width, b.height};
  skin.mouth = tess::line(floor.front(), front, cells.along_back());
  skin.rim = tess::line(front, back.back(), n);
  // Rows from the floor up and along -x, so that both grids show their outer side.
  tess::add_grid(skin.surface, tess::coons_patch(floor, skin.rim, skin.mouth, back));
  Grid columns(skin.rows.front().size());
  for (const auto& row : skin.rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      columns[i].push_back(row[i]);
    }
  }
  tess::add_grid(skin.surface, columns);
  return skin;
}

/// Side lengths are far above it, coordinates' rounding far below.
inline double weld_tolerance(const DraglineBucket& b) {
  return 1e-9 * b.width;
}

/// Floor, lip, back and cheeks as one solid.
inline TriangleMesh bucket_body(const DraglineBucket& b, const BucketTessellation& cells) {
  const double t = b.plate_thickness;
  const bool filleted = cells.fillet > 0;
  const auto outer = bucket_skin(b, cells, 0.0, 0.5 * b.width, filleted ? b.fillet_radius + t : 0.0);
  const auto inner = bucket_skin(b, cells, 1.0, 0.5 * b.width - t, filleted ? b.fillet_radius : 0.0);
  TriangleMesh half = outer.surface;
  tessellation::append(half, tessellation::turned(inner.surface));
  tessellation::add_strip(half, outer.border(), inner.border());
  return tessellation::symmetric_shell(std::move(half), weld_tolerance(b));
}

/// A wedge that grows out of the lip around y = 0: from inside the lip's thick part to the tip.
inline TriangleMesh bucket_tooth(const DraglineBucket& b, const BucketTessellation& cells) {
  namespace tess = tessellation;
  // Its underside lies within the lip's edge, so that no two faces are in one plane.
  const double under = 0.5 * b.lip_edge;
  const double rear = b.length - b.lip_bevel;
  const double tip = b.length + b.tooth_length;
  const auto half_width = [&](double x) {
    const double s = (x - b.length) / b.tooth_length;
    return 0.5 * (b.tooth_width + s * (b.tooth_tip_width - b.tooth_width));
  };
  const Polyline corners{{rear, 0.0, under},
                         {tip, 0.0, under},
                         {tip, 0.0, under + b.tooth_tip_height},
                         {b.length, 0.0, under + b.tooth_height}};
  // The sides of the view, each divided by its length.
  Polyline view;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vector& from = corners[i];
    const Vector& to = corners[(i + 1) % corners.size()];
    const auto count = std::abs(to.x() - from.x()) > 0.3 * b.tooth_length ? cells.tooth : 1;
    const auto side = tess::line(from, to, count);
    view.insert(view.end(), side.begin(), side.end() - 1);
  }
  const auto at_share = [&](double share) {
    Polyline moved = view;
    for (auto& p : moved) {
      p.y() = share * half_width(p.x());
    }
    return moved;
  };
  // The view runs clockwise as seen from +y.
  TriangleMesh half;
  for (std::size_t i = 0; i < cells.tooth; ++i) {
    const auto count = static_cast<double>(cells.tooth);
    auto from = at_share(static_cast<double>(i) / count);
    auto to = at_share(static_cast<double>(i + 1) / count);
    from.push_back(from.front());
    to.push_back(to.front());
    tess::add_strip(half, to, from);
  }
  auto side = at_share(1.0);
  std::reverse(side.begin(), side.end());
  const double middle_x = b.length + 0.2 * b.tooth_length;
  const Vector middle{middle_x, half_width(middle_x), under + 0.4 * b.tooth_height};
  tess::add_fan(half, middle, side);
  // Leaned down from where the tooth leaves the lip.
  const double slope = std::tan(b.tooth_angle);
  for (Vector& v : half.vertices) {
    v.z() -= slope * (v.x() - rear);
  }
  return tess::symmetric_shell(std::move(half), weld_tolerance(b));
}

/// The left ear: a plate in the cheek's plane that reaches forward from the cheek to the hitch point.
inline TriangleMesh bucket_ear(const DraglineBucket& b, const BucketTessellation& cells) {
  namespace tess = tessellation;
  const double r = b.hitch_radius;
  // Thinner than the cheek, so that its rear end is wholly within the cheek.
  const double half_thickness = 0.4 * b.plate_thickness;
  const double y = 0.5 * (b.width - b.plate_thickness);
  const auto cheek_front = [&](double z) { return b.length - z * std::tan(b.mouth_rake); };
  const Vector centre{cheek_front(b.hitch_height) + b.hitch_reach - r, y, b.hitch_height};
  const double low = b.hitch_height - r;
  const double high = b.hitch_height + r;

  Polyline view; // from +z towards +x
  view.push_back({cheek_front(high) - 0.5 * r, y, high});
  for (std::size_t i = 0; i <= cells.ear; ++i) {
    const double angle = std::numbers::pi * static_cast<double>(i) / static_cast<double>(cells.ear);
    view.push_back(centre + r * Vector{std::sin(angle), 0.0, std::cos(angle)});
  }
  view.push_back({cheek_front(low) - 0.5 * r, y, low});

  const auto moved = [&view](double by) {
    Polyline points = view;
    for (auto& p : points) {
      p.y() += by;
    }
    return points;
  };
  TriangleMesh ear;
  auto left = moved(half_thickness);
  auto right = moved(-half_thickness);
  tess::add_fan(ear, centre + half_thickness * Vector::UnitY(), left);
  TriangleMesh right_side;
  tess::add_fan(right_side, centre - half_thickness * Vector::UnitY(), right);
  tess::append(ear, tess::turned(std::move(right_side)));
  left.push_back(left.front());
  right.push_back(right.front());
  tess::add_strip(ear, right, left);
  return weld(ear, weld_tolerance(b));
}

/// A round bar that follows a plane path from y = 0, where it is open, to its capped end. The normal of the
/// path's plane is `binormal`.
inline TriangleMesh half_bar(const Polyline& path, const Vector& binormal, double radius,
                             std::size_t around) {
  Grid rings;
  for (std::size_t i = 0; i < path.size(); ++i) {
    // At y = 0 the bar meets its mirror image, so that its section lies in that plane.
    const Vector before = i == 0 ? Vector{path[1].x(), -path[1].y(), path[1].z()} : path[i - 1];
    const Vector after = i + 1 == path.size() ? path[i] : path[i + 1];
    const Vector tangent = (after - before).normalized();
    const Vector normal = binormal.cross(tangent);
    Polyline ring;
    for (std::size_t k = 0; k < around; ++k) {
      // Offset by half a step, so that no vertex lies in the plane of the path, where the plates' edges are.
      const double angle =
          2.0 * std::numbers::pi * (static_cast<double>(k) + 0.5) / static_cast<double>(around);
      ring.push_back(path[i] + radius * (std::cos(angle) * normal + std::sin(angle) * binormal));
    }
    rings.push_back(std::move(ring));
  }
  TriangleMesh half;
  tessellation::add_fan(half, path.back(), rings.back());
  for (auto& ring : rings) {
    ring.push_back(ring.front());
  }
  tessellation::add_grid(half, rings);
  return half;
}

/// Where the arch stands on the cheeks' rim.
inline double arch_position(const DraglineBucket& b) {
  return b.length - b.height * std::tan(b.mouth_rake) - 1.5 * b.arch_radius;
}

/// A half ellipse over the mouth, from cheek to cheek; its ends enclose the rim.
inline TriangleMesh bucket_arch(const DraglineBucket& b) {
  constexpr std::size_t steps = 14;
  const double half_span = 0.5 * (b.width - b.plate_thickness);
  Polyline path;
  for (std::size_t i = 0; i <= steps; ++i) {
    const double angle = 0.5 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(steps);
    path.push_back({arch_position(b), half_span * std::sin(angle), b.height + b.arch_rise * std::cos(angle)});
  }
  path.push_back(path.back() - 1.5 * b.arch_radius * Vector::UnitZ());
  return tessellation::symmetric_shell(half_bar(path, Vector::UnitX(), b.arch_radius, 12), weld_tolerance(b));
}

/// A bar around the rim of cheeks and back, as far as the arch.
inline TriangleMesh bucket_rail(const DraglineBucket& b) {
  namespace tess = tessellation;
  constexpr std::size_t across = 5;
  constexpr std::size_t around_corner = 5;
  constexpr std::size_t along = 7;
  const double y = 0.5 * (b.width - b.plate_thickness);
  const double bend = b.fillet_radius + 0.5 * b.plate_thickness;
  // In the plane of the rim the back's plate is cut aslant.
  const double stretch = 1.0 / std::cos(b.back_rake);
  const double x = 0.5 * b.plate_thickness * stretch;
  Polyline path = tess::line({x, 0.0, b.height}, {x, y - bend, b.height}, across);
  for (std::size_t i = 1; i <= around_corner; ++i) {
    const double angle = 0.5 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(around_corner);
    path.push_back(
        {x + bend * stretch * (1.0 - std::cos(angle)), y - bend * (1.0 - std::sin(angle)), b.height});
  }
  path = tess::joined(path, tess::line(path.back(), {arch_position(b), y, b.height}, along));
  return tess::symmetric_shell(half_bar(path, Vector::UnitZ(), b.rail_radius, 8), weld_tolerance(b));
}

} // namespace detail

} // namespace scree
