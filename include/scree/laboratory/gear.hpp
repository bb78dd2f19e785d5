#pragma once
/// \file
/// What may be other than it is said to be: the rig of a drag, and its load cell.

#include "scree/core/error.hpp"
#include "scree/laboratory/drag_setup.hpp"

namespace scree {

/// A rig beside what is known of it. Null by default: all factors are 1 and the offset is 0, and the drag is
/// the same to the bit.
struct Gear {
  double rope_stiffness = 1.0;   ///< times that of the setup, above 0
  double bucket_mass = 1.0;      ///< times its mass and its inertia, above 0
  double bucket_inertia = 1.0;   ///< times its inertia alone, above 0
  double floor_depth = 1.0;      ///< times the depth of the trough, above 0; its brim stays where it is
  double load_cell_gain = 1.0;   ///< force read over force, above 0
  double load_cell_offset = 0.0; ///< N, read without any force

  /// \throws Error for a factor that is not above 0.
  void check() const {
    require_positive("gear rope_stiffness", rope_stiffness);
    require_positive("gear bucket_mass", bucket_mass);
    require_positive("gear bucket_inertia", bucket_inertia);
    require_positive("gear floor_depth", floor_depth);
    require_positive("gear load_cell_gain", load_cell_gain);
    require("gear load_cell_offset", load_cell_offset, {-1e9, 1e9, "N"});
  }

  /// N, read by the load cell under a force [N].
  [[nodiscard]] double reading(double force) const { return load_cell_gain * force + load_cell_offset; }

  [[nodiscard]] DragSetup applied_to(DragSetup setup) const {
    setup.rope_stiffness *= rope_stiffness;
    setup.bed_depth *= floor_depth;
    return setup;
  }
  [[nodiscard]] BucketBody applied_to(BucketBody bucket) const {
    bucket.body.mass *= bucket_mass;
    bucket.body.inertia *= bucket_mass * bucket_inertia;
    return bucket;
  }
};

} // namespace scree
