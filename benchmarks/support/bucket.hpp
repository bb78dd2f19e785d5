#pragma once
/// \file
/// The bucket that benchmarks drag.

#include "scree/geometry/dragline_bucket.hpp"
#include "scree/laboratory/drag_setup.hpp"

namespace scree::benchmarks {

/// The one of the example `drag`.
inline BucketBody bucket() {
  const DraglineBucket shape;
  return {make_dragline_bucket(shape, BucketDetail::simplified), bucket_interior(shape), hitch_points(shape),
          estimated_from_plates(shape)};
}

} // namespace scree::benchmarks
