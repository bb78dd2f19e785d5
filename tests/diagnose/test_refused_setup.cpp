#include "scree/diagnose/diagnosis.hpp"
#include "support/refusals.hpp"

#include <doctest/doctest.h>

using namespace scree;
using test::not_a_number;

TEST_CASE("a diagnosis refuses lines that are out of range") {
  SCREE_REFUSES(DiagnosisSetup, false_alarms, "diagnosis false_alarms", 0.0, 0.6, not_a_number);
  SCREE_REFUSES(DiagnosisSetup, least_adequacy, "diagnosis least_adequacy", -0.1, 0.6, not_a_number);
  SCREE_REFUSES(DiagnosisSetup, clear_odds, "diagnosis clear_odds", 0.5, not_a_number);
  SCREE_REFUSES(DiagnosisSetup, kept_odds, "diagnosis kept_odds", 5.0, not_a_number);
  SCREE_REFUSES(DiagnosisSetup, odds_against_pair, "diagnosis odds_against_pair", 0.5, not_a_number);
  SCREE_REFUSES(DiagnosisSetup, confidence, "diagnosis confidence", 0.0, 1.0, not_a_number);
  SCREE_REFUSES(DiagnosisSetup, form_tolerance, "diagnosis form_tolerance", -0.1, 1.1, not_a_number);
  SCREE_REFUSES(DiagnosisSetup, least_power, "diagnosis least_power", -0.1, 1.1, not_a_number);
  SCREE_REFUSES(DiagnosisSetup, draws, "diagnosis draws", 19U);
}
