#include "scree/core/linear.hpp"
#include "scree/core/random.hpp"

#include <doctest/doctest.h>

using namespace scree;

TEST_CASE("the kernels' quaternion and axes agree with Eigen's") {
  Random random{31};
  for (int k = 0; k < 20; ++k) {
    const Quaternion a = random.orientation(), b = random.orientation();
    CHECK((to_eigen(to_quat(a) * to_quat(b)).coeffs() - (a * b).coeffs()).norm() < 1e-15);
    CHECK((to_eigen(to_quat(a) * 0.3).coeffs() - 0.3 * a.coeffs()).norm() < 1e-15);
    CHECK(squared_norm(to_quat(a) * 2.0) > 3.999999);
    const Axes<double> axes = axes_of(to_quat(a));
    const Vector v = b * Vector{1.0, -2.0, 0.5};
    CHECK((to_eigen(axes.to_space(to_vec3(v))) - a * v).norm() < 4e-15);
    CHECK((to_eigen(axes.to_frame(to_vec3(v))) - a.conjugate() * v).norm() < 4e-15);
  }
  CHECK(to_eigen(Quat<double>{}).coeffs() == Quaternion::Identity().coeffs());
}
