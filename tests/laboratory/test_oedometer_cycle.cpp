#include "scree/laboratory/oedometer_branches.hpp"
#include "scree/laboratory/oedometer_cycle.hpp"

#include <doctest/doctest.h>

#include <vector>

using namespace scree;

namespace {

/// Loading along a straight line from 10 N to 110 N, unloading along a steeper one.
std::vector<OedometerPoint> triangle(double loading, double unloading) {
  std::vector<OedometerPoint> curve;
  for (int k = 0; k <= 100; ++k) {
    curve.push_back({.displacement = k / loading, .lid_force = 10.0 + k, .cycle = 1, .loading = true});
  }
  for (int k = 1; k <= 100; ++k) {
    curve.push_back({.displacement = 100.0 / loading - k / unloading,
                     .lid_force = 110.0 - k,
                     .cycle = 1,
                     .loading = false});
  }
  return curve;
}

} // namespace

TEST_CASE("a cycle of straight lines has their slopes, and the area between them as its hysteresis") {
  const auto curve = triangle(2e4, 5e4);
  const OedometerCycle c =
      oedometer_cycle(curve, 1, {.low_force = 30.0, .high_force = 90.0, .height = 0.2, .area = 0.1});
  CHECK(c.slope == doctest::Approx(2e4));
  CHECK(c.slope_error < 1e-6);
  CHECK(c.modulus == doctest::Approx(2e4 * 0.2 / 0.1));
  CHECK(c.unloading_modulus == doctest::Approx(5e4 * 0.2 / 0.1));
  CHECK(c.permanent == doctest::Approx(100.0 / 2e4 - 100.0 / 5e4));
  CHECK(c.compressed == doctest::Approx(100.0 / 2e4));
  // A triangle 100 N high.
  CHECK(c.unloaded);
  CHECK(c.hysteresis == doctest::Approx(0.5 * 100.0 * c.permanent));
}

TEST_CASE("a cycle without an unloading has no hysteresis, and one without rows is refused") {
  auto curve = triangle(2e4, 5e4);
  curve.resize(101);
  const SlopeWindow window{.low_force = 30.0, .high_force = 90.0, .height = 0.2, .area = 0.1};
  const OedometerCycle c = oedometer_cycle(curve, 1, window);
  CHECK_FALSE(c.unloaded);
  CHECK(c.hysteresis == 0.0);
  CHECK(c.permanent == 0.0);
  CHECK(c.compressed == doctest::Approx(100.0 / 2e4));
  CHECK_THROWS_WITH_AS(oedometer_cycle(curve, 0, window), doctest::Contains("loading 1 has 0 points"), Error);
}

TEST_CASE("branches of a measured curve are told apart through noise") {
  std::vector<double> displacement, force;
  double at = 0.0;
  for (const double end : {100.0, 20.0, 120.0, 10.0}) {
    const double from = force.empty() ? 0.0 : force.back();
    for (int k = 1; k <= 20; ++k) {
      force.push_back(from + (end - from) * k / 20.0 + (k < 20 && k % 2 == 0 ? 3.0 : 0.0));
      displacement.push_back(at += 1e-3);
    }
  }
  const auto rows = oedometer_branches(displacement, force, 16.0);
  REQUIRE(rows.size() == 80);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    CAPTURE(k);
    // A swing of noise at its end may put a row or two of a branch to the next.
    if (k % 20 > 1 && k % 20 < 18) {
      CHECK(rows[k].cycle == k / 40);
      CHECK(rows[k].loading == (k / 20 % 2 == 0));
    }
  }
  CHECK_THROWS_WITH_AS(oedometer_branches(displacement, force, 0.0), doctest::Contains("swing = 0"), Error);
  force.pop_back();
  CHECK_THROWS_WITH_AS(oedometer_branches(displacement, force, 1.0),
                       doctest::Contains("80 displacements and 79 forces"), Error);
}
