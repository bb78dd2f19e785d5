#pragma once
/// \file
/// A wall whose motion is known beforehand.

#include "scree/core/error.hpp"
#include "scree/walls/concept.hpp"

#include <functional>
#include <utility>

namespace scree {

/// Where a wall's frame is.
struct Pose {
  Vector position = Vector::Zero();                ///< m
  Quaternion orientation = Quaternion::Identity(); ///< wall frame to space
};

/// Follows any function of time. The velocity between two steps is that which takes one pose to the next, so
/// that no derivative has to be given and pose and velocity never disagree.
class Prescribed {
public:
  using Path = std::function<Pose(double time)>;

  explicit Prescribed(Path path) : path_{std::move(path)} {}

  /// Moves at a constant velocity [m/s] from `start`.
  static Prescribed constant_velocity(const Vector& velocity, const Pose& start = {}) {
    return Prescribed{[=](double time) { return Pose{start.position + velocity * time, start.orientation}; }};
  }
  /// Turns about an axis through `centre` [m] at a constant angular velocity [rad/s].
  static Prescribed constant_rotation(const Vector& angular_velocity, const Vector& centre = Vector::Zero()) {
    return Prescribed{[=](double time) {
      const double rate = angular_velocity.norm();
      const Vector axis = rate > 0.0 ? Vector(angular_velocity / rate) : Vector(Vector::UnitZ());
      const Quaternion turn{Eigen::AngleAxisd{rate * time, axis}};
      return Pose{centre - turn * centre, turn};
    }};
  }

  void start(WallMotion& motion, const TimeStep& step) const {
    const Pose now = at(step.time);
    motion.position = now.position;
    motion.orientation = now.orientation;
    set_velocity(motion, at(step.time + step.dt), step.dt);
  }

  void advance(WallMotion& motion, const WallLoad&, const TimeStep& step) const {
    const Pose next = at(step.time + step.dt);
    set_velocity(motion, next, step.dt);
    motion.position = next.position;
    motion.orientation = next.orientation;
  }

  /// The path is the one that it was made with.
  template <class Self, class Archive>
  static void fields(Self&, Archive&) {}

private:
  [[nodiscard]] Pose at(double time) const {
    Pose pose = path_(time);
    if (!pose.position.allFinite() || !pose.orientation.coeffs().allFinite()) {
      throw Error(message("prescribed wall: the path is not a number at t = ", time, " s"));
    }
    pose.orientation.normalize();
    return pose;
  }

  static void set_velocity(WallMotion& motion, const Pose& next, double dt) {
    motion.velocity = (next.position - motion.position) / dt;
    const Eigen::AngleAxisd turn{next.orientation * motion.orientation.conjugate()};
    motion.angular_velocity = turn.axis() * (turn.angle() / dt);
  }

  Path path_;
};

} // namespace scree
