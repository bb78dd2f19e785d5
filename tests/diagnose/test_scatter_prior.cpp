#include "scree/core/random.hpp"
#include "scree/diagnose/scatter_prior.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

using namespace scree;

namespace {

/// Observables of four specimens each, whose variances are `ratio` times the simulated, give or take what
/// `freedom` degrees allow.
struct Specimens {
  std::vector<Measured> measured;
  Eigen::VectorXd simulated;
};
Specimens specimens(std::size_t observables, double ratio, double freedom, Random& random) {
  Specimens out{{}, Eigen::VectorXd(static_cast<Eigen::Index>(observables))};
  for (std::size_t k = 0; k < observables; ++k) {
    const double simulated = std::exp(random.uniform(-5.0, 5.0));
    out.simulated[static_cast<Eigen::Index>(k)] = simulated;
    const double own = freedom > 1e5 ? 1.0 : freedom / random.chi_squared(freedom);
    Measured m{.name = "x"};
    for (int r = 0; r < 4; ++r) {
      m.replicates.push_back(3.0 + std::sqrt(ratio * simulated * own) * random.normal());
    }
    out.measured.push_back(m);
  }
  return out;
}

} // namespace

TEST_CASE("how alike measured and simulated scatter are is seen from many observables") {
  Random random{1};
  for (const double freedom : {3.0, 8.0}) {
    CAPTURE(freedom);
    const Specimens s = specimens(20000, 2.5, freedom, random);
    const ScatterPrior prior = ScatterPrior::seen_from(s.measured, s.simulated);
    // The few that are left out as too far off take some of the tails with them.
    CHECK(prior.freedom == doctest::Approx(freedom).epsilon(0.25));
    CHECK(prior.ratio == doctest::Approx(2.5).epsilon(0.15));
  }
  const Specimens alike = specimens(20000, 0.5, 1e6, random);
  const ScatterPrior prior = ScatterPrior::seen_from(alike.measured, alike.simulated);
  CHECK(prior.freedom == doctest::Approx(ScatterPrior::most_freedom).epsilon(0.3));
  CHECK(prior.ratio == doctest::Approx(0.5).epsilon(0.1));
}

TEST_CASE("scatter that simulations lack is left alone, and too few observables tell nothing") {
  Random random{2};
  Specimens s = specimens(12, 1.0, 1e6, random);
  s.simulated[3] = 1e-20;
  const ScatterPrior prior = ScatterPrior::seen_from(s.measured, s.simulated);
  CHECK_FALSE(prior.holds[3]);
  CHECK(std::count(prior.holds.begin(), prior.holds.end(), true) >= 10);
  CHECK(prior.ratio > 0.4);
  CHECK(prior.ratio < 2.5);

  const Specimens few = specimens(4, 1.0, 1e6, random);
  const ScatterPrior none = ScatterPrior::seen_from(few.measured, few.simulated);
  CHECK(std::count(none.holds.begin(), none.holds.end(), true) == 0);

  s.measured[5].error = 0.1; // known beforehand
  CHECK_FALSE(ScatterPrior::seen_from(s.measured, s.simulated).holds[5]);
}
