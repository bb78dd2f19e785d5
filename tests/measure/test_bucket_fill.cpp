#include "scree/geometry/dragline_bucket.hpp"
#include "scree/measure/bucket_fill.hpp"
#include "scree/measure/surface_height.hpp"
#include "support/relative_error.hpp"

#include <doctest/doctest.h>

using namespace scree;

namespace {

Bodies<double> one_at(const std::vector<Vector>& places, double radius) {
  Bodies<double> bodies;
  const Clump ball = make_clump("ball", std::vector<Sphere>{{Vector::Zero(), radius}});
  for (const Vector& place : places) {
    bodies.add({.clump = &ball, .density = 1000.0, .position = place});
  }
  return bodies;
}

} // namespace

TEST_CASE("a body counts by its centre: inside, heaped above the rim, or neither") {
  const BucketGauge gauge{bucket_interior(), 0.175};
  const Vector inside{0.12, 0.0, 0.1}, above{0.12, 0.0, 0.2}, beside{0.12, 0.2, 0.1}, below{0.12, 0.0, -0.05},
      ahead{0.4, 0.0, 0.1}, far_above{0.12, 0.0, 0.6};
  const auto bodies = one_at({inside, above, beside, below, ahead, far_above}, 0.01);
  const BucketFill fill = gauge(bodies, WallMotion{});
  CHECK(fill.struck == test::about(bodies.mass(0)));
  CHECK(fill.heaped == test::about(bodies.mass(0) + bodies.mass(1)));
  CHECK(fill.bodies == 2);
}

TEST_CASE("what a bucket holds moves and turns with it") {
  const BucketGauge gauge{bucket_interior(), 0.175};
  WallMotion motion;
  motion.position = {1.0, 2.0, 3.0};
  motion.orientation = Quaternion{Eigen::AngleAxisd{0.8, Vector(1, 2, 3).normalized()}};
  const auto bodies = one_at({motion.to_space({0.12, 0.0, 0.1}), Vector{0.12, 0.0, 0.1}}, 0.01);
  CHECK(gauge(bodies, motion).struck == test::about(bodies.mass(0)));
}

TEST_CASE("a lattice of points fills the interior to its volume") {
  const TriangleMesh interior = bucket_interior();
  std::vector<Vector> places;
  const double pitch = 0.01;
  for (double x = -0.1; x < 0.4; x += pitch) {
    for (double y = -0.2; y < 0.2; y += pitch) {
      for (double z = -0.05; z < 0.25; z += pitch) {
        places.emplace_back(x, y, z);
      }
    }
  }
  const auto bodies = one_at(places, 0.001);
  const double counted = BucketGauge{interior, 0.0}(bodies, WallMotion{}).struck / bodies.mass(0);
  CHECK(counted * pitch * pitch * pitch == test::about(volume(interior), 0.03));
}

TEST_CASE("the highest point over a rectangle is that of the sphere's cap over it") {
  const auto bodies = one_at({Vector{0.0, 0.0, 1.0}}, 0.5);
  using Plan = Eigen::AlignedBox2d;
  using Corner = Eigen::Vector2d;
  CHECK(highest_point(bodies, Plan{Corner{-1, -1}, Corner{1, 1}}) == test::about(1.5));
  CHECK(highest_point(bodies, Plan{Corner{0.3, -1}, Corner{1, 1}}) == test::about(1.4));
  CHECK(std::isinf(highest_point(bodies, Plan{Corner{0.6, -1}, Corner{1, 1}})));
}
