#pragma once
/// \file
/// A case of the validation as a test.

#include "validation/cases.hpp"

#include "support/environment.hpp"

#include <doctest/doctest.h>

#include <string>

namespace scree::test {

/// Runs one case at its small size and checks every finding. One that is known to be outside its tolerance
/// must say the reason, and must be so still: once it is right, the reason has to go. Without the reference
/// data only theory is checked.
inline void check_case(const std::string& name) {
  const validation::Inputs inputs{reference_directory(), false, 2};
  const validation::Outcome out = validation::find_case(name).run(inputs);
  if (out.findings.empty() && inputs.reference.empty()) {
    skip("no reference data: configure with -DSCREE_REFERENCE_DIR=... for " + name);
    return;
  }
  CHECK(!out.findings.empty());
  for (const validation::Finding& f : out.findings) {
    CAPTURE(f.case_name);
    CAPTURE(f.quantity);
    CAPTURE(f.simulated);
    CAPTURE(f.reference);
    CAPTURE(f.error());
    CAPTURE(f.tolerance.size);
    CAPTURE(f.reason);
    CHECK(f.pass() == f.reason.empty());
  }
}

} // namespace scree::test
