#include "scree/core/random.hpp"
#include "sensitivity/trend.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <vector>

using namespace scree;
using namespace scree::examples;

TEST_CASE("a mean of runs and its standard error") {
  const Mean mean = mean_of_runs(std::vector{1.0, 2.0, 6.0});
  CHECK(mean.value == doctest::Approx(3.0));
  CHECK(mean.error == doctest::Approx(std::sqrt((4.0 + 1.0 + 9.0) / 2.0 / 3.0)));
  CHECK_THROWS_AS(mean_of_runs(std::vector{1.0}), Error);
}

TEST_CASE("a trend is the exponent of a power law, whatever the levels") {
  std::vector<Level> levels;
  for (const double x : {0.25, 0.5, 3.0}) {
    levels.push_back({x, std::vector(levels.size() + 2, 7.0 * std::pow(x, -0.3))});
  }
  const Trend found = trend(levels);
  CHECK(found.exponent == doctest::Approx(-0.3));
  CHECK(found.error == doctest::Approx(0.0).epsilon(1e-7));
  CHECK(found.change == doctest::Approx(std::pow(12.0, -0.3) - 1.0));
}

TEST_CASE("the standard errors of a trend are how much it scatters") {
  Random random{1, "trend"};
  constexpr int sets = 2000;
  double off = 0.0, expected = 0.0, off_change = 0.0, expected_change = 0.0;
  for (int set = 0; set < sets; ++set) {
    std::vector<Level> levels;
    for (const double x : {1.0, 2.0, 8.0}) {
      Level level{.parameter = x};
      for (std::size_t k = 0; k < 3; ++k) {
        level.observed.push_back(std::pow(x, 0.5) * std::exp(0.05 * random.normal()));
      }
      levels.push_back(level);
    }
    const Trend found = trend(levels);
    off += std::pow(found.exponent - 0.5, 2) / sets;
    expected += found.error * found.error / sets;
    off_change += std::pow(found.change - (std::sqrt(8.0) - 1.0), 2) / sets;
    expected_change += found.change_error * found.change_error / sets;
  }
  CHECK(expected == doctest::Approx(off).epsilon(0.1));
  CHECK(expected_change == doctest::Approx(off_change).epsilon(0.1));
}

TEST_CASE("a bend is no scatter") {
  const std::vector<Level> levels{{1.0, {1.0, 1.0}}, {2.0, {5.0, 5.0}}, {4.0, {1.0, 1.0}}};
  CHECK(trend(levels).error == 0.0);
}

TEST_CASE("no trend without two levels of two runs, all above zero") {
  CHECK_THROWS_AS(trend(std::vector<Level>{{1.0, {1.0, 2.0}}}), Error);
  CHECK_THROWS_AS(trend(std::vector<Level>{{1.0, {1.0}}, {2.0, {1.0, 2.0}}}), Error);
  CHECK_THROWS_AS(trend(std::vector<Level>{{0.0, {1.0, 2.0}}, {2.0, {1.0, 2.0}}}), Error);
  CHECK_THROWS_AS(trend(std::vector<Level>{{1.0, {-1.0, 2.0}}, {2.0, {1.0, 2.0}}}), Error);
  CHECK_THROWS_AS(trend(std::vector<Level>{{2.0, {1.0, 2.0}}, {2.0, {1.0, 2.0}}}), Error);
}
