#pragma once
/// \file
/// Three numbers of any arithmetic-like type.
///
/// The contact kernels are written once over a number type that may be `float`, `double` or a SIMD pack, so
/// they use this plain aggregate. Everything that is not in the time-step loop uses Eigen (core/linear.hpp).

#include "scree/core/numeric.hpp"

#include <cmath>

namespace scree {

template <class T>
struct Vec3 {
  T x{}, y{}, z{};

  friend constexpr Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend constexpr Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend constexpr Vec3 operator-(const Vec3& a) { return {-a.x, -a.y, -a.z}; }
  friend constexpr Vec3 operator*(const Vec3& a, T s) { return {a.x * s, a.y * s, a.z * s}; }
  friend constexpr Vec3 operator*(T s, const Vec3& a) { return a * s; }
  constexpr Vec3& operator+=(const Vec3& b) { return *this = *this + b; }
  constexpr Vec3& operator-=(const Vec3& b) { return *this = *this - b; }
  constexpr Vec3& operator*=(T s) { return *this = *this * s; }
  friend constexpr bool operator==(const Vec3&, const Vec3&) = default;

  /// The same vector in another number type.
  template <class U>
  constexpr Vec3<U> as() const {
    return {static_cast<U>(x), static_cast<U>(y), static_cast<U>(z)};
  }
};

template <class T>
constexpr T dot(const Vec3<T>& a, const Vec3<T>& b) {
  return multiply_add(a.z, b.z, multiply_add(a.y, b.y, a.x * b.x));
}

template <class T>
constexpr Vec3<T> cross(const Vec3<T>& a, const Vec3<T>& b) {
  return {negated_multiply_add(a.z, b.y, a.y * b.z), negated_multiply_add(a.x, b.z, a.z * b.x),
          negated_multiply_add(a.y, b.x, a.x * b.y)};
}

/// v s + c, each component rounded like that of a number.
template <class T>
constexpr Vec3<T> multiply_add(const Vec3<T>& v, const T& s, const Vec3<T>& c) {
  return {multiply_add(v.x, s, c.x), multiply_add(v.y, s, c.y), multiply_add(v.z, s, c.z)};
}

/// c - v s, likewise.
template <class T>
constexpr Vec3<T> negated_multiply_add(const Vec3<T>& v, const T& s, const Vec3<T>& c) {
  return {negated_multiply_add(v.x, s, c.x), negated_multiply_add(v.y, s, c.y),
          negated_multiply_add(v.z, s, c.z)};
}

template <class T>
constexpr T squared_norm(const Vec3<T>& a) {
  return dot(a, a);
}

template <class T>
T norm(const Vec3<T>& a) {
  using std::sqrt;
  return sqrt(dot(a, a));
}

} // namespace scree
