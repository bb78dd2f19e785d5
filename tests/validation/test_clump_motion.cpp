#include "validation/case_check.hpp"

using scree::test::check_case;

TEST_CASE("physics: a clump that turns freely against the exact motion") {
  check_case("free_clump");
}

TEST_CASE("physics: a clump that swings in a trough is a pendulum") {
  check_case("valley_pendulum");
}
