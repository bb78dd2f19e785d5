#pragma once
/// \file
/// A wall that stays where it is.

#include "scree/walls/concept.hpp"

namespace scree {

struct Fixed {
  static void start(WallMotion& motion, const TimeStep&) {
    motion.velocity.setZero();
    motion.angular_velocity.setZero();
  }
  static void advance(WallMotion&, const WallLoad&, const TimeStep&) {}
};

} // namespace scree
