#include "validation/case_check.hpp"

using scree::test::check_case;

TEST_CASE("physics: MFiX DEM02 to DEM04 beside MFiX's own results") {
  check_case("mfix_stored");
}

TEST_CASE("physics: oblique impact: MFiX DEM05 and Kharaz, both laws") {
  check_case("oblique_impact_mfix");
}
