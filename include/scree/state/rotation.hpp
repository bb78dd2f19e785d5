#pragma once
/// \file
/// Rotation of a rigid body: the quaternion update of the paper and Euler's equations. Each is written once
/// over a number type, for plain numbers and packs of them.

#include "scree/core/linear.hpp"
#include "scree/core/numeric.hpp"

namespace scree {

/// Turns `q` by the body-frame angular velocity `w` [rad/s] held over `dt` [s]: Coetzee et al. (2010) Eqs.
/// (11)-(15), exact for constant w. With the mid-step w of a leapfrog it is of second order.
template <class T>
Quat<T> turned(const Quat<T>& q, const Vec3<T>& w, double dt) {
  const T half2 = T(0.25 * dt * dt) * squared_norm(w);
  // The series of cos and sin / angle, to rounding where a step turns the body by little: it mostly does.
  const auto one_less = [](const T& a, const T& b) { return negated_multiply_add(a, b, T(1)); };
  T cosine_half =
      one_less(half2 * T(1.0 / 2.0), one_less(half2 * T(1.0 / 12.0), one_less(half2, T(1.0 / 30.0))));
  T sinc_half =
      one_less(half2 * T(1.0 / 6.0), one_less(half2 * T(1.0 / 20.0), one_less(half2, T(1.0 / 42.0))));
  const auto far = half2 > T(4e-4);
  if (any(far)) {
    const T half = square_root(half2);
    cosine_half = select(far, cosine(half), cosine_half);
    sinc_half = select(far, sine(half) / select(far, half, T(1)), sinc_half);
  }
  const Vec3<T> v = w * (T(0.5 * dt) * sinc_half);
  const Quat<T> next = q * Quat<T>{v.x, v.y, v.z, cosine_half};
  // The product of unit quaternions drifts from unit length by rounding only.
  return next * negated_multiply_add(T(0.5), squared_norm(next), T(1.5));
}

/// Moment of a rotating body's own inertia in the principal frame, Euler's equations (the paper's Eq. (6),
/// which is misprinted): I dw/dt = M + ((I2 - I3) w2 w3, (I3 - I1) w3 w1, (I1 - I2) w1 w2).
template <class T>
Vec3<T> gyroscopic_moment(const Vec3<T>& inertia, const Vec3<T>& w) {
  return {(inertia.y - inertia.z) * w.y * w.z, (inertia.z - inertia.x) * w.z * w.x,
          (inertia.x - inertia.y) * w.x * w.y};
}

/// Kicks a mid-step angular velocity over `dt` by the moment at the step (both in the principal frame), with
/// the gyroscopic term at the mean of the old and the new value. This implicit midpoint keeps the energy and
/// the magnitude of the angular momentum of a free body; each iteration gains a factor |w| dt.
template <class T>
Vec3<T> kicked(const Vec3<T>& w, const Vec3<T>& moment, const Vec3<T>& inertia, double dt) {
  const Vec3<T> factor{T(dt) / inertia.x, T(dt) / inertia.y, T(dt) / inertia.z};
  const auto kick = [&](const Vec3<T>& m, const Vec3<T>& from) {
    return Vec3<T>{multiply_add(factor.x, m.x, from.x), multiply_add(factor.y, m.y, from.y),
                   multiply_add(factor.z, m.z, from.z)};
  };
  const Vec3<T> pushed = kick(moment, w);
  Vec3<T> next = kick(gyroscopic_moment(inertia, w), pushed);
  // Each lane ends where it would alone.
  auto open = T(0) < T(1);
  constexpr int most_iterations = 12;
  for (int iteration = 0; iteration < most_iterations && any(open); ++iteration) {
    const Vec3<T> better = kick(gyroscopic_moment(inertia, (w + next) * T(0.5)), pushed);
    const T change2 = squared_norm(better - next);
    next = {select(open, better.x, next.x), select(open, better.y, next.y), select(open, better.z, next.z)};
    open = open && change2 > T(1e-31) * squared_norm(next);
  }
  return next;
}

// The same for a body outside the time-step loop over grains.

inline Quaternion turned(const Quaternion& q, const Vector& w, double dt) {
  return to_eigen(turned(to_quat(q), to_vec3(w), dt));
}
inline Vector kicked(const Vector& w, const Vector& moment, const Vector& inertia, double dt) {
  return to_eigen(kicked(to_vec3(w), to_vec3(moment), to_vec3(inertia), dt));
}

} // namespace scree
