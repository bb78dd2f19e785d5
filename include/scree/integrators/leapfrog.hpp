#pragma once
/// \file
/// The integrator of the paper.

#include "scree/integrators/concept.hpp"
#include "scree/state/rotation.hpp"

namespace scree {

/// Leapfrog: velocities half a step from positions, orientation by the quaternion update of Coetzee et al.
/// (2010) Eqs. (11)-(15) with the mid-step angular velocity, Euler's equations by their implicit midpoint.
/// Second order. Keeps the energy of a free body; the direction of its angular momentum wanders within
/// O(dt^2).
struct Leapfrog {
  template <class T>
  static void translate(Vec3<T>& position, Vec3<T>& velocity, const Vec3<T>& acceleration,
                        const TimeStep& step) {
    velocity = multiply_add(acceleration, T(step.kick), velocity);
    position = multiply_add(velocity, T(step.dt), position);
  }

  template <class T>
  static void rotate(Quat<T>& orientation, Vec3<T>& angular_velocity, const Vec3<T>& moment,
                     const Vec3<T>& inertia, const TimeStep& step) {
    angular_velocity = kicked(angular_velocity, moment, inertia, step.kick);
    orientation = turned(orientation, angular_velocity, step.dt);
  }
};

} // namespace scree
