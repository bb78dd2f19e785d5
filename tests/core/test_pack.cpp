#include "scree/core/pack.hpp"
#include "scree/core/random.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace {

using namespace scree;

template <class Real>
using Numbers = std::array<Real, Pack<Real>::width>;

template <class Real>
Numbers<Real> drawn(Random& random, double low, double high) {
  Numbers<Real> out{};
  for (Real& value : out) {
    value = static_cast<Real>(random.uniform(low, high));
  }
  return out;
}

template <class Real>
Numbers<Real> taken_apart(const Pack<Real>& pack) {
  Numbers<Real> out{};
  pack.store(out.data());
  return out;
}

/// What `operation` gives for packs must be what it gives for each lane alone, to the bit.
template <class Real, class Operation>
void check_lanes(const char* name, const Numbers<Real>& a, const Numbers<Real>& b, Operation operation) {
  CAPTURE(name);
  const auto together =
      taken_apart<Real>(operation(Pack<Real>::loaded(a.data()), Pack<Real>::loaded(b.data())));
  for (std::size_t lane = 0; lane < a.size(); ++lane) {
    CAPTURE(lane);
    CHECK(together[lane] == operation(a[lane], b[lane]));
  }
}

/// Of a reciprocal, in units of the last place.
template <class Real>
Real ulps(Real a, Real exact) {
  return std::abs(a / exact - Real(1)) / std::numeric_limits<Real>::epsilon();
}

} // namespace

TEST_CASE_TEMPLATE("the reciprocals of a pack are within two units of the last place", Real, double, float) {
  Random random{18};
  for (int repeat = 0; repeat < 500; ++repeat) {
    Numbers<Real> a{};
    for (Real& value : a) {
      value = static_cast<Real>(std::exp(random.uniform(-40.0, 40.0)));
    }
    const auto pack = Pack<Real>::loaded(a.data());
    const auto inverse = taken_apart(reciprocal(pack)), root = taken_apart(reciprocal_square_root(pack));
    for (std::size_t lane = 0; lane < a.size(); ++lane) {
      CAPTURE(a[lane]);
      REQUIRE(ulps(inverse[lane], reciprocal(a[lane])) <= 2);
      REQUIRE(ulps(root[lane], reciprocal_square_root(a[lane])) <= 2);
    }
  }
}

TEST_CASE_TEMPLATE("a pack computes in each lane what the plain number does", Real, double, float) {
  Random random{17};
  for (int repeat = 0; repeat < 20; ++repeat) {
    const auto a = drawn<Real>(random, -3.0, 3.0), b = drawn<Real>(random, 0.5, 3.0);
    check_lanes<Real>("sum", a, b, [](auto x, auto y) { return x + y; });
    check_lanes<Real>("difference", a, b, [](auto x, auto y) { return x - y; });
    check_lanes<Real>("product", a, b, [](auto x, auto y) { return x * y; });
    check_lanes<Real>("quotient", a, b, [](auto x, auto y) { return x / y; });
    check_lanes<Real>("negative", a, b, [](auto x, auto) { return -x; });
    check_lanes<Real>("sum in place", a, b, [](auto x, auto y) { return x += y; });
    check_lanes<Real>("difference in place", a, b, [](auto x, auto y) { return x -= y; });
    check_lanes<Real>("product in place", a, b, [](auto x, auto y) { return x *= y; });
    check_lanes<Real>("multiply_add", a, b, [](auto x, auto y) { return multiply_add(x, y, x); });
    check_lanes<Real>("multiply_subtract", a, b, [](auto x, auto y) { return multiply_subtract(x, y, x); });
    check_lanes<Real>("negated_multiply_add", a, b,
                      [](auto x, auto y) { return negated_multiply_add(x, y, x); });
    check_lanes<Real>("root", a, b, [](auto, auto y) { return square_root(y); });
    check_lanes<Real>("sine", a, b, [](auto x, auto) { return sine(x); });
    check_lanes<Real>("cosine", a, b, [](auto x, auto) { return cosine(x); });
    check_lanes<Real>("larger", a, b, [](auto x, auto y) { return larger(x, y); });
    check_lanes<Real>("select by <", a, b, [](auto x, auto y) { return select(x < y, x, y * y); });
    check_lanes<Real>("select by >", a, b, [](auto x, auto y) { return select(x > y, x, y * y); });
  }
}

TEST_CASE_TEMPLATE("products are added in one rounding where the machine can", T, double, float, Pack<double>,
                   Pack<float>) {
  using Real = typename Lanes<T>::Number;
#if defined(__FMA__)
  constexpr bool once = true;
#else
  constexpr bool once = false;
#endif
  // (1 + e)(1 - e) is 1 where it is rounded.
  const Real e = std::numeric_limits<Real>::epsilon();
  const T high(1 + e), low(1 - e), one(1);
  const Real below = once ? e * e : Real(0);
  const auto first = [](const T& value) {
    std::array<Real, Lanes<T>::width> lanes{};
    Lanes<T>::store(value, lanes.data());
    return lanes.front();
  };
  CHECK(first(multiply_add(high, low, -one)) == -below);
  CHECK(first(multiply_subtract(high, low, one)) == -below);
  CHECK(first(negated_multiply_add(high, low, one)) == below);
}

TEST_CASE_TEMPLATE("any() sees each single lane", Real, double, float) {
  constexpr std::size_t width = Pack<Real>::width;
  for (std::size_t chosen = 0; chosen < width; ++chosen) {
    const auto pack =
        Pack<Real>::generated([&](std::size_t lane) { return lane == chosen ? Real(1) : Real(-1); });
    CHECK(any(pack > Pack<Real>(0)));
    CHECK_FALSE(any(pack > Pack<Real>(1)));
  }
}

TEST_CASE_TEMPLATE("lanes are numbered from 0 and a number fills them all", Real, double, float) {
  const auto counted =
      taken_apart(Pack<Real>::generated([](std::size_t lane) { return static_cast<Real>(lane); }));
  const auto filled = taken_apart(Pack<Real>(2.5)), empty = taken_apart(Pack<Real>{});
  for (std::size_t lane = 0; lane < counted.size(); ++lane) {
    CHECK(counted[lane] == static_cast<Real>(lane));
    CHECK(filled[lane] == Real(2.5));
    CHECK(empty[lane] == Real(0));
  }
}

TEST_CASE_TEMPLATE("powers of packs are those of their lanes", Real, float, double) {
  Random random{5};
  constexpr double rounding = std::numeric_limits<Real>::epsilon();
  for (int k = 0; k < 20000; ++k) {
    const Numbers<Real> logs = drawn<Real>(random, -30.0, 30.0);
    Numbers<Real> a{};
    for (std::size_t lane = 0; lane < a.size(); ++lane) {
      a[lane] = std::exp(logs[lane]);
    }
    const double exponent = random.uniform(-1.0, 2.0);
    const Numbers<Real> powers = taken_apart(power(Pack<Real>::loaded(a.data()), exponent));
    for (std::size_t lane = 0; lane < a.size(); ++lane) {
      const double expected = std::pow(static_cast<double>(a[lane]), exponent);
      REQUIRE(std::abs(static_cast<double>(powers[lane]) - expected) <
              (4.0 + std::abs(std::log(expected))) * rounding * expected);
    }
  }
}

TEST_CASE_TEMPLATE("powers of packs at the ends of their range", Real, float, double) {
  constexpr Real none = std::numeric_limits<Real>::quiet_NaN();
  const auto first = [](Real a, double exponent) { return power(Pack<Real>(a), exponent)[0]; };
  CHECK(first(0, 0.3) == 0);
  CHECK(first(0, 0.0) == 1);
  CHECK(first(1, 0.37) == 1);
  CHECK(first(static_cast<Real>(0.7), 0.0) == 1);
  CHECK(std::isinf(first(0, -1.0)));
  CHECK(std::isnan(first(none, 0.3)));
  CHECK(first(std::numeric_limits<Real>::min(), 0.5) ==
        doctest::Approx(std::sqrt(std::numeric_limits<Real>::min())).epsilon(1e-6));
}
