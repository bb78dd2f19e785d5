#include "validation/case_check.hpp"

using scree::test::check_case;

TEST_CASE("physics: triaxial compression of dense and loose spheres") {
  check_case("triaxial");
}
