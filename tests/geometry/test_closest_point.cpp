#include "scree/geometry/closest_point.hpp"

#include "scree/core/random.hpp"
#include "support/relative_error.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

using namespace scree;

namespace {

using Triangle = std::array<Vector, 3>;

Vector anywhere(Random& random, double size) {
  return {random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
}

/// Shapes from round to needles of width 10^-`slimmest`, near the origin and far from it.
Triangle some_triangle(Random& random, double slimmest) {
  Triangle t{anywhere(random, 1.0), anywhere(random, 1.0), anywhere(random, 1.0)};
  const double squeeze = std::pow(10.0, -random.uniform(0.0, slimmest));
  t[2] = t[0] + (t[1] - t[0]) * random.uniform() + squeeze * (t[2] - t[0]);
  const Vector away = random.index(2) == 0 ? Vector::Zero() : anywhere(random, 100.0);
  for (Vector& corner : t) {
    corner += away;
  }
  return t;
}

/// What the point claims to lie on, as weights of the corners.
bool lies_on(const Triangle& t, const ClosestPoint& c, double tolerance) {
  const auto corner = [&](int k) { return (c.feature >> k & 1) != 0; };
  switch (corner(0) + corner(1) + corner(2)) {
  case 1: {
    const int k = corner(0) ? 0 : corner(1) ? 1 : 2;
    return c.point == t[static_cast<std::size_t>(k)];
  }
  case 2: {
    const Vector a = corner(0) ? t[0] : t[1], b = corner(2) ? t[2] : t[1];
    const double along = (c.point - a).dot(b - a) / (b - a).squaredNorm();
    return along >= -tolerance && along <= 1.0 + tolerance &&
           (a + along * (b - a) - c.point).norm() < tolerance;
  }
  case 3: {
    const Vector normal = (t[1] - t[0]).cross(t[2] - t[0]).normalized();
    return std::abs((c.point - t[0]).dot(normal)) < tolerance;
  }
  default:
    return false;
  }
}

} // namespace

TEST_CASE("the closest point satisfies the condition that is both necessary and sufficient") {
  // Of a convex set, q is nearest to p exactly if no point x of it has (p - q).(x - q) > 0; the corners
  // suffice.
  Random random{101};
  std::array<int, 8> seen{};
  for (int k = 0; k < 20000; ++k) {
    const Triangle t = some_triangle(random, 4.0);
    const Vector p = t[0] + anywhere(random, 2.0);
    const ClosestPoint c = closest_point(t, p);
    const double scale = 1.0 + t[0].norm();
    for (const Vector& corner : t) {
      REQUIRE((p - c.point).dot(corner - c.point) < 1e-12 * scale);
    }
    REQUIRE(lies_on(t, c, 1e-12 * scale));
    ++seen[c.feature];
  }
  for (const int feature : {1, 2, 3, 4, 5, 6, 7}) {
    CHECK(seen[static_cast<std::size_t>(feature)] > 50);
  }
}

TEST_CASE("no sample of the triangle is nearer than the closest point, and one is as near as the samples are "
          "dense") {
  Random random{102};
  constexpr int n = 100;
  for (int k = 0; k < 50; ++k) {
    const Triangle t{anywhere(random, 1.0), anywhere(random, 1.0), anywhere(random, 1.0)};
    const Vector p = anywhere(random, 1.5);
    const double distance = (closest_point(t, p).point - p).norm();
    double nearest = std::numeric_limits<double>::infinity();
    for (int i = 0; i <= n; ++i) {
      for (int j = 0; i + j <= n; ++j) {
        const Vector sample = (i * t[0] + j * t[1] + (n - i - j) * t[2]) / n;
        nearest = std::min(nearest, (sample - p).norm());
      }
    }
    const double spacing = std::max({(t[1] - t[0]).norm(), (t[2] - t[1]).norm(), (t[0] - t[2]).norm()}) / n;
    CHECK(distance <= nearest + 1e-12);
    CHECK(nearest <= distance + spacing);
  }
}

TEST_CASE("a point of the triangle is its own closest point") {
  // Of a needle this holds less well: weights of the corners lose the square of its width in digits.
  Random random{103};
  for (int k = 0; k < 1000; ++k) {
    const Triangle t = some_triangle(random, 1.0);
    const double a = random.uniform(), b = random.uniform(0.0, 1.0 - a);
    const double scale = 1.0 + t[0].norm();
    for (const Vector& p :
         {Vector(t[0] + a * (t[1] - t[0]) + b * (t[2] - t[0])), Vector(0.5 * (t[1] + t[2])), t[1]}) {
      REQUIRE((closest_point(t, p).point - p).norm() < 1e-11 * scale);
    }
  }
}

TEST_CASE("the order of the corners does not move the closest point") {
  Random random{104};
  for (int k = 0; k < 1000; ++k) {
    const Triangle t = some_triangle(random, 1.0);
    const Vector p = t[0] + anywhere(random, 2.0);
    const Vector first = closest_point(t, p).point;
    for (const Triangle& other : {Triangle{t[1], t[2], t[0]}, Triangle{t[2], t[1], t[0]}}) {
      const double distance = (first - p).norm();
      REQUIRE((closest_point(other, p).point - p).norm() == test::about(distance, 1e-10));
    }
  }
}
