#include "scree/measure/attitude.hpp"
#include "support/relative_error.hpp"

#include <doctest/doctest.h>

using namespace scree;

namespace {

Quaternion about(const Vector& axis, double angle) {
  return Quaternion{Eigen::AngleAxisd{angle, axis}};
}

} // namespace

TEST_CASE("pitch is positive with the nose up, roll with the left side up, yaw with the nose to the left") {
  CHECK(attitude(about(Vector::UnitY(), -0.1)).pitch == test::about(0.1));
  CHECK(attitude(about(Vector::UnitX(), 0.2)).roll == test::about(0.2));
  CHECK(attitude(about(Vector::UnitZ(), 0.3)).yaw == test::about(0.3));
}

TEST_CASE("each angle leaves the others alone") {
  const Attitude pitched = attitude(about(Vector::UnitY(), -0.4));
  CHECK(std::abs(pitched.roll) < 1e-15);
  CHECK(std::abs(pitched.yaw) < 1e-15);
  const Attitude turned =
      attitude(about(Vector::UnitZ(), 0.7) * about(Vector::UnitY(), -0.25) * about(Vector::UnitX(), 0.1));
  CHECK(turned.yaw == test::about(0.7));
  CHECK(turned.pitch == test::about(0.25));
  CHECK(turned.roll == test::about(0.1));
}
