#pragma once
/// \file
/// A lid or plate that is pressed on the grains.

#include "scree/core/error.hpp"
#include "scree/walls/concept.hpp"

#include <functional>
#include <string>
#include <utility>

namespace scree {

/// Slides along one axis under a given force, its own weight excluded, and the reaction of the grains.
class ForceControlled {
public:
  struct Setup {
    Vector axis = -Vector::UnitZ();           ///< direction in which `force` pushes; made a unit vector
    double mass = 0.0;                        ///< kg, above 0
    std::function<double(double time)> force; ///< N, along the axis
    double damping = 0.0;                     ///< N s/m, of the actuator, 0 or above
  };

  /// \throws Error for a parameter out of range.
  explicit ForceControlled(Setup setup) : setup_{std::move(setup)} {
    require_positive("force-controlled wall: mass", setup_.mass, "kg");
    require("force-controlled wall: damping", setup_.damping, {0.0, 1e300, "N s/m"});
    if (!setup_.force || !(setup_.axis.norm() > 0.0)) {
      throw Error("force-controlled wall: needs a force and an axis with a direction");
    }
    setup_.axis.normalize();
  }

  static void start(WallMotion& motion, const TimeStep&) { motion.angular_velocity.setZero(); }

  void advance(WallMotion& motion, const WallLoad& load, const TimeStep& step) const {
    const double speed = motion.velocity.dot(setup_.axis);
    const double push = setup_.force(step.time) + load.force.dot(setup_.axis);
    // The dashpot is taken at the new speed, so that any damping is stable.
    const double next =
        (speed + step.kick * push / setup_.mass) / (1.0 + step.kick * setup_.damping / setup_.mass);
    motion.velocity = next * setup_.axis;
    motion.position += motion.velocity * step.dt;
  }

  [[nodiscard]] double mobility(double) const { return 1.0 / setup_.mass; }
  [[nodiscard]] static double squared_frequency() { return 0.0; }
  [[nodiscard]] static std::string holder() { return {}; }

  /// All of it is what it was made with.
  template <class Self, class Archive>
  static void fields(Self&, Archive&) {}

private:
  Setup setup_;
};

} // namespace scree
