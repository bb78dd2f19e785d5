#pragma once
/// \file
/// The path of a bucket of which the pitch alone is known.

#include "scree/core/error.hpp"
#include "scree/laboratory/bucket_path.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace scree {

/// The floor of a bucket in the side view, against its centre of gravity.
struct BucketFloor {
  double heel;      ///< m, x of the rear end of the flat floor
  double lip;       ///< m, x of its front end, above that of the heel
  double underside; ///< m, z, below 0
};

/// A bucket that digs with its lip and rides on its heel: what the lip has cut away, the heel comes to one
/// length of the floor later and lies on; before, it lies on the surface of the bed. While the lip is above
/// the bed it leaves the surface as it is. So the depth follows from the pitch: with a pitch that stays as
/// it is, the bucket goes along its own floor. Ours; rock that is pushed ahead of the lip or
/// yields below the heel is not thought of.
/// \param pitch `double pitch(double drag)`: rad, positive with the teeth up, 0 at drag 0
/// \param distance m, of drag, above 0, that the path reaches or exceeds
/// \throws Error for a lip that is not ahead of the heel, or as BucketPath does.
template <class Pitch>
BucketPath digging_path(const Pitch& pitch, double distance, const BucketFloor& floor) {
  require_positive("drag distance", distance, "m");
  const double length =
      require_positive("floor of the bucket: lip ahead of heel", floor.lip - floor.heel, "m");
  constexpr std::size_t cells = 20; // from heel to lip
  const double step = length / static_cast<double>(cells);
  const auto steps = std::max(cells, static_cast<std::size_t>(std::ceil(distance / step)));
  std::vector<double> ground(steps + cells + 1, 0.0); // m, height below the bucket's way, from the heel on
  std::vector<PathPoint> points;
  for (std::size_t k = 0; k <= steps; ++k) {
    const double drag = static_cast<double>(k) * step;
    const double angle = pitch(drag);
    ground[k + cells] = std::min(0.0, ground[k] + length * std::sin(angle));
    const double rise = ground[k] - floor.heel * std::sin(angle) + floor.underside * (1.0 - std::cos(angle));
    points.push_back({drag, angle, -rise});
  }
  return BucketPath{points};
}

} // namespace scree
