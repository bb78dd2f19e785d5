#include "validation/case_check.hpp"

using scree::test::check_case;

TEST_CASE("tangential loading, unloading and reloading") {
  check_case("tangential_loop");
}

TEST_CASE("the tangential force of a pair that turns") {
  check_case("turning_pair");
}

TEST_CASE("physics: a wall makes no energy, from normal to grazing") {
  check_case("grazing_wall");
}
