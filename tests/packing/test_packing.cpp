#include "scree/packing/packing.hpp"
#include "scree/packing/templates.hpp"
#include "support/relative_error.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

using namespace scree;

TEST_CASE("solid volume and mass of a packing") {
  Packing packing;
  packing.shapes = {make_clump("ball", single_sphere()),
                    make_clump("rod", aligned_spheres(), MassConvention::sum_of_spheres)};
  PackedBody ball;
  ball.scale = 0.02;
  PackedBody rod;
  rod.shape = 1;
  rod.scale = 0.1;
  rod.material = 1;
  packing.bodies = {ball, rod, rod};
  const double sphere = std::numbers::pi / 6.0;
  CHECK(solid_volume(packing) ==
        test::about(8e-6 * sphere + 2e-3 * union_properties(aligned_spheres()).mass, 1e-13));
  CHECK(mass(packing, std::vector<double>{1500.0, 2000.0}) ==
        test::about(1500.0 * 8e-6 * sphere + 2000.0 * 2e-3 * 3.0 * sphere, 1e-13));

  CHECK_THROWS_WITH_AS((void)mass(packing, std::vector<double>{1500.0}),
                       "a body has material 1, but only 1 densities are given", Error);
  CHECK_THROWS_AS((void)mass(packing, std::vector<double>{1500.0, 0.0}), Error);
  packing.bodies[0].shape = 7;
  CHECK_THROWS_AS((void)solid_volume(packing), std::out_of_range);
}

TEST_CASE("spheres in space are the clump scaled, turned and moved") {
  Packing packing{{make_clump("rod", aligned_spheres())}, {}};
  PackedBody body;
  body.scale = 2.0;
  body.position = Vector{1.0, 2.0, 3.0};
  body.orientation = Quaternion{Eigen::AngleAxisd{0.5 * std::numbers::pi, Vector::UnitZ()}};
  packing.bodies = {body};
  const auto spheres = spheres_in_space(packing, body);
  REQUIRE(spheres.size() == 3);
  const MassProperties p = union_properties(spheres);
  CHECK(p.mass == test::about(solid_volume(packing), 1e-12));
  CHECK((p.centre - body.position).norm() < 1e-12);
  CHECK((spheres[2].centre - spheres[0].centre).cwiseAbs().isApprox(Vector{0.0, 2.4, 0.0}, 1e-12));
  CHECK(spheres[0].radius == 1.0);
}
