#pragma once
/// \file
/// Quaternions and axes of any arithmetic-like type, for the time-step loop. Everything outside it uses Eigen
/// (core/linear.hpp).

#include "scree/core/vec3.hpp"

namespace scree {

/// A quaternion with its scalar part last.
template <class T>
struct Quat {
  T x = T(0), y = T(0), z = T(0), w = T(1);

  friend constexpr Quat operator*(const Quat& a, const Quat& b) {
    return {negated_multiply_add(a.z, b.y, multiply_add(a.y, b.z, multiply_add(a.x, b.w, a.w * b.x))),
            negated_multiply_add(a.x, b.z, multiply_add(a.z, b.x, multiply_add(a.y, b.w, a.w * b.y))),
            negated_multiply_add(a.y, b.x, multiply_add(a.x, b.y, multiply_add(a.z, b.w, a.w * b.z))),
            negated_multiply_add(a.z, b.z,
                                 negated_multiply_add(a.y, b.y, negated_multiply_add(a.x, b.x, a.w * b.w)))};
  }
  friend constexpr Quat operator*(const Quat& a, T s) { return {a.x * s, a.y * s, a.z * s, a.w * s}; }
};

template <class T>
constexpr T squared_norm(const Quat<T>& q) {
  return multiply_add(q.w, q.w, multiply_add(q.z, q.z, multiply_add(q.y, q.y, q.x * q.x)));
}

/// The axes of a turned frame, in space.
template <class T>
struct Axes {
  Vec3<T> x, y, z;

  [[nodiscard]] constexpr Vec3<T> to_space(const Vec3<T>& in_frame) const {
    return multiply_add(z, in_frame.z, multiply_add(y, in_frame.y, x * in_frame.x));
  }
  [[nodiscard]] constexpr Vec3<T> to_frame(const Vec3<T>& in_space) const {
    return {dot(x, in_space), dot(y, in_space), dot(z, in_space)};
  }
};

/// Of the frame that a unit quaternion takes to space.
template <class T>
constexpr Axes<T> axes_of(const Quat<T>& q) {
  const T x2 = q.x + q.x, y2 = q.y + q.y, z2 = q.z + q.z;
  const T xx = x2 * q.x, yy = y2 * q.y, zz = z2 * q.z;
  const T wx = x2 * q.w, wy = y2 * q.w, wz = z2 * q.w;
  return {{T(1) - (yy + zz), multiply_add(x2, q.y, wz), multiply_subtract(z2, q.x, wy)},
          {multiply_subtract(x2, q.y, wz), T(1) - (xx + zz), multiply_add(y2, q.z, wx)},
          {multiply_add(z2, q.x, wy), multiply_subtract(y2, q.z, wx), T(1) - (xx + yy)}};
}

} // namespace scree
