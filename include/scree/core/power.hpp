#pragma once
/// \file
/// Powers of many numbers at once.

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace scree::detail {

/// `a` to the power `exponent` in each lane of a vector of double, `a` 0 or above: exp(exponent log a), right
/// to (4 + |exponent log a|) 2e-16 of it while it is within 1e-300 and 1e300, and stopped there. What is not
/// a number stays so. 0 to the power 0 is 1, and 1 to any power is. \tparam Bits a vector of as many
/// std::uint64_t \param fused multiply_add(a, b, c) of such vectors
template <class Bits, class Doubles, class Fused>
Doubles power_of(const Doubles& a, double exponent, const Fused& fused) {
  constexpr double two_52 = 4503599627370496.0;
  constexpr auto bits_of_two_52 = std::bit_cast<std::uint64_t>(two_52);
  constexpr auto bits_of_one = std::bit_cast<std::uint64_t>(1.0);
  constexpr std::uint64_t fraction = (std::uint64_t{1} << 52U) - 1U;
  constexpr double ln2_high = 0x1.62e42fefa38p-1,
                   ln2_low = 0x1.ef35793c7673p-45; // the high one has zeros at its end

  const Doubles zero{};
  const Doubles positive = a > zero ? a : zero + 1.0;
  const auto bits = std::bit_cast<Bits>(positive);
  // a = m 2^e with m from sqrt(1/2) to sqrt(2); log m = 2 artanh s.
  Doubles m = std::bit_cast<Doubles>((bits & fraction) | bits_of_one);
  Doubles e = std::bit_cast<Doubles>((bits >> 52U) | bits_of_two_52) - (two_52 + 1023.0);
  const auto large = m > zero + 1.4142135623730951;
  m = large ? m * 0.5 : m;
  e = large ? e + 1.0 : e;
  const Doubles s = (m - 1.0) / (m + 1.0), s2 = s * s;
  Doubles series = zero + 2.0 / 21.0;
  for (double n = 19.0; n >= 3.0; n -= 2.0) {
    series = fused(series, s2, zero + 2.0 / n);
  }
  const Doubles log = e * ln2_high + (s * 2.0 + fused(e, zero + ln2_low, s * s2 * series));

  constexpr double most = 690.0;
  Doubles y = log * exponent;
  y = y < zero + most ? y : zero + most;
  y = y > zero - most ? y : zero - most;
  // y = k ln 2 + r; adding 1.5 2^52 rounds to a whole number, whose last bits are then k.
  constexpr double rounder = 1.5 * two_52;
  const Doubles shifted = fused(y, zero + 1.4426950408889634, zero + rounder);
  const Doubles k = shifted - rounder;
  const Doubles r = fused(-k, zero + ln2_low, y - k * ln2_high);
  Doubles exp = zero + 1.0 / 6227020800.0; // 13!
  double factorial = 6227020800.0;
  for (double n = 13.0; n >= 1.0; n -= 1.0) {
    factorial /= n;
    exp = fused(exp, r, zero + 1.0 / factorial);
  }
  exp = std::bit_cast<Doubles>(std::bit_cast<Bits>(exp) + (std::bit_cast<Bits>(shifted) << 52U));

  const double of_zero = exponent > 0.0    ? 0.0
                         : exponent == 0.0 ? 1.0
                                           : std::numeric_limits<double>::infinity();
  return a > zero ? exp : a * 0.0 + of_zero;
}

} // namespace scree::detail
