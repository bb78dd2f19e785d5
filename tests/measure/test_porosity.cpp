#include "scree/measure/porosity.hpp"
#include "support/relative_error.hpp"

#include <doctest/doctest.h>

#include <numbers>
#include <vector>

using namespace scree;

namespace {

Bodies<double> balls(const std::vector<Sphere>& spheres) {
  Bodies<double> bodies;
  for (const Sphere& s : spheres) {
    const Clump ball = make_clump("ball", std::vector<Sphere>{{Vector::Zero(), s.radius}});
    bodies.add({.clump = &ball, .density = 1.0, .position = s.centre});
  }
  return bodies;
}

} // namespace

TEST_CASE("a simple cubic lattice has the porosity 1 - pi/6, wherever the region cuts it") {
  std::vector<Sphere> spheres;
  for (int x = -1; x < 6; ++x) {
    for (int y = -1; y < 6; ++y) {
      for (int z = -1; z < 6; ++z) {
        spheres.push_back({Vector(x, y, z), 0.5});
      }
    }
  }
  const double exact = 1.0 - std::numbers::pi / 6.0;
  const Bodies<double> bodies = balls(spheres);
  const Eigen::AlignedBox3d whole{Vector::Constant(0.5), Vector::Constant(4.5)};
  const Eigen::AlignedBox3d shifted{Vector::Constant(0.2), Vector::Constant(4.2)};
  CHECK(std::abs(porosity(bodies, whole) - exact) < 0.003);
  CHECK(std::abs(porosity(bodies, shifted) - exact) < 0.003);
}

TEST_CASE("overlaps count once") {
  const Bodies<double> bodies = balls({{Vector::Zero(), 0.3}, {Vector::Zero(), 0.3}});
  const Eigen::AlignedBox3d region{Vector::Constant(-0.5), Vector::Constant(0.5)};
  const double ball = 4.0 / 3.0 * std::numbers::pi * 0.027;
  CHECK(porosity(bodies, region) == test::about(1.0 - ball, 0.003));
}

TEST_CASE("an empty region is refused") {
  CHECK_THROWS_AS((void)porosity(balls({}), Eigen::AlignedBox3d{}), Error);
  CHECK(porosity(balls({}), Eigen::AlignedBox3d{Vector::Zero(), Vector::Ones()}) == 1.0);
}
