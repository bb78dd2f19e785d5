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
    return {a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y + a.y * b.w + a.z * b.x - a.x * b.z,
            a.w * b.z + a.z * b.w + a.x * b.y - a.y * b.x, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
  }
  friend constexpr Quat operator*(const Quat& a, T s) { return {a.x * s, a.y * s, a.z * s, a.w * s}; }
};

template <class T>
constexpr T squared_norm(const Quat<T>& q) {
  return q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
}

/// The axes of a turned frame, in space.
template <class T>
struct Axes {
  Vec3<T> x, y, z;

  [[nodiscard]] constexpr Vec3<T> to_space(const Vec3<T>& in_frame) const {
    return x * in_frame.x + y * in_frame.y + z * in_frame.z;
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
  const T xy = x2 * q.y, yz = y2 * q.z, zx = z2 * q.x;
  const T wx = x2 * q.w, wy = y2 * q.w, wz = z2 * q.w;
  return {{T(1) - (yy + zz), xy + wz, zx - wy},
          {xy - wz, T(1) - (xx + zz), yz + wx},
          {zx + wy, yz - wx, T(1) - (xx + yy)}};
}

} // namespace scree
