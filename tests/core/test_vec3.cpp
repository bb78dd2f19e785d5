#include "support/relative_error.hpp"

#include "scree/core/linear.hpp"
#include "scree/core/numeric.hpp"

#include <doctest/doctest.h>

using namespace scree;
using test::relative_error;

TEST_CASE("the kernels' vector agrees with Eigen's") {
  const Vec3<double> a{0.3, -1.7, 2.9}, b{-4.1, 0.6, 1.3};
  const Vector ea = to_eigen(a), eb = to_eigen(b);
  CHECK(relative_error(dot(a, b), ea.dot(eb)) < 1e-15);
  CHECK((to_eigen(cross(a, b)) - ea.cross(eb)).norm() < 1e-15);
  CHECK(relative_error(norm(a), ea.norm()) < 1e-15);
  CHECK(relative_error(squared_norm(b), eb.squaredNorm()) < 1e-15);
  CHECK(to_eigen(a + b) == ea + eb);
  CHECK(to_eigen(a - b) == ea - eb);
  CHECK(to_eigen(-a) == -ea);
  CHECK(to_eigen(a * 2.0) == 2.0 * ea);
  CHECK(2.0 * a == a * 2.0);
  Vec3<double> c = a;
  c += b;
  c -= a;
  c *= 3.0;
  CHECK((to_eigen(c) - 3.0 * eb).norm() < 1e-15);
  CHECK(to_vec3(ea) == a);
  CHECK(to_vec3<float>(ea) == a.as<float>());
}

TEST_CASE("the choices of a law are those of a plain number") {
  CHECK(select(true, 1.0, 2.0) == 1.0);
  CHECK(select(false, 1.0F, 2.0F) == 2.0F);
  CHECK(larger(-1.0, 3.0) == 3.0);
  CHECK(larger(3.0, -1.0) == 3.0);
  CHECK(square_root(9.0) == 3.0);
  CHECK(any(true));
  CHECK_FALSE(any(false));
}
