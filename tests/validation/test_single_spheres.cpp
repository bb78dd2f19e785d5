#include "validation/case_check.hpp"

using scree::test::check_case;

TEST_CASE("a falling sphere: MFiX DEM01 and DEM02") {
  check_case("falling_sphere");
}

TEST_CASE("stacked spheres: MFiX DEM03") {
  check_case("stacked_spheres");
}

TEST_CASE("a sphere that slides until it rolls: MFiX DEM04") {
  check_case("sliding_sphere");
}
