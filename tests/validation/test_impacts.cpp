#include "validation/case_check.hpp"

using scree::test::check_case;

TEST_CASE("elastic normal impact: Chung & Ooi 1 and 2") {
  check_case("normal_impact");
}

TEST_CASE("restitution: Chung & Ooi 3") {
  check_case("restitution");
}

TEST_CASE("oblique impact: Chung & Ooi 4 and Kharaz, Hertz-Mindlin") {
  check_case("oblique_impact");
}

TEST_CASE("oblique impact: Chung & Ooi 4 and Kharaz, linear") {
  check_case("oblique_impact_linear");
}

TEST_CASE("oblique impact at one normal speed: Chung & Ooi 5") {
  check_case("constant_normal_speed");
}

TEST_CASE("impact with spin: Chung & Ooi 6 to 8") {
  check_case("spinning_impact");
}
