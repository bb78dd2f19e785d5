#pragma once
/// \file
/// Work that left the motion of the bodies.

#include "scree/core/linear.hpp"

#include <cstddef>

namespace scree {

/// J, since the start.
struct Dissipation {
  double friction = 0.0;      ///< sliding and rolling
  double viscous = 0.0;       ///< dashpots
  double local_damping = 0.0; ///< non-viscous damping
  double resting = 0.0;       ///< what was left of the motion of bodies that were put to rest

  [[nodiscard]] double total() const { return friction + viscous + local_damping + resting; }
  Dissipation& operator+=(const Dissipation& other) {
    friction += other.friction;
    viscous += other.viscous;
    local_damping += other.local_damping;
    resting += other.resting;
    return *this;
  }
};

/// What one block finds of one wall in a step.
struct WallSum {
  Vector force = Vector::Zero();
  Vector moment = Vector::Zero();
  std::size_t contacts = 0;
};

} // namespace scree
