#include "validation/case_check.hpp"

using scree::test::check_case;

TEST_CASE("physics: a settled column bears the weight above, level and on a slope") {
  check_case("settled_column");
}
