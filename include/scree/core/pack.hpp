#pragma once
/// \file
/// Several numbers that one instruction computes on, as many as the machine that the program is compiled for
/// has room for: 2 doubles on any x86-64, 8 with AVX-512.

#include "scree/core/numeric.hpp"
#include "scree/core/power.hpp"

#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace scree {

namespace detail {

/// `n` numbers as GCC and clang know them.
template <class Real, std::size_t n>
struct VectorOf {
  // NOLINTNEXTLINE(modernize-use-using): clang 14 takes the attribute of a dependent size only here
  typedef Real type __attribute__((vector_size(n * sizeof(Real))));
};

/// `n` numbers that start at any number in memory.
template <class Real, std::size_t n>
struct LooseVectorOf {
  // NOLINTNEXTLINE(modernize-use-using)
  typedef Real type __attribute__((vector_size(n * sizeof(Real)), aligned(alignof(Real)), may_alias));
};

#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__FMA__)
inline constexpr std::size_t register_bytes = 64;
inline constexpr bool has_estimates = true; // of 14 bits
inline auto roots(__m512d a) {
  return _mm512_maskz_sqrt_pd(0xFF, a);
}
inline auto roots(__m512 a) {
  return _mm512_maskz_sqrt_ps(0xFFFF, a);
}
inline auto reciprocal_estimate(__m512d a) {
  return _mm512_maskz_rcp14_pd(0xFF, a);
}
inline auto reciprocal_estimate(__m512 a) {
  return _mm512_maskz_rcp14_ps(0xFFFF, a);
}
inline auto root_estimate(__m512d a) {
  return _mm512_maskz_rsqrt14_pd(0xFF, a);
}
inline auto root_estimate(__m512 a) {
  return _mm512_maskz_rsqrt14_ps(0xFFFF, a);
}
inline auto fused(__m512d a, __m512d b, __m512d c) {
  return _mm512_fmadd_pd(a, b, c);
}
inline auto fused(__m512 a, __m512 b, __m512 c) {
  return _mm512_fmadd_ps(a, b, c);
}
inline auto fused_negated(__m512d a, __m512d b, __m512d c) {
  return _mm512_fnmadd_pd(a, b, c);
}
inline auto fused_negated(__m512 a, __m512 b, __m512 c) {
  return _mm512_fnmadd_ps(a, b, c);
}
inline auto below(__m512d a, __m512d b) {
  return _mm512_cmp_pd_mask(a, b, _CMP_LT_OQ);
}
inline auto below(__m512 a, __m512 b) {
  return _mm512_cmp_ps_mask(a, b, _CMP_LT_OQ);
}
inline auto chosen(__mmask8 m, __m512d yes, __m512d no) {
  return _mm512_mask_blend_pd(m, no, yes);
}
inline auto chosen(__mmask16 m, __m512 yes, __m512 no) {
  return _mm512_mask_blend_ps(m, no, yes);
}
template <class Mask>
bool any_bit(const Mask& m) {
  return m != 0;
}
template <class Mask>
std::uint32_t bits_of(const Mask& m) {
  return m;
}
#else
inline constexpr bool has_estimates = false;
template <class Register>
Register reciprocal_estimate(const Register&) = delete;
template <class Register>
Register root_estimate(const Register&) = delete;
#if defined(__AVX__)
inline constexpr std::size_t register_bytes = 32;
inline auto roots(__m256d a) {
  return _mm256_sqrt_pd(a);
}
inline auto roots(__m256 a) {
  return _mm256_sqrt_ps(a);
}
#if defined(__FMA__)
inline auto fused(__m256d a, __m256d b, __m256d c) {
  return _mm256_fmadd_pd(a, b, c);
}
inline auto fused(__m256 a, __m256 b, __m256 c) {
  return _mm256_fmadd_ps(a, b, c);
}
inline auto fused_negated(__m256d a, __m256d b, __m256d c) {
  return _mm256_fnmadd_pd(a, b, c);
}
inline auto fused_negated(__m256 a, __m256 b, __m256 c) {
  return _mm256_fnmadd_ps(a, b, c);
}
#endif
#elif defined(__SSE2__)
inline constexpr std::size_t register_bytes = 16;
inline auto roots(__m128d a) {
  return _mm_sqrt_pd(a);
}
inline auto roots(__m128 a) {
  return _mm_sqrt_ps(a);
}
#else
inline constexpr std::size_t register_bytes = 16;
template <class Register>
Register roots(Register a) {
  for (std::size_t lane = 0; lane < sizeof a / sizeof a[0]; ++lane) {
    a[lane] = std::sqrt(a[lane]);
  }
  return a;
}
#endif
#if !defined(__FMA__)
template <class Register>
Register fused(const Register& a, const Register& b, const Register& c) {
  return a * b + c;
}
template <class Register>
Register fused_negated(const Register& a, const Register& b, const Register& c) {
  return c - a * b;
}
#endif
template <class Register>
auto below(const Register& a, const Register& b) {
  return a < b;
}
template <class Mask, class Register>
Register chosen(const Mask& m, const Register& yes, const Register& no) {
  return m ? yes : no;
}
template <class Mask>
bool any_bit(const Mask& m) {
  std::uint64_t bits = 0;
  for (std::size_t word = 0; word < sizeof m / sizeof bits; ++word) {
    bits |= reinterpret_cast<typename VectorOf<std::uint64_t, sizeof(Mask) / 8>::type>(m)[word];
  }
  return bits != 0;
}
template <class Mask>
std::uint32_t bits_of(const Mask& m) {
  constexpr std::size_t lanes = sizeof m / sizeof m[0];
  std::uint32_t bits = 0;
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    bits |= m[lane] != 0 ? 1U << lane : 0U;
  }
  return bits;
}
#endif

template <class Register, std::size_t... k>
auto joined(const Register& a, const Register& b, std::index_sequence<k...>) {
  return __builtin_shufflevector(a, b, static_cast<int>(k)...);
}

} // namespace detail

/// Arithmetic, comparison and the operations of core/numeric.hpp, in each lane with the rounding of the plain
/// number, but for powers and the reciprocals: where the machine has a fast estimate of these (AVX-512) they
/// may be off by two units in the last place. A number converts explicitly; all lanes then hold it.
template <std::floating_point Real>
class Pack {
public:
  static constexpr std::size_t width = detail::register_bytes / sizeof(Real);
  using Native = typename detail::VectorOf<Real, width>::type;

  /// For each lane whether a condition holds.
  struct Mask {
    decltype(detail::below(Native{}, Native{})) lanes;
    friend bool any(const Mask& m) { return detail::any_bit(m.lanes); }
    /// Bit by bit from the lowest, for each lane.
    [[nodiscard]] std::uint32_t bits() const { return detail::bits_of(lanes); }
    friend Mask operator&&(const Mask& a, const Mask& b) {
      return {static_cast<decltype(a.lanes)>(a.lanes & b.lanes)};
    }
  };

  Pack() = default;
  template <class Number>
  requires std::is_arithmetic_v<Number>
  explicit Pack(Number value) : lanes_{static_cast<Real>(value) - Native{}} {}
  explicit Pack(const Native& lanes) : lanes_{lanes} {}
  [[nodiscard]] const Native& native() const { return lanes_; }
  /// The lanes value(0), value(1), ...
  template <class Value>
  static Pack generated(Value value) {
    return generated(value, std::make_index_sequence<width>{});
  }
  static Pack loaded(const Real* from) { return Pack{Native(*reinterpret_cast<const Loose*>(from))}; }
  [[nodiscard]] Real operator[](std::size_t lane) const { return lanes_[lane]; }
  void store(Real* to) const { *reinterpret_cast<Loose*>(to) = lanes_; }

  friend Pack operator+(const Pack& a, const Pack& b) { return Pack{a.lanes_ + b.lanes_}; }
  friend Pack operator-(const Pack& a, const Pack& b) { return Pack{a.lanes_ - b.lanes_}; }
  friend Pack operator*(const Pack& a, const Pack& b) { return Pack{a.lanes_ * b.lanes_}; }
  friend Pack operator/(const Pack& a, const Pack& b) { return Pack{a.lanes_ / b.lanes_}; }
  friend Pack operator-(const Pack& a) { return Pack{-a.lanes_}; }
  Pack& operator+=(const Pack& b) { return *this = *this + b; }
  Pack& operator-=(const Pack& b) { return *this = *this - b; }
  Pack& operator*=(const Pack& b) { return *this = *this * b; }

  friend Mask operator<(const Pack& a, const Pack& b) { return {detail::below(a.lanes_, b.lanes_)}; }
  friend Mask operator>(const Pack& a, const Pack& b) { return {detail::below(b.lanes_, a.lanes_)}; }

  friend Pack select(const Mask& condition, const Pack& yes, const Pack& no) {
    return Pack{detail::chosen(condition.lanes, yes.lanes_, no.lanes_)};
  }
  friend Pack larger(const Pack& a, const Pack& b) { return select(a > b, a, b); }
  friend Pack multiply_add(const Pack& a, const Pack& b, const Pack& c) {
    return Pack{detail::fused(a.lanes_, b.lanes_, c.lanes_)};
  }
  friend Pack multiply_subtract(const Pack& a, const Pack& b, const Pack& c) {
    return multiply_add(a, b, -c);
  }
  friend Pack negated_multiply_add(const Pack& a, const Pack& b, const Pack& c) {
    return Pack{detail::fused_negated(a.lanes_, b.lanes_, c.lanes_)};
  }
  friend Pack square_root(const Pack& a) { return Pack{detail::roots(a.lanes_)}; }
  // One lane after the other: right, not fast.
  friend Pack sine(const Pack& a) {
    return generated([&](std::size_t lane) { return std::sin(a[lane]); });
  }
  friend Pack cosine(const Pack& a) {
    return generated([&](std::size_t lane) { return std::cos(a[lane]); });
  }
  /// Of numbers that are 0 or above; see core/power.hpp for how good it is.
  friend Pack power(const Pack& a, double exponent) {
    if constexpr (std::is_same_v<Real, double>) {
      using Bits = typename detail::VectorOf<std::uint64_t, width>::type;
      const auto fused = [](const Native& x, const Native& y, const Native& z) {
        return detail::fused(x, y, z);
      };
      return Pack{detail::power_of<Bits>(a.lanes_, exponent, fused)};
    } else {
      using Half = Pack<double>;
      const auto half = [&](std::size_t first) {
        return Half::generated([&](std::size_t lane) { return static_cast<double>(a[first + lane]); });
      };
      return narrowed(power(half(0), exponent), power(half(Half::width), exponent));
    }
  }
  friend Pack reciprocal(const Pack& a) {
    if constexpr (detail::has_estimates) {
      Pack y{detail::reciprocal_estimate(a.lanes_)};
      for (int k = 0; k < newton_steps; ++k) {
        y = multiply_add(y, negated_multiply_add(a, y, Pack(1)), y);
      }
      return y;
    } else {
      return Pack(1) / a;
    }
  }
  friend Pack reciprocal_square_root(const Pack& a) {
    if constexpr (detail::has_estimates) {
      Pack y{detail::root_estimate(a.lanes_)};
      const Pack half = a * Pack(0.5);
      for (int k = 0; k < newton_steps; ++k) {
        y = multiply_add(y, negated_multiply_add(half * y, y, Pack(0.5)), y);
      }
      return y;
    } else {
      return Pack(1) / square_root(a);
    }
  }

private:
  // The good bits of an estimate double in each step of Newton's.
  static constexpr int newton_steps = sizeof(Real) == 8 ? 2 : 1;

  template <class Value, std::size_t... lane>
  static Pack generated(Value value, std::index_sequence<lane...>) {
    return Pack{Native{value(lane)...}};
  }

  using Loose = typename detail::LooseVectorOf<Real, width>::type;
  Native lanes_{};
};

/// The lanes of two packs of double, one behind the other, in one of float.
inline Pack<float> narrowed(const Pack<double>& a, const Pack<double>& b) {
  static_assert(Pack<float>::width == 2 * Pack<double>::width);
  using Half = typename detail::VectorOf<float, Pack<double>::width>::type;
  return Pack<float>{detail::joined(__builtin_convertvector(a.native(), Half),
                                    __builtin_convertvector(b.native(), Half),
                                    std::make_index_sequence<Pack<float>::width>{})};
}

/// What a loop that is written once for packs and plain numbers asks of them.
template <class T>
struct Lanes {
  using Number = T;
  static constexpr std::size_t width = 1;
  template <class Value>
  static T generated(Value value) {
    return value(std::size_t{0});
  }
  static T loaded(const T* from) { return *from; }
  static void store(const T& value, T* to) { *to = value; }
  /// For each lane whether its number is below `count`.
  static bool below(std::size_t count) { return count > 0; }
  static T sum(const T& value) { return value; }
};

template <class Real>
struct Lanes<Pack<Real>> {
  using Number = Real;
  static constexpr std::size_t width = Pack<Real>::width;
  template <class Value>
  static Pack<Real> generated(Value value) {
    return Pack<Real>::generated(value);
  }
  static Pack<Real> loaded(const Real* from) { return Pack<Real>::loaded(from); }
  static void store(const Pack<Real>& value, Real* to) { value.store(to); }
  static auto below(std::size_t count) {
    return Pack<Real>::generated([](std::size_t lane) { return static_cast<Real>(lane); }) <
           Pack<Real>(count);
  }
  static Real sum(const Pack<Real>& value) {
    Real out = 0;
    for (std::size_t lane = 0; lane < width; ++lane) {
      out += value[lane];
    }
    return out;
  }
};

} // namespace scree
