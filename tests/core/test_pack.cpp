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
    check_lanes<Real>("root", a, b, [](auto, auto y) { return square_root(y); });
    check_lanes<Real>("sine", a, b, [](auto x, auto) { return sine(x); });
    check_lanes<Real>("cosine", a, b, [](auto x, auto) { return cosine(x); });
    check_lanes<Real>("larger", a, b, [](auto x, auto y) { return larger(x, y); });
    check_lanes<Real>("select by <", a, b, [](auto x, auto y) { return select(x < y, x, y * y); });
    check_lanes<Real>("select by >", a, b, [](auto x, auto y) { return select(x > y, x, y * y); });
  }
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
