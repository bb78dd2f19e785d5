#pragma once
/// \file
/// Records in memory to packs and back: a matrix of lanes by fields, transposed in registers.
///
/// The records of a pack's lanes lie anywhere. Each is read as a row of four numbers, and the rows are turned
/// into four packs by shuffles of two registers each: fewer instructions than to gather number by number.

#include "scree/core/pack.hpp"

#include <array>
#include <cstddef>
#include <type_traits>
#include <utility>

namespace scree {

/// Packs of four fields, or plain numbers of one record.
template <class T>
using Fields = std::array<T, 4>;

namespace detail {

template <class Register, std::size_t... k>
Register evens(const Register& a, const Register& b, std::index_sequence<k...>) {
  return __builtin_shufflevector(a, b, static_cast<int>(2 * k)...);
}
template <class Register, std::size_t... k>
Register odds(const Register& a, const Register& b, std::index_sequence<k...>) {
  return __builtin_shufflevector(a, b, static_cast<int>(2 * k + 1)...);
}
/// Number k of what comes of laying pieces of `size` numbers of a and b (of `width`) down in turn.
constexpr int alternating(std::size_t k, std::size_t size, std::size_t width) {
  const std::size_t piece = k / size;
  return static_cast<int>(piece % 2 * width + piece / 2 * size + k % size);
}
template <std::size_t size, class Register, std::size_t... k>
Register interleaved_low(const Register& a, const Register& b, std::index_sequence<k...>) {
  return __builtin_shufflevector(a, b, alternating(k, size, sizeof...(k))...);
}
template <std::size_t size, class Register, std::size_t... k>
Register interleaved_high(const Register& a, const Register& b, std::index_sequence<k...>) {
  return __builtin_shufflevector(a, b, alternating(sizeof...(k) + k, size, sizeof...(k))...);
}

template <class Register, std::size_t... k>
auto half_of(const Register& v, std::size_t which, std::index_sequence<k...>) {
  return which == 0 ? __builtin_shufflevector(v, v, static_cast<int>(k)...)
                    : __builtin_shufflevector(v, v, static_cast<int>(sizeof...(k) + k)...);
}

/// Numbers `first * width` to `(first + 1) * width` of rows of four that lie one behind the other, where
/// `part<n>(row, skip)` gives n numbers of a row.
template <std::size_t width, class Rows>
[[gnu::always_inline]] inline auto piece_of_rows(const Rows& rows, std::size_t first) {
  if constexpr (width <= 4) {
    return rows.template part<width>(first * width / 4, first * width % 4);
  } else {
    return joined(piece_of_rows<width / 2>(rows, 2 * first), piece_of_rows<width / 2>(rows, 2 * first + 1),
                  std::make_index_sequence<width>{});
  }
}

/// Rows of Real, given as Number.
template <class Number, class Real, class Row>
struct RowsInMemory {
  const Row& row;
  template <std::size_t n>
  [[gnu::always_inline]] auto part(std::size_t lane, std::size_t skip) const {
    const auto& here = *reinterpret_cast<const typename LooseVectorOf<Real, n>::type*>(row(lane) + skip);
    using Part = typename VectorOf<Number, n>::type;
    if constexpr (std::is_same_v<Number, Real>) {
      return static_cast<Part>(here);
    } else {
      return __builtin_convertvector(static_cast<typename VectorOf<Real, n>::type>(here), Part);
    }
  }
};

template <class A, class B>
struct RowDifferences {
  A a;
  B b;
  template <std::size_t n>
  [[gnu::always_inline]] auto part(std::size_t lane, std::size_t skip) const {
    return a.template part<n>(lane, skip) - b.template part<n>(lane, skip);
  }
};

} // namespace detail

/// How a T reads four fields. `rows` is one of the above.
template <class T>
struct FieldsOf {
  template <class Rows>
  [[gnu::always_inline]] static Fields<T> read(const Rows& rows) {
    constexpr std::size_t width = Lanes<T>::width;
    if constexpr (width == 1) {
      const auto number = [&](std::size_t k) { return rows.template part<1>(0, k)[0]; };
      return {number(0), number(1), number(2), number(3)};
    } else {
      constexpr auto lanes = std::make_index_sequence<width>{};
      const auto piece = [&](std::size_t k) { return detail::piece_of_rows<width>(rows, k); };
      const auto a = piece(0), b = piece(1), c = piece(2), d = piece(3);
      const auto xz = detail::evens(a, b, lanes), yw = detail::odds(a, b, lanes);
      const auto xz2 = detail::evens(c, d, lanes), yw2 = detail::odds(c, d, lanes);
      return {T{detail::evens(xz, xz2, lanes)}, T{detail::evens(yw, yw2, lanes)},
              T{detail::odds(xz, xz2, lanes)}, T{detail::odds(yw, yw2, lanes)}};
    }
  }
};

/// The four fields of records: `row(lane)` points to the first of four numbers that lie one behind the other,
/// of any type.
template <class T, class Row>
[[gnu::always_inline]] inline Fields<T> fields_of(const Row& row) {
  using Real = std::remove_cvref_t<decltype(*row(0))>;
  return FieldsOf<T>::read(detail::RowsInMemory<typename Lanes<T>::Number, Real, Row>{row});
}

/// The fields of the records `a(lane)` less those of `b(lane)`.
template <class T, class A, class B>
[[gnu::always_inline]] inline Fields<T> differences_of(const A& a, const B& b) {
  using Real = std::remove_cvref_t<decltype(*a(0))>;
  using Differences =
      detail::RowDifferences<detail::RowsInMemory<Real, Real, A>, detail::RowsInMemory<Real, Real, B>>;
  return FieldsOf<T>::read(Differences{{a}, {b}});
}

namespace detail {

/// at[0 .. n) = operation(at[0 .. n), values)
template <class Real, std::size_t n, class Register, class Operation>
[[gnu::always_inline]] inline void update(Real* at, const Register& values, const Operation& operation) {
  auto& place = *reinterpret_cast<typename LooseVectorOf<Real, n>::type*>(at);
  place = operation(static_cast<Register>(place), values);
}

/// Four packs as rows of four numbers: piece k has numbers `k * width` to `(k + 1) * width` of all rows, one
/// behind the other.
template <class T>
[[gnu::always_inline]] inline Fields<T> rows_of(const Fields<T>& fields) {
  if constexpr (Lanes<T>::width == 1) {
    return fields;
  } else {
    constexpr auto lanes = std::make_index_sequence<Lanes<T>::width>{};
    const auto x = fields[0].native(), y = fields[1].native(), z = fields[2].native(), w = fields[3].native();
    const auto xz = interleaved_low<1>(x, z, lanes), xz2 = interleaved_high<1>(x, z, lanes);
    const auto yw = interleaved_low<1>(y, w, lanes), yw2 = interleaved_high<1>(y, w, lanes);
    return {T{interleaved_low<1>(xz, yw, lanes)}, T{interleaved_high<1>(xz, yw, lanes)},
            T{interleaved_low<1>(xz2, yw2, lanes)}, T{interleaved_high<1>(xz2, yw2, lanes)}};
  }
}

} // namespace detail

/// Eight packs as rows of eight numbers, one for each lane.
template <class T>
class RowsOfEight {
public:
  [[gnu::always_inline]] RowsOfEight(const Fields<T>& first, const Fields<T>& second)
      : first_{detail::rows_of<T>(first)}, second_{detail::rows_of<T>(second)} {}

  /// Changes the eight numbers from `at` on by `operation(old, row)`.
  template <std::size_t lane, class Real, class Operation>
  [[gnu::always_inline]] void apply(Real* at, const Operation& operation) const {
    constexpr std::size_t width = Lanes<T>::width;
    if constexpr (width == 1) {
      for (std::size_t k = 0; k < 4; ++k) {
        at[k] = operation(at[k], first_[k]);
        at[4 + k] = operation(at[4 + k], second_[k]);
      }
    } else if constexpr (width <= 4) {
      constexpr std::size_t parts = 4 / width; // pieces of each row
      for (std::size_t part = 0; part < parts; ++part) {
        const std::size_t piece = lane * parts + part;
        detail::update<Real, width>(at + part * width, first_[piece].native(), operation);
        detail::update<Real, width>(at + 4 + part * width, second_[piece].native(), operation);
      }
    } else {
      // A row of the first and the same of the second make one: a register holds width / 8 of them.
      constexpr auto all = std::make_index_sequence<width>{};
      constexpr std::size_t each = width / 8, joint = lane / each;
      const auto a = first_[joint / 2].native(), b = second_[joint / 2].native();
      const auto rows =
          joint % 2 == 0 ? detail::interleaved_low<4>(a, b, all) : detail::interleaved_high<4>(a, b, all);
      if constexpr (each == 1) {
        detail::update<Real, 8>(at, rows, operation);
      } else {
        static_assert(each == 2, "packs of more than 16 numbers");
        detail::update<Real, 8>(at, detail::half_of(rows, lane % 2, std::make_index_sequence<8>{}),
                                operation);
      }
    }
  }

private:
  Fields<T> first_, second_; // pieces
};

/// Packs as rows of four numbers, one for each lane.
template <class T>
class RowsOfFour {
public:
  [[gnu::always_inline]] explicit RowsOfFour(const Fields<T>& fields) : pieces_{detail::rows_of<T>(fields)} {}

  /// Writes a row from `at` on.
  template <std::size_t lane, class Real>
  [[gnu::always_inline]] void store(Real* at) const {
    write<lane>(at, [](const auto& row, const auto&) { return row; });
    if constexpr (Lanes<T>::width <= 2) {
      at[3] = last<lane, Real>();
    }
  }
  /// Writes the first three numbers of a row. What lies behind them in memory stays as it is, to the bit.
  template <std::size_t lane, class Real>
  [[gnu::always_inline]] void store_three(Real* at) const {
    write<lane>(
        at, [](const auto& row, const auto& old) { return __builtin_shufflevector(row, old, 0, 1, 2, 7); });
  }

private:
  /// at[0 .. 4) = choose(row, at[0 .. 4)), but of three numbers for narrow packs.
  template <std::size_t lane, class Real, class Choose>
  [[gnu::always_inline]] void write(Real* at, const Choose& choose) const {
    constexpr std::size_t width = Lanes<T>::width;
    if constexpr (width == 1) {
      for (std::size_t k = 0; k < 3; ++k) {
        at[k] = static_cast<Real>(pieces_[k]);
      }
    } else if constexpr (width == 2) {
      const auto two = pieces_[2 * lane].native();
      at[0] = static_cast<Real>(two[0]);
      at[1] = static_cast<Real>(two[1]);
      at[2] = static_cast<Real>(pieces_[2 * lane + 1][0]);
    } else {
      using Row = typename detail::VectorOf<Real, 4>::type;
      auto& place = *reinterpret_cast<typename detail::LooseVectorOf<Real, 4>::type*>(at);
      place = choose(__builtin_convertvector(row<lane>(), Row), static_cast<Row>(place));
    }
  }
  template <std::size_t lane>
  [[gnu::always_inline]] auto row() const {
    if constexpr (Lanes<T>::width == 4) {
      return pieces_[lane].native();
    } else {
      static_assert(Lanes<T>::width == 8, "packs of more than 8 numbers");
      return detail::half_of(pieces_[lane / 2].native(), lane % 2, std::make_index_sequence<4>{});
    }
  }
  template <std::size_t lane, class Real>
  [[gnu::always_inline]] Real last() const {
    if constexpr (Lanes<T>::width == 1) {
      return static_cast<Real>(pieces_[3]);
    } else {
      return static_cast<Real>(pieces_[2 * lane + 1][1]);
    }
  }

  Fields<T> pieces_;
};

/// Calls `visit(std::integral_constant<std::size_t, lane>)` for all lanes of a T, in their order.
template <class T, class Visit>
[[gnu::always_inline]] inline void for_each_lane(const Visit& visit) {
  [&]<std::size_t... lane>(std::index_sequence<lane...>) {
    (visit(std::integral_constant<std::size_t, lane>{}), ...);
  }
  (std::make_index_sequence<Lanes<T>::width>{});
}

} // namespace scree
