#pragma once
/// \file
/// What a bucket holds.

#include "scree/geometry/mesh_measures.hpp"
#include "scree/state/bodies.hpp"
#include "scree/state/wall_motion.hpp"

#include <cstddef>
#include <utility>

namespace scree {

struct BucketFill {
  double struck =
      0.0; ///< kg, of bodies whose centre lies in the interior, closed level at the rim and at the mouth
  double heaped = 0.0;    ///< kg, those and the ones heaped on them, above the rim
  std::size_t bodies = 0; ///< in `heaped`
};

/// Counts bodies by their centres against the closed interior of a bucket, as the paper does (section 7).
class BucketGauge {
public:
  /// `interior`: closed mesh in the frame of the bucket, z up. A heap is counted up to `heap_height` [m]
  /// above it.
  BucketGauge(TriangleMesh interior, double heap_height)
      : interior_{std::move(interior)}, box_{bounding_box(interior_)}, heap_height_{heap_height} {}

  template <class Real>
  [[nodiscard]] BucketFill operator()(const Bodies<Real>& bodies, const WallMotion& bucket) const {
    BucketFill fill;
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      const Vector at = bucket.to_wall(bodies.position(b));
      if (holds(at)) {
        fill.struck += bodies.mass(b);
      } else if (!heaped_on(at)) {
        continue;
      }
      fill.heaped += bodies.mass(b);
      ++fill.bodies;
    }
    return fill;
  }

private:
  [[nodiscard]] bool holds(const Vector& at) const { return contains(interior_, box_, at); }

  /// Above the rim, over the plan of the interior just below it.
  [[nodiscard]] bool heaped_on(const Vector& at) const {
    const double rim = box_.max().z();
    return at.z() > rim && at.z() < rim + heap_height_ &&
           holds({at.x(), at.y(), rim - 1e-3 * box_.sizes().z()});
  }

  TriangleMesh interior_;
  Eigen::AlignedBox3d box_;
  double heap_height_;
};

} // namespace scree
