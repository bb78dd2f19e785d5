#include "scree/calibrate/one_by_one.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

using namespace scree;

namespace one_by_one_tests {

namespace {

/// What the paper's three experiments might answer; every packing (seed) is off by a factor of its own.
std::vector<double> rock(const std::vector<double>& p, std::uint64_t seed) {
  Random packing{seed, "packing"};
  const double density = p[0], stiffness = p[1], friction = p[2];
  return {0.58 * density * (1.0 - 0.08 * friction + 2e-9 * stiffness) * (1.0 + 0.005 * packing.normal()),
          3.0 * std::pow(stiffness, 0.9) * (1.0 + 0.1 * friction) * (1.0 + 0.05 * packing.normal()),
          18.0 + 30.0 * (1.0 - std::exp(-2.0 * friction)) + 0.3 * packing.normal()};
}

std::vector<Parameter> space() {
  return {{"particle_density", "kg/m3", 1000.0, 3000.0, true},
          {"normal_stiffness", "N/m", 1e4, 1e6, true},
          {"friction", "", 0.1, 0.9, false}};
}

std::vector<Measured> of(const std::vector<double>& values) {
  return {{"bulk density", "kg/m3", {values[0]}, 1e-3 * values[0], true},
          {"modulus", "Pa", {values[1]}, 1e-2 * values[1], true},
          {"angle", "degrees", {values[2]}, 0.1, false}};
}

std::vector<FitStep> steps() {
  return {{0, 0, 1e-3, 4}, {1, 1, 1e-2, 6}, {2, 2, 0.1, 6}};
}

RunBatch model() {
  return [](const std::vector<RunRequest>& requests) {
    std::vector<RunOutcome> outcomes;
    for (const RunRequest& request : requests) {
      outcomes.push_back({rock(request.parameters, request.seed), {}});
    }
    return outcomes;
  };
}

} // namespace

TEST_CASE("one by one meets what was measured in two rounds, the density in at most four iterations") {
  for (const std::vector<double>& truth :
       {std::vector<double>{1500.0, 8e4, 0.35}, {2400.0, 3e5, 0.6}, {1100.0, 3e4, 0.2}}) {
    CAPTURE(truth[0]);
    OneByOneCalibration calibration{space(), of(rock(truth, 77)), steps(), {.replicates = 20}};
    const OneByOneFit fit = calibration.fit({1800.0, 1e5, 0.5}, model());
    CHECK(fit.converged);
    CHECK(fit.failed == 0);
    std::size_t density_iterations = 0;
    for (const FitIteration& i : fit.history) {
      density_iterations += i.step == 0 && i.round == 0 ? 1 : 0;
    }
    CHECK(density_iterations <= 4);
    CHECK(fit.runs == 20 * fit.history.size());
    // The packing that was measured is itself off by 0.5 %, 5 % and 0.3 degrees.
    CHECK(fit.parameters[0] == doctest::Approx(truth[0]).epsilon(0.03));
    CHECK(fit.parameters[1] == doctest::Approx(truth[1]).epsilon(0.15));
    CHECK(std::abs(fit.parameters[2] - truth[2]) < 0.05);
    // Packings differ by 0.5 % and 5 %; in degrees by 0.3.
    for (const FitIteration& i : fit.history) {
      const double single = i.step == 0 ? 0.005 : i.step == 1 ? 0.05 : 0.3;
      CHECK(i.error == doctest::Approx(single / std::sqrt(20.0)).epsilon(0.4));
    }
    // The last row of each step is what its tolerance says.
    for (std::size_t s = 0; s < 3; ++s) {
      double last = 1.0;
      for (const FitIteration& i : fit.history) {
        last = i.step == s ? i.deviation : last;
      }
      CHECK(std::abs(last) <= steps()[s].tolerance);
    }
  }
}

TEST_CASE("one by one says where it found nothing, and stays within the bounds") {
  // No friction of the space gives 60 degrees.
  OneByOneCalibration calibration{space(), of({870.0, 6e4, 60.0}), steps()};
  const OneByOneFit fit = calibration.fit({1800.0, 1e5, 0.5}, model());
  CHECK_FALSE(fit.converged);
  CHECK(fit.parameters[2] == doctest::Approx(0.9));
}

TEST_CASE("one by one takes the mean of the runs that came to an end, and needs one") {
  std::size_t asked = 0;
  const auto fragile = [&asked](const std::vector<RunRequest>& requests) {
    std::vector<RunOutcome> outcomes = model()(requests);
    for (RunOutcome& outcome : outcomes) {
      if (asked++ % 4 == 0) {
        outcome.failure = "it burst";
      }
    }
    return outcomes;
  };
  OneByOneCalibration calibration{space(), of(rock({1500.0, 8e4, 0.35}, 3)), steps()};
  const OneByOneFit fit = calibration.fit({1800.0, 1e5, 0.5}, fragile);
  CHECK(fit.failed * 4 == fit.runs);
  const auto broken = [](const std::vector<RunRequest>& requests) {
    RunOutcome burst;
    burst.failure = "it burst";
    return std::vector<RunOutcome>(requests.size(), burst);
  };
  CHECK_THROWS_WITH_AS(calibration.fit({1800.0, 1e5, 0.5}, broken),
                       doctest::Contains("all 4 runs for bulk density failed: it burst"), Error);
}

TEST_CASE("one by one refuses what makes no sense") {
  const auto measured = of({870.0, 6e4, 30.0});
  CHECK_THROWS_WITH_AS((OneByOneCalibration{space(), measured, {}}), doctest::Contains("there is no step"),
                       Error);
  CHECK_THROWS_WITH_AS((OneByOneCalibration{space(), measured, {{3, 0}}}),
                       doctest::Contains("parameter 3 of 3"), Error);
  CHECK_THROWS_WITH_AS((OneByOneCalibration{space(), measured, {{0, 0, 0.0}}}),
                       doctest::Contains("tolerance = 0"), Error);
  OneByOneCalibration calibration{space(), measured, steps()};
  CHECK_THROWS_WITH_AS(calibration.fit({1800.0, 1e5, 0.95}, model()),
                       doctest::Contains("start of friction = 0.95"), Error);
  CHECK_THROWS_WITH_AS(calibration.fit({1800.0}, model()), doctest::Contains("1 start values for 3"), Error);
}

} // namespace one_by_one_tests
