#pragma once
/// \file
/// Where a wall body is, how it moves, and what acts on it.

#include "scree/core/linear.hpp"

#include <cstddef>

namespace scree {

/// Pose and velocity of the frame that a wall's surfaces are given in.
struct WallMotion {
  Vector position = Vector::Zero();                ///< m, origin of the wall's frame
  Quaternion orientation = Quaternion::Identity(); ///< wall frame to space
  Vector velocity = Vector::Zero();                ///< m/s, of the origin
  Vector angular_velocity = Vector::Zero();        ///< rad/s, in space

  [[nodiscard]] Vector to_space(const Vector& in_wall) const { return position + orientation * in_wall; }
  [[nodiscard]] Vector to_wall(const Vector& in_space) const {
    return orientation.conjugate() * (in_space - position);
  }
  /// m/s, of the material point of the wall that is at `point` (in space).
  [[nodiscard]] Vector velocity_at(const Vector& point) const {
    return velocity + angular_velocity.cross(point - position);
  }

  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {
    archive(self.position, self.orientation, self.velocity, self.angular_velocity);
  }
};

/// What the grains do to a wall body.
struct WallLoad {
  Vector force = Vector::Zero();           ///< N, in the last step
  Vector moment = Vector::Zero();          ///< N m, about the origin of the wall's frame, in the last step
  Vector impulse = Vector::Zero();         ///< N s, force summed over time since the start
  Vector angular_impulse = Vector::Zero(); ///< N m s, moment summed over time since the start
  double work = 0.0;                       ///< J, done by the wall on the grains since the start
  std::size_t contacts = 0;                ///< in the last step

  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {
    archive(self.force, self.moment, self.impulse, self.angular_impulse, self.work, self.contacts);
  }
};

/// One step of time, as integrators and wall bodies see it.
struct TimeStep {
  double time = 0.0; ///< s, at which the forces were taken
  double dt = 0.0;   ///< s, by which positions advance
  double kick = 0.0; ///< s, by which velocities advance: dt, and dt/2 in the first step of a leapfrog
  Vector gravity = Vector::Zero(); ///< m/s2
};

} // namespace scree
