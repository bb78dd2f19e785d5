#pragma once
/// \file
/// Bed, bucket and rig of a drag as parameters of a program.

#include "scree/geometry/dragline_bucket.hpp"
#include "scree/laboratory/drag_setup.hpp"
#include "support/options.hpp"

#include <string>
#include <vector>

namespace scree::examples {

/// Rock and material of the setup are not among them: these are for programs to say.
class Dragline {
public:
  explicit Dragline(bool desk);

  DragSetup setup;

  /// Adds `bed.NAME`, `bucket.NAME` and `rig.NAME` to a program.
  void bind(Options& options);

  /// The bucket as described, and words on what was assumed of it.
  /// \throws Error for a bucket that cannot be read, or whose interior is not closed.
  BucketBody bucket(std::vector<std::string>& remarks) const;

private:
  Provenance paper_in_lab_;
  DraglineBucket shape_;
  std::string stl_, interior_stl_, detail_ = "simplified";
  double stl_scale_ = 1.0, stl_weld_ = 1e-6;
  std::vector<double> hitch_left_, hitch_right_;
  double mass_ = 0.0;
  std::vector<double> centre_{0.0, 0.0, 0.0}, inertia_{0.0, 0.0, 0.0};
};

} // namespace scree::examples
