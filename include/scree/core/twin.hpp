#pragma once
/// \file
/// Two packs that go side by side.
///
/// A contact is one long chain of operations, each of which waits some cycles for the one before, and it is
/// so long that a processor cannot look ahead to the next. Two at a time fill the gaps of each other.

#include "scree/core/pack_rows.hpp"

#include <array>
#include <cstddef>
#include <type_traits>
#include <utility>

namespace scree {

template <class P>
class Twin {
public:
  static constexpr std::size_t half = P::width, width = 2 * half;

  struct Mask {
    typename P::Mask a, b;
    friend bool any(const Mask& m) { return any(m.a) || any(m.b); }
    friend Mask operator&&(const Mask& m, const Mask& n) { return {m.a && n.a, m.b && n.b}; }
  };

  Twin() = default;
  Twin(const P& first, const P& second) : a{first}, b{second} {}
  template <class Number>
  requires std::is_arithmetic_v<Number>
  explicit Twin(Number value) : a(value), b(value) {}

  friend Twin operator+(const Twin& x, const Twin& y) { return {x.a + y.a, x.b + y.b}; }
  friend Twin operator-(const Twin& x, const Twin& y) { return {x.a - y.a, x.b - y.b}; }
  friend Twin operator*(const Twin& x, const Twin& y) { return {x.a * y.a, x.b * y.b}; }
  friend Twin operator/(const Twin& x, const Twin& y) { return {x.a / y.a, x.b / y.b}; }
  friend Twin operator-(const Twin& x) { return {-x.a, -x.b}; }
  Twin& operator+=(const Twin& y) { return *this = *this + y; }
  Twin& operator-=(const Twin& y) { return *this = *this - y; }
  Twin& operator*=(const Twin& y) { return *this = *this * y; }
  friend Mask operator<(const Twin& x, const Twin& y) { return {x.a < y.a, x.b < y.b}; }
  friend Mask operator>(const Twin& x, const Twin& y) { return {x.a > y.a, x.b > y.b}; }

  friend Twin select(const Mask& m, const Twin& yes, const Twin& no) {
    return {select(m.a, yes.a, no.a), select(m.b, yes.b, no.b)};
  }
  friend Twin larger(const Twin& x, const Twin& y) { return {larger(x.a, y.a), larger(x.b, y.b)}; }
  friend Twin multiply_add(const Twin& x, const Twin& y, const Twin& z) {
    return {multiply_add(x.a, y.a, z.a), multiply_add(x.b, y.b, z.b)};
  }
  friend Twin multiply_subtract(const Twin& x, const Twin& y, const Twin& z) {
    return {multiply_subtract(x.a, y.a, z.a), multiply_subtract(x.b, y.b, z.b)};
  }
  friend Twin negated_multiply_add(const Twin& x, const Twin& y, const Twin& z) {
    return {negated_multiply_add(x.a, y.a, z.a), negated_multiply_add(x.b, y.b, z.b)};
  }
  friend Twin square_root(const Twin& x) { return {square_root(x.a), square_root(x.b)}; }
  friend Twin power(const Twin& x, double exponent) { return {power(x.a, exponent), power(x.b, exponent)}; }
  friend Twin reciprocal(const Twin& x) { return {reciprocal(x.a), reciprocal(x.b)}; }
  friend Twin reciprocal_square_root(const Twin& x) {
    return {reciprocal_square_root(x.a), reciprocal_square_root(x.b)};
  }

  P a, b;
};

template <class Real>
struct Lanes<Twin<Pack<Real>>> {
  using T = Twin<Pack<Real>>;
  using Half = Lanes<Pack<Real>>;
  using Number = Real;
  static constexpr std::size_t width = T::width;

  template <class Value>
  static T generated(Value value) {
    return {Half::generated(value), Half::generated([&](std::size_t lane) { return value(T::half + lane); })};
  }
  static T loaded(const Real* from) { return {Half::loaded(from), Half::loaded(from + T::half)}; }
  static void store(const T& value, Real* to) {
    Half::store(value.a, to);
    Half::store(value.b, to + T::half);
  }
  static auto below(std::size_t count) {
    return typename T::Mask{Half::below(count), Half::below(count > T::half ? count - T::half : 0)};
  }
  static Real sum(const T& value) { return Half::sum(value.a) + Half::sum(value.b); }
};

namespace detail {

template <class Rows>
struct LaterRows {
  const Rows& rows;
  std::size_t first;
  template <std::size_t n>
  [[gnu::always_inline]] auto part(std::size_t lane, std::size_t skip) const {
    return rows.template part<n>(first + lane, skip);
  }
};

} // namespace detail

template <class P>
struct FieldsOf<Twin<P>> {
  template <class Rows>
  [[gnu::always_inline]] static Fields<Twin<P>> read(const Rows& rows) {
    const Fields<P> a = FieldsOf<P>::read(rows);
    const Fields<P> b = FieldsOf<P>::read(detail::LaterRows<Rows>{rows, P::width});
    return {Twin<P>{a[0], b[0]}, Twin<P>{a[1], b[1]}, Twin<P>{a[2], b[2]}, Twin<P>{a[3], b[3]}};
  }
};

template <class P>
class RowsOfEight<Twin<P>> {
public:
  [[gnu::always_inline]] RowsOfEight(const Fields<Twin<P>>& first, const Fields<Twin<P>>& second)
      : a_{{first[0].a, first[1].a, first[2].a, first[3].a},
           {second[0].a, second[1].a, second[2].a, second[3].a}},
        b_{{first[0].b, first[1].b, first[2].b, first[3].b},
           {second[0].b, second[1].b, second[2].b, second[3].b}} {}

  template <std::size_t lane, class Real, class Operation>
  [[gnu::always_inline]] void apply(Real* at, const Operation& operation) const {
    if constexpr (lane < P::width) {
      a_.template apply<lane>(at, operation);
    } else {
      b_.template apply<lane - P::width>(at, operation);
    }
  }

private:
  RowsOfEight<P> a_, b_;
};

} // namespace scree
