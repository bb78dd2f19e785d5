#include "validation/case_check.hpp"

using scree::test::check_case;

TEST_CASE("long: the wall of a filled tube carries weight, Janssen") {
  check_case("janssen");
}

// Four minutes of one core.
TEST_CASE("long: balls run out of an orifice, Beverloo") {
  check_case("beverloo");
}
