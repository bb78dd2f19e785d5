#pragma once
/// \file
/// Rotation of a rigid body: the quaternion update of the paper and Euler's equations.

#include "scree/core/linear.hpp"

#include <cmath>

namespace scree {

/// Turns `q` by the body-frame angular velocity `w` [rad/s] held over `dt` [s]: Coetzee et al. (2010) Eqs. (11)-(15),
/// exact for constant w. With the mid-step w of a leapfrog it is of second order.
inline Quaternion turned(const Quaternion& q, const Vector& w, double dt) {
  const double half = 0.5 * dt * w.norm();
  // sinc(half) by its series where the quotient would lose digits.
  const double sinc = half < 1e-4 ? 1.0 - half * half / 6.0 : std::sin(half) / half;
  const Vector v = (0.5 * dt * sinc) * w;
  const Quaternion turn{std::cos(half), v.x(), v.y(), v.z()};
  Quaternion next = q * turn;
  // The product of unit quaternions drifts from unit length by rounding only.
  next.normalize();
  return next;
}

/// Angular acceleration in the principal frame, Euler's equations (the paper's Eq. (6), which is misprinted):
/// I dw/dt = M + ((I2 - I3) w2 w3, (I3 - I1) w3 w1, (I1 - I2) w1 w2).
inline Vector euler_acceleration(const Vector& moment, const Vector& inertia, const Vector& w) {
  const Vector gyroscopic{(inertia.y() - inertia.z()) * w.y() * w.z(),
                          (inertia.z() - inertia.x()) * w.z() * w.x(),
                          (inertia.x() - inertia.y()) * w.x() * w.y()};
  return (moment + gyroscopic).cwiseQuotient(inertia);
}

/// Kicks a mid-step angular velocity over `dt` by the moment at the step (both in the principal frame), with the
/// gyroscopic term at the mean of the old and the new value. This implicit midpoint keeps the energy and the
/// magnitude of the angular momentum of a free body; four iterations reach rounding for |w| dt below 0.01.
inline Vector kicked(const Vector& w, const Vector& moment, const Vector& inertia, double dt) {
  Vector next = w + dt * euler_acceleration(moment, inertia, w);
  for (int iteration = 0; iteration < 4; ++iteration) {
    next = w + dt * euler_acceleration(moment, inertia, 0.5 * (w + next));
  }
  return next;
}

} // namespace scree
