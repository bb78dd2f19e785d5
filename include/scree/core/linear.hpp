#pragma once
/// \file
/// Vectors, matrices and quaternions of everything outside the time-step loop: Eigen, in double.

#include "scree/core/quat.hpp"
#include "scree/core/vec3.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace scree {

using Vector = Eigen::Vector3d;
using Matrix = Eigen::Matrix3d;
/// Unit quaternion that takes body coordinates to space coordinates.
using Quaternion = Eigen::Quaterniond;

template <class T>
Vector to_eigen(const Vec3<T>& a) {
  return {static_cast<double>(a.x), static_cast<double>(a.y), static_cast<double>(a.z)};
}

template <class T = double, class Derived>
Vec3<T> to_vec3(const Eigen::MatrixBase<Derived>& a) {
  return {static_cast<T>(a.x()), static_cast<T>(a.y()), static_cast<T>(a.z())};
}

inline Quaternion to_eigen(const Quat<double>& q) {
  return {q.w, q.x, q.y, q.z};
}

inline Quat<double> to_quat(const Quaternion& q) {
  return {q.x(), q.y(), q.z(), q.w()};
}

} // namespace scree
