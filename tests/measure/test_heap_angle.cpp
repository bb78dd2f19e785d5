#include "scree/core/random.hpp"
#include "scree/geometry/clump.hpp"
#include "scree/measure/heap_angle.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <vector>

using namespace scree;

namespace {

constexpr double degree = std::numbers::pi / 180.0;

/// Balls all over the inside of a cone; some stick out of its surface by their radius.
Bodies<double> cone_of_balls(double angle, std::size_t count, Random& random) {
  const Clump ball = make_clump("ball", std::vector<Sphere>{{Vector::Zero(), 0.004}});
  Bodies<double> bodies;
  const double height = 0.1;
  while (bodies.size() < count) {
    const double reach = height / std::tan(angle);
    const Vector at{random.uniform(-reach, reach), random.uniform(-reach, reach),
                    random.uniform(0.0, height)};
    if (at.z() < height - at.head<2>().norm() * std::tan(angle)) {
      bodies.add({&ball, 1.0, 1000.0, 0, at, Quaternion::Identity(), Vector::Zero(), Vector::Zero(), false});
    }
  }
  return bodies;
}

} // namespace

TEST_CASE("the angle of a cone of balls is that of the cone, within its standard error") {
  Random random{4};
  for (const double angle : {20.0 * degree, 30.0 * degree, 41.0 * degree}) {
    const HeapAngle found = heap_angle(cone_of_balls(angle, 20'000, random));
    CAPTURE(found.standard_error / degree);
    CHECK(std::abs(found.angle - angle) < 1.0 * degree);
    CHECK(std::abs(found.angle - angle) < 4.0 * found.standard_error);
    CHECK(found.standard_error < 0.5 * degree);
    CHECK(found.azimuths.size() == 36);
    CHECK(found.inner < found.outer);
    CHECK(found.profile.front().height == doctest::Approx(0.104).epsilon(0.05));
    CHECK(found.profile.back().height < 0.002);
  }
}

TEST_CASE("the standard error of a heap's angle holds: it covers the scatter of heaps alike") {
  Random random{9};
  constexpr int heaps = 30;
  double sum = 0.0, squares = 0.0, predicted = 0.0;
  for (int k = 0; k < heaps; ++k) {
    const HeapAngle found = heap_angle(cone_of_balls(35.0 * degree, 1500, random));
    sum += found.angle / heaps;
    squares += found.angle * found.angle / heaps;
    predicted += found.standard_error / heaps;
  }
  const double scatter = std::sqrt((squares - sum * sum) * heaps / (heaps - 1.0));
  CAPTURE(scatter / degree);
  CAPTURE(predicted / degree);
  // The scatter of 30 is itself known to 13 %; lines that share grains make the prediction a rough one.
  CHECK(predicted > 0.6 * scatter);
  CHECK(predicted < 2.0 * scatter);
}

TEST_CASE("a heap's angle is refused where there is no heap or no flank") {
  Random random{4};
  CHECK_THROWS_WITH_AS(heap_angle(Bodies<double>{}), doctest::Contains("no grains"), Error);
  const auto few = cone_of_balls(30.0 * degree, 1, random);
  CHECK_THROWS_WITH_AS(heap_angle(few, {.from = 0.7, .to = 0.75}), doctest::Contains("too few grains"),
                       Error);
  CHECK_THROWS_WITH_AS(heap_angle(few, {.azimuths = 3}), doctest::Contains("flank azimuths = 3"), Error);
  CHECK_THROWS_WITH_AS(heap_angle(few, {.from = 0.5, .to = 0.4}), doctest::Contains("flank to = 0.4"), Error);
}
