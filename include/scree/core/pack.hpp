#pragma once
/// \file
/// Several numbers that one instruction computes on, as many as the machine that the program is compiled for
/// has room for: 2 doubles on any x86-64, 8 with AVX-512.

#include "scree/core/numeric.hpp"

#include <concepts>
#include <cstddef>
#include <experimental/simd>
#include <type_traits>

namespace scree {

/// Arithmetic, comparison and the operations of core/numeric.hpp, in each lane with the rounding of the plain
/// number. A number converts explicitly; all lanes then hold it.
template <std::floating_point Real>
class Pack {
  using Register = std::experimental::native_simd<Real>;

public:
  static constexpr std::size_t width = Register::size();

  /// For each lane whether a condition holds.
  struct Mask {
    typename Register::mask_type lanes;
    friend bool any(const Mask& m) { return any_of(m.lanes); }
  };

  Pack() : lanes_{Real{0}} {}
  template <class Number>
  requires std::is_arithmetic_v<Number>
  explicit Pack(Number value) : lanes_{static_cast<Real>(value)} {}
  /// The lanes value(0), value(1), ...
  template <class Value>
  static Pack generated(Value value) {
    return Pack{Register{[&](auto lane) { return value(std::size_t{lane}); }}};
  }
  static Pack loaded(const Real* from) { return Pack{Register{from, std::experimental::element_aligned}}; }
  void store(Real* to) const { lanes_.copy_to(to, std::experimental::element_aligned); }

  friend Pack operator+(const Pack& a, const Pack& b) { return Pack{a.lanes_ + b.lanes_}; }
  friend Pack operator-(const Pack& a, const Pack& b) { return Pack{a.lanes_ - b.lanes_}; }
  friend Pack operator*(const Pack& a, const Pack& b) { return Pack{a.lanes_ * b.lanes_}; }
  friend Pack operator/(const Pack& a, const Pack& b) { return Pack{a.lanes_ / b.lanes_}; }
  friend Pack operator-(const Pack& a) { return Pack{-a.lanes_}; }
  Pack& operator+=(const Pack& b) { return *this = *this + b; }
  Pack& operator-=(const Pack& b) { return *this = *this - b; }
  Pack& operator*=(const Pack& b) { return *this = *this * b; }

  friend Mask operator<(const Pack& a, const Pack& b) { return Mask{a.lanes_ < b.lanes_}; }
  friend Mask operator>(const Pack& a, const Pack& b) { return Mask{a.lanes_ > b.lanes_}; }

  friend Pack select(const Mask& condition, const Pack& yes, Pack no) {
    where(condition.lanes, no.lanes_) = yes.lanes_;
    return no;
  }
  friend Pack larger(const Pack& a, const Pack& b) { return select(a > b, a, b); }
  friend Pack square_root(const Pack& a) { return Pack{sqrt(a.lanes_)}; }

private:
  explicit Pack(const Register& lanes) : lanes_{lanes} {}

  Register lanes_;
};

/// What a loop that is written once for packs and plain numbers asks of them.
template <class T>
struct Lanes {
  static constexpr std::size_t width = 1;
  template <class Value>
  static T generated(Value value) {
    return value(std::size_t{0});
  }
  static T loaded(const T* from) { return *from; }
  static void store(const T& value, T* to) { *to = value; }
};

template <class Real>
struct Lanes<Pack<Real>> {
  static constexpr std::size_t width = Pack<Real>::width;
  template <class Value>
  static Pack<Real> generated(Value value) {
    return Pack<Real>::generated(value);
  }
  static Pack<Real> loaded(const Real* from) { return Pack<Real>::loaded(from); }
  static void store(const Pack<Real>& value, Real* to) { value.store(to); }
};

} // namespace scree
