#include "validation/case_check.hpp"

using scree::test::check_case;

TEST_CASE("a sphere on an incline rolls or slides") {
  check_case("sphere_on_incline");
}

TEST_CASE("physics: a block on an incline sticks or slides") {
  check_case("block_on_incline");
}

TEST_CASE("physics: a sphere with rolling resistance on an incline rests or rolls") {
  check_case("resisted_rolling");
}
