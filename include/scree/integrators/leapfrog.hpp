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
  template <class Real>
  static void translate(Vec3<double>& position, Vec3<Real>& velocity, const Vec3<Real>& acceleration,
                        const TimeStep& step) {
    velocity += acceleration * static_cast<Real>(step.kick);
    position += velocity.template as<double>() * step.dt;
  }

  static void rotate(Quaternion& orientation, Vector& angular_velocity, const Vector& moment,
                     const Vector& inertia, const TimeStep& step) {
    angular_velocity = kicked(angular_velocity, moment, inertia, step.kick);
    orientation = turned(orientation, angular_velocity, step.dt);
  }
};

} // namespace scree
