#pragma once
/// \file
/// Rotation of a rigid body: the quaternion update of the paper and Euler's equations.

#include "scree/core/linear.hpp"

#include <cmath>

namespace scree {

/// Turns `q` by the body-frame angular velocity `w` [rad/s] held over `dt` [s]: Coetzee et al. (2010) Eqs.
/// (11)-(15), exact for constant w. With the mid-step w of a leapfrog it is of second order.
inline Quaternion turned(const Quaternion& q, const Vector& w, double dt) {
  const double half2 = 0.25 * dt * dt * w.squaredNorm();
  double cosine = 0.0, sinc = 0.0;
  if (half2 < 4e-4) {
    // Their series, to rounding: a time step turns a grain by far less than this.
    cosine = 1.0 - half2 / 2.0 * (1.0 - half2 / 12.0 * (1.0 - half2 / 30.0));
    sinc = 1.0 - half2 / 6.0 * (1.0 - half2 / 20.0 * (1.0 - half2 / 42.0));
  } else {
    const double half = std::sqrt(half2);
    cosine = std::cos(half);
    sinc = std::sin(half) / half;
  }
  const Vector v = (0.5 * dt * sinc) * w;
  const Quaternion turn{cosine, v.x(), v.y(), v.z()};
  Quaternion next = q * turn;
  // The product of unit quaternions drifts from unit length by rounding only.
  next.coeffs() *= 1.5 - 0.5 * next.squaredNorm();
  return next;
}

/// Moment of a rotating body's own inertia in the principal frame, Euler's equations (the paper's Eq. (6),
/// which is misprinted): I dw/dt = M + ((I2 - I3) w2 w3, (I3 - I1) w3 w1, (I1 - I2) w1 w2).
inline Vector gyroscopic_moment(const Vector& inertia, const Vector& w) {
  return {(inertia.y() - inertia.z()) * w.y() * w.z(), (inertia.z() - inertia.x()) * w.z() * w.x(),
          (inertia.x() - inertia.y()) * w.x() * w.y()};
}

/// Kicks a mid-step angular velocity over `dt` by the moment at the step (both in the principal frame), with
/// the gyroscopic term at the mean of the old and the new value. This implicit midpoint keeps the energy and
/// the magnitude of the angular momentum of a free body; each iteration gains a factor |w| dt.
inline Vector kicked(const Vector& w, const Vector& moment, const Vector& inertia, double dt) {
  const Vector factor = dt * inertia.cwiseInverse();
  const Vector pushed = w + factor.cwiseProduct(moment);
  Vector next = pushed + factor.cwiseProduct(gyroscopic_moment(inertia, w));
  constexpr int most_iterations = 12;
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    const Vector better = pushed + factor.cwiseProduct(gyroscopic_moment(inertia, 0.5 * (w + next)));
    const double change2 = (better - next).squaredNorm();
    next = better;
    if (!(change2 > 1e-31 * next.squaredNorm())) {
      break;
    }
  }
  return next;
}

} // namespace scree
