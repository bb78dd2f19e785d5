#pragma once
/// \file
/// The library's own bucket as a rigid body.

#include "scree/geometry/dragline_bucket.hpp"
#include "scree/laboratory/drag_setup.hpp"

namespace scree {

/// Its mass is that of the detailed bucket, whatever surface it has.
/// \throws Error for a dimension out of its range.
inline BucketBody bucket_body(const DraglineBucket& shape = {},
                              BucketDetail detail = BucketDetail::simplified) {
  return {make_dragline_bucket(shape, detail), bucket_interior(shape), hitch_points(shape),
          estimated_from_plates(shape)};
}

} // namespace scree
