#pragma once
/// \file
/// What is said of a simulation that has left all bounds.

#include "scree/core/error.hpp"
#include "scree/state/bodies.hpp"

#include <cmath>
#include <cstddef>

namespace scree::detail {

/// Names the body that is worst off, at `time` [s].
/// \throws Trouble always.
template <class Real>
[[noreturn]] void report_runaway(const Bodies<Real>& bodies, double time) {
  std::size_t worst = 0;
  double most = -1.0;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const double size =
        bodies.velocity(b).cwiseAbs().maxCoeff() + bodies.angular_velocity(b).cwiseAbs().maxCoeff();
    if (!(size <= most)) {
      worst = b;
      most = size;
      if (!std::isfinite(size)) {
        break;
      }
    }
  }
  throw Trouble(message("body ", bodies.id(worst),
                        " has a velocity that is not a number or beyond all bounds at t = ", time,
                        " s: a time step too long, an initial overlap or a stiffness out of proportion"));
}

} // namespace scree::detail
