#pragma once
/// \file
/// The few operations that a contact law needs beside arithmetic, so that one source serves a plain number
/// and a pack of them: a pack type brings its own overloads, found by argument-dependent lookup.

#include <cmath>
#include <concepts>

namespace scree {

/// `yes` where `condition` holds, `no` elsewhere. A law has no branches on contacts.
template <std::floating_point T>
constexpr T select(bool condition, T yes, T no) {
  return condition ? yes : no;
}

/// Whether a condition holds for any contact of a pack: worth a branch where it seldom does.
constexpr bool any(bool condition) {
  return condition;
}

template <std::floating_point T>
constexpr T larger(T a, T b) {
  return a > b ? a : b;
}

template <std::floating_point T>
T square_root(T a) {
  return std::sqrt(a);
}

template <std::floating_point T>
T sine(T a) {
  return std::sin(a);
}

template <std::floating_point T>
T cosine(T a) {
  return std::cos(a);
}

/// `a` 0 or above.
template <std::floating_point T>
T power(T a, double exponent) {
  return static_cast<T>(std::pow(static_cast<double>(a), exponent));
}

/// a b + c, rounded once where the machine that the program is compiled for can do that (FMA).
///
/// Said in the source, as a compiler that fuses by itself chooses which product of a b + c d it does not
/// round by the order in which it meets them, and that changes with what stands beside them: a law with an
/// extension that is null would not be the base law to the bit.
template <std::floating_point T>
constexpr T multiply_add(T a, T b, T c) {
#if defined(__FMA__)
  return std::fma(a, b, c);
#else
  return a * b + c;
#endif
}

/// a b - c, rounded like `multiply_add`.
template <std::floating_point T>
constexpr T multiply_subtract(T a, T b, T c) {
  return multiply_add(a, b, -c);
}

/// c - a b, rounded like `multiply_add`.
template <std::floating_point T>
constexpr T negated_multiply_add(T a, T b, T c) {
  return multiply_add(-a, b, c);
}

template <std::floating_point T>
constexpr T reciprocal(T a) {
  return T{1} / a;
}

template <std::floating_point T>
T reciprocal_square_root(T a) {
  return T{1} / std::sqrt(a);
}

} // namespace scree
