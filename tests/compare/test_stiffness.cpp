#include "scree/compare/stiffness.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace scree;

namespace {

/// strain = integral of d(stress) / M with M = modulus (stress / reference)^exponent.
StressStrain power_law(double modulus, double reference, double exponent, double most) {
  StressStrain branch;
  for (int k = 1; k <= 2000; ++k) {
    const double s = most * k / 2000.0;
    branch.stress.push_back(s);
    branch.strain.push_back(std::pow(s / reference, 1.0 - exponent) * reference / modulus / (1.0 - exponent));
  }
  return branch;
}

} // namespace

TEST_CASE("the stiffness of a power law is found again") {
  for (const double exponent : {0.0, 1.0 / 3.0, 0.55}) {
    CAPTURE(exponent);
    const auto branch = power_law(2e7, 1e5, exponent, 4e5);
    const PowerStiffness found = power_stiffness(branch, 2e4, 4e5, 1e5);
    CHECK(found.exponent == doctest::Approx(exponent).epsilon(0.01));
    CHECK(found.modulus == doctest::Approx(2e7).epsilon(0.02));
    CHECK(found.exponent_error < 0.01);
  }
}

TEST_CASE("strain and secant between rows, loading and unloading") {
  const StressStrain up{{0.0, 1.0, 3.0}, {0.0, 0.1, 0.2}}, down{{3.0, 1.0, 0.0}, {0.2, 0.16, 0.1}};
  CHECK(strain_at(up, 2.0) == doctest::Approx(0.15));
  CHECK(strain_at(down, 2.0) == doctest::Approx(0.18));
  CHECK(secant_modulus(up, 1.0, 3.0) == doctest::Approx(20.0));
  CHECK(secant_modulus(down, 1.0, 3.0) == doctest::Approx(50.0));
  CHECK_THROWS_WITH_AS((void)strain_at(up, 3.5), doctest::Contains("does not pass 3.5 Pa"), Error);
  const StressStrain backwards{{0.0, 3.0}, {0.2, 0.1}};
  CHECK_THROWS_WITH_AS((void)secant_modulus(backwards, 1.0, 2.0), doctest::Contains("strains by -"), Error);
}

TEST_CASE("a stiffness refuses a range that is none") {
  const auto branch = power_law(2e7, 1e5, 0.5, 4e5);
  CHECK_THROWS_WITH_AS((void)power_stiffness(branch, 2e5, 1e5, 1e5), doctest::Contains("high = 100000 Pa"),
                       Error);
  CHECK_THROWS_WITH_AS((void)power_stiffness(branch, 0.0, 1e5, 1e5), doctest::Contains("low = 0"), Error);
  CHECK_THROWS_WITH_AS((void)power_stiffness(branch, 1e4, 1e5, 1e5, 3), doctest::Contains("levels = 3"),
                       Error);
}
