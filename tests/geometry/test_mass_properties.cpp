/// \file
/// A point of mass fixed to a body.

#include "scree/geometry/mass_properties.hpp"

#include <doctest/doctest.h>

using namespace scree;

TEST_CASE("points added one by one have the mass, centre and inertia of all of them") {
  const Vector at[] = {{1.0, 0.2, -0.3}, {-0.4, 2.0, 0.1}, {0.0, 0.7, 1.5}};
  const double mass[] = {2.0, 0.5, 3.0};
  MassProperties body;
  Vector moment = Vector::Zero();
  for (int k = 0; k < 3; ++k) {
    body = with_point_mass(body, mass[k], at[k]);
    moment += mass[k] * at[k];
  }
  const Vector centre = moment / 5.5;
  Matrix inertia = Matrix::Zero();
  for (int k = 0; k < 3; ++k) {
    const Vector d = at[k] - centre;
    inertia += mass[k] * (d.squaredNorm() * Matrix::Identity() - d * d.transpose());
  }
  CHECK(body.mass == 5.5);
  CHECK((body.centre - centre).norm() < 1e-15);
  CHECK((body.inertia - inertia).norm() < 1e-14);
}

TEST_CASE("no mass changes nothing") {
  const MassProperties body{2.0, {1, 2, 3}, Matrix::Identity()};
  const MassProperties same = with_point_mass(body, 0.0, {5, 5, 5});
  CHECK(same.mass == 2.0);
  CHECK(same.centre == body.centre);
  CHECK(same.inertia == body.inertia);
  CHECK(with_point_mass({}, 0.0, {1, 1, 1}).mass == 0.0);
}
