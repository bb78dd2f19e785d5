#pragma once
/// \file
/// Pitch, roll and yaw of a wall body.

#include "scree/core/linear.hpp"

#include <algorithm>
#include <cmath>

namespace scree {

/// Angles [rad] of a body whose x axis points ahead, y to the left and z up.
struct Attitude {
  double pitch = 0.0; ///< positive with the nose (the teeth of a bucket) up
  double roll = 0.0;  ///< positive with the left side up
  double yaw = 0.0;   ///< positive with the nose to the left
};

inline Attitude attitude(const Quaternion& orientation) {
  const Matrix turn = orientation.toRotationMatrix();
  const Vector ahead = turn.col(0), left = turn.col(1), up = turn.col(2);
  return {std::asin(std::clamp(ahead.z(), -1.0, 1.0)), std::atan2(left.z(), up.z()),
          std::atan2(ahead.y(), ahead.x())};
}

/// The orientation that has these angles, with a pitch within a right angle of the level.
inline Quaternion orientation(const Attitude& angles) {
  return Quaternion{Eigen::AngleAxisd{angles.yaw, Vector::UnitZ()} *
                    Eigen::AngleAxisd{-angles.pitch, Vector::UnitY()} *
                    Eigen::AngleAxisd{angles.roll, Vector::UnitX()}};
}

} // namespace scree
