#pragma once
/// \file
/// Where a bucket has been: pitch and depth against drag.

#include "scree/core/error.hpp"
#include "scree/core/monotone_cubic.hpp"
#include "scree/laboratory/drag_pieces.hpp"

#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace scree {

/// One place of a bucket, against its rest on the bed.
struct PathPoint {
  double drag = 0.0;  ///< m, of its centre of gravity along the bed
  double pitch = 0.0; ///< rad, positive with the teeth up
  double depth = 0.0; ///< m, of its centre of gravity, positive below its rest
};

/// A smooth path through points, which goes up and down only where they do. Beyond its end it goes straight
/// on.
class BucketPath {
public:
  /// \param points four or more, by ascending drag, the first of them all null
  /// \throws Error for points that make no path.
  explicit BucketPath(const std::vector<PathPoint>& points)
      : pitch_{curve(checked(points), &PathPoint::pitch)},
        depth_{curve(points, &PathPoint::depth)},
        end_{points.back()},
        end_pitch_slope_{pitch_.prime(end_.drag)},
        end_depth_slope_{depth_.prime(end_.drag)} {}

  /// \param drag m, 0 or above
  [[nodiscard]] PathPoint at(double drag) const {
    if (drag < end_.drag) {
      return {drag, pitch_(drag), depth_(drag)};
    }
    const double beyond = drag - end_.drag;
    return {drag, end_.pitch + end_pitch_slope_ * beyond, end_.depth + end_depth_slope_ * beyond};
  }

  static constexpr double steepest = 1.5; ///< rad, of pitch, either way

  /// m, of drag, of the last point.
  [[nodiscard]] double length() const { return end_.drag; }

private:
  static const std::vector<PathPoint>& checked(const std::vector<PathPoint>& points) {
    if (points.size() < 4) {
      throw Error(message("bucket path: needs 4 points or more, not ", points.size()));
    }
    if (points.front().drag != 0.0 || points.front().pitch != 0.0 || points.front().depth != 0.0) {
      throw Error("bucket path: the first point must be the rest on the bed: drag, pitch and depth 0");
    }
    for (std::size_t k = 1; k < points.size(); ++k) {
      const PathPoint& p = points[k];
      if (!(p.drag > points[k - 1].drag) || !std::isfinite(p.drag)) {
        throw Error(message("bucket path: point ", k, ": drag = ", p.drag, " m must be above ",
                            points[k - 1].drag, " m, that of the point before"));
      }
      require(message("bucket path: point ", k, ": pitch"), p.pitch, {-steepest, steepest, "rad"});
      require(message("bucket path: point ", k, ": depth"), p.depth, {-1e3, 1e3, "m"});
    }
    return points;
  }

  static MonotoneCubic curve(const std::vector<PathPoint>& points, double PathPoint::*what) {
    std::vector<double> x, y;
    for (const PathPoint& p : points) {
      x.push_back(p.drag);
      y.push_back(p.*what);
    }
    return monotone_cubic(std::move(x), std::move(y));
  }

  MonotoneCubic pitch_, depth_;
  PathPoint end_;
  double end_pitch_slope_, end_depth_slope_;
};

/// The path that a bucket took, from the record of its drag, which begins with its rest on the bed. Where it
/// sprang back, the rows until it was further than ever before are left out.
/// \throws Error as BucketPath does.
inline BucketPath recorded_path(std::span<const DragRow> rows) {
  std::vector<PathPoint> points;
  for (const DragRow& row : rows) {
    if (points.empty() || row.drag > points.back().drag) {
      points.push_back({row.drag, row.pitch, row.depth});
    }
  }
  return BucketPath{points};
}

} // namespace scree
