#include "scree/calibrate/joint_fit.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

using namespace scree;

namespace {

/// What the three experiments of the paper might answer: density in proportion, the modulus with a power of
/// the stiffness, the angle with friction until it levels out; with some noise.
std::vector<double> rock(const std::vector<double>& p, Random& random) {
  const double density = p[0], stiffness = p[1], friction = p[2];
  return {0.58 * density * (1.0 - 0.08 * friction) * (1.0 + 0.003 * random.normal()),
          3.0 * std::pow(stiffness, 0.9) * (1.0 + 0.1 * friction) * (1.0 + 0.03 * random.normal()),
          18.0 + 30.0 * (1.0 - std::exp(-2.0 * friction)) + 0.8 * random.normal()};
}

std::vector<Parameter> space() {
  return {{"particle_density", "kg/m3", 1000.0, 3000.0, true},
          {"normal_stiffness", "N/m", 1e4, 1e6, true},
          {"friction", "", 0.1, 0.9, false}};
}

std::vector<Measured> measured_at(const std::vector<double>& truth, std::uint64_t seed,
                                  std::size_t replicates) {
  Random random{seed, "laboratory"};
  std::vector<Measured> out{{.name = "bulk density", .unit = "kg/m3", .logarithmic = true},
                            {.name = "modulus", .unit = "Pa", .logarithmic = true},
                            {.name = "angle", .unit = "degrees"}};
  for (std::size_t n = 0; n < replicates; ++n) {
    const auto values = rock(truth, random);
    for (std::size_t k = 0; k < out.size(); ++k) {
      out[k].replicates.push_back(values[k]);
    }
  }
  return out;
}

template <class Answer>
RunBatch model_of(Answer answer) {
  return [answer](const std::vector<RunRequest>& requests) {
    std::vector<RunOutcome> outcomes;
    for (const RunRequest& request : requests) {
      Random random{request.seed, "run"};
      outcomes.push_back({answer(request.parameters, random), {}});
    }
    return outcomes;
  };
}

RunOutcome failed(std::string reason) {
  RunOutcome outcome;
  outcome.failure = std::move(reason);
  return outcome;
}

} // namespace

TEST_CASE("hidden-effects: a joint fit finds what data were made with, and its intervals hold as often as "
          "they say") {
  Random random{11};
  std::size_t held = 0, asked = 0;
  double density = 0.0, stiffness = 0.0, friction = 0.0;
  constexpr int draws = 60;
  for (int draw = 0; draw < draws; ++draw) {
    const std::vector<double> truth{random.uniform(1300.0, 2300.0), std::pow(10.0, random.uniform(4.5, 5.5)),
                                    random.uniform(0.25, 0.7)};
    const auto seed = static_cast<std::uint64_t>(100 + draw);
    JointCalibration calibration{space(), measured_at(truth, seed, 10), {.most_runs = 90, .seed = seed}};
    const JointFit fit = calibration.fit(model_of(rock));
    CHECK(fit.runs <= 90);
    CHECK(fit.failed == 0);
    CHECK(fit.undetermined.cols() == 0);
    for (std::size_t k = 0; k < truth.size(); ++k) {
      const Estimate& e = fit.parameters[k];
      CHECK(e.determined);
      held += e.low <= truth[k] && truth[k] <= e.high ? 1 : 0;
      ++asked;
    }
    density += std::pow(fit.parameters[0].value / truth[0] - 1.0, 2) / draws;
    stiffness += std::pow(fit.parameters[1].value / truth[1] - 1.0, 2) / draws;
    friction += std::pow(fit.parameters[2].value - truth[2], 2) / draws;
  }
  MESSAGE("held ", held, " of ", asked, "; rms: density ", std::sqrt(density), ", stiffness ",
          std::sqrt(stiffness), ", friction ", std::sqrt(friction));
  // Of 180 intervals of 90 %, 162 +- 4 hold the truth.
  CHECK(held >= 150);
  CHECK(held <= 175);
  // Ten measurements leave 0.1 % of density, 1 % of stiffness and 0.25 degrees, which is 0.01 of friction.
  CHECK(std::sqrt(density) < 0.002);
  CHECK(std::sqrt(stiffness) < 0.02);
  CHECK(std::sqrt(friction) < 0.02);
}

TEST_CASE("a joint fit is surer of a parameter where it knows that others do not touch the experiment") {
  // Few runs, and grains whose stiffness and friction cannot change what they weigh.
  const auto weighed = [](const std::vector<double>& p, Random& random) -> std::vector<double> {
    return {0.58 * p[0] * (1.0 + 0.01 * random.normal()), rock(p, random)[1]};
  };
  const std::vector<double> truth{1800.0, 1e5, 0.5};
  double knowing = 0.0, ignorant = 0.0; // widths of the intervals of density
  for (std::uint64_t draw = 0; draw < 20; ++draw) {
    Random laboratory{100 + draw};
    std::vector<Measured> measured{{.name = "weight", .logarithmic = true, .kind = "scale"},
                                   {.name = "modulus", .logarithmic = true, .kind = "oedometer"}};
    for (int n = 0; n < 20; ++n) {
      const auto values = weighed(truth, laboratory);
      measured[0].replicates.push_back(values[0]);
      measured[1].replicates.push_back(values[1]);
    }
    for (const bool known : {true, false}) {
      std::vector<Parameter> parameters = space();
      if (known) {
        parameters[1].touches = parameters[2].touches = {"oedometer"};
      }
      JointCalibration calibration{parameters, measured, {.first_runs = 12, .most_runs = 12, .seed = draw}};
      const Estimate density = calibration.fit(model_of(weighed)).parameters.front();
      (known ? knowing : ignorant) += density.high - density.low;
    }
  }
  CAPTURE(knowing);
  CAPTURE(ignorant);
  CHECK(knowing < 0.9 * ignorant);
}

TEST_CASE("a joint fit uses that observables of the same specimens scatter together") {
  // A stiffer or tighter specimen raises the modulus; tightness lowers settlement, stiffness hardly.
  const auto pressed = [](const std::vector<double>& p, Random& random) -> std::vector<double> {
    const double tightness = 0.1 * random.normal();
    return {std::log(p[0]) + tightness + 0.01 * random.normal(),
            -0.2 * std::log(p[0]) - tightness + 0.01 * random.normal()};
  };
  Random random{3};
  double together = 0.0, apart = 0.0;
  std::size_t held = 0;
  constexpr std::size_t draws = 40;
  for (std::size_t draw = 0; draw < draws; ++draw) {
    const double truth = std::pow(10.0, random.uniform(4.5, 5.5));
    Random laboratory{100 + draw};
    std::vector<Measured> measured{{.name = "modulus", .specimens = "oedometer"},
                                   {.name = "settlement", .specimens = "oedometer"}};
    for (int n = 0; n < 6; ++n) {
      const auto values = pressed({truth}, laboratory);
      for (std::size_t k = 0; k < measured.size(); ++k) {
        measured[k].replicates.push_back(values[k]);
      }
    }
    const auto error = [&] {
      JointCalibration calibration{
          {{"normal_stiffness", "N/m", 1e4, 1e6, true}}, measured, {.most_runs = 30, .seed = draw}};
      const Estimate e = calibration.fit(model_of(pressed)).parameters.front();
      held += e.low <= truth && truth <= e.high ? 1 : 0;
      return std::pow(std::log(e.value / truth), 2) / static_cast<double>(draws);
    };
    together += error();
    measured.back().specimens = "another oedometer";
    apart += error();
  }
  MESSAGE("held ", held, " of ", 2 * draws, "; rms ", std::sqrt(together), " together, ", std::sqrt(apart),
          " apart");
  CHECK(std::sqrt(together) < 0.7 * std::sqrt(apart));
  CHECK(held >= 2 * draws * 8 / 10);
}

TEST_CASE("a joint fit goes on where runs fail, and says why they did") {
  const std::vector<double> truth{1800.0, 1e5, 0.45};
  const auto fragile = [](const std::vector<RunRequest>& requests) {
    std::vector<RunOutcome> outcomes;
    for (const RunRequest& request : requests) {
      Random random{request.seed, "run"};
      if (request.parameters[1] > 4e5) {
        outcomes.push_back(failed(message("the lid left its cylinder above ", 4e5, " N/m")));
      } else if (random.uniform() < 0.1) {
        outcomes.push_back({rock(request.parameters, random), {}}); // in part
        outcomes.back().observed[1] = std::nan("");
      } else {
        outcomes.push_back({rock(request.parameters, random), {}});
      }
    }
    return outcomes;
  };
  JointCalibration calibration{space(), measured_at(truth, 5, 10), {.most_runs = 90, .seed = 5}};
  const JointFit fit = calibration.fit(fragile);
  CHECK(fit.failed > 3);
  CHECK(fit.failures.size() == 2);
  CHECK(std::abs(fit.parameters[1].value / truth[1] - 1.0) < 0.1);
  CHECK(std::abs(fit.parameters[2].value - truth[2]) < 0.08);
  const auto broken = [](const std::vector<RunRequest>& requests) {
    return std::vector<RunOutcome>(requests.size(), failed("no"));
  };
  CHECK_THROWS_WITH_AS(JointCalibration(space(), measured_at(truth, 5, 10)).fit(broken),
                       doctest::Contains("too few"), Error);
}

TEST_CASE("a joint fit says what the data cannot determine") {
  const std::vector<double> truth{1800.0, 1e5, 0.45};
  // Only the product of density and (1 - 0.08 friction) is seen.
  const auto density_only = [](const std::vector<RunRequest>& requests) {
    std::vector<RunOutcome> outcomes;
    for (const RunRequest& request : requests) {
      Random random{request.seed, "run"};
      outcomes.push_back({{rock(request.parameters, random)[0]}, {}});
    }
    return outcomes;
  };
  auto measured = measured_at(truth, 5, 10);
  measured.resize(1);
  JointCalibration calibration{space(), measured, {.most_runs = 90, .seed = 5}};
  const JointFit fit = calibration.fit(density_only);
  CHECK(fit.parameters[0].determined);
  CHECK_FALSE(fit.parameters[1].determined);
  CHECK_FALSE(fit.parameters[2].determined);
  CHECK(fit.undetermined.cols() == 2);
  CHECK(fit.parameters[1].low < truth[1]);
  CHECK(fit.parameters[1].high > truth[1]);
  CHECK(fit.correlation(0, 2) > 0.3);
}

TEST_CASE("a joint fit ends when it is as precise as wanted, and is the same for the same seed") {
  const std::vector<double> truth{1800.0, 1e5, 0.45};
  const JointFitSetup setup{.most_runs = 400, .precision = {20.0, 1e4, 0.05}, .seed = 3};
  const auto measured = measured_at(truth, 5, 10);
  const JointFit once = JointCalibration{space(), measured, setup}.fit(model_of(rock));
  const JointFit again = JointCalibration{space(), measured, setup}.fit(model_of(rock));
  CHECK(once.runs < 200);
  CHECK(0.5 * (once.parameters[2].high - once.parameters[2].low) <= 0.05);
  for (std::size_t k = 0; k < truth.size(); ++k) {
    CHECK(once.parameters[k].value == again.parameters[k].value);
    CHECK(once.parameters[k].low == again.parameters[k].low);
  }
}

TEST_CASE("a joint fit refuses what makes no sense") {
  const auto measured = measured_at({1800.0, 1e5, 0.45}, 5, 3);
  CHECK_THROWS_WITH_AS(JointCalibration({{"k", "N/m", 0.0, 1.0, true}}, measured),
                       doctest::Contains("parameter k: bounds 0 to 1 N/m"), Error);
  CHECK_THROWS_WITH_AS(JointCalibration(space(), {{.name = "angle", .replicates = {41.0}}}),
                       doctest::Contains("angle: a single replicate needs an error"), Error);
  CHECK_THROWS_WITH_AS(
      JointCalibration(space(), {{.name = "m", .replicates = {-1.0, 2.0}, .logarithmic = true}}),
      doctest::Contains("replicate -1"), Error);
  CHECK_THROWS_WITH_AS(JointCalibration(space(), measured, {.most_runs = 5}),
                       doctest::Contains("calibration most_runs = 5"), Error);
  CHECK_THROWS_WITH_AS(JointCalibration(space(), measured, {.confidence = 1.0}),
                       doctest::Contains("calibration confidence = 1"), Error);
}

TEST_CASE("Data from beyond a bound: the estimate stands at it and says so, the interval ends there") {
  const std::vector<Parameter> narrow{space()[0], {"normal_stiffness", "N/m", 1e4, 2e5, true}, space()[2]};
  JointCalibration calibration{narrow, measured_at({1600.0, 6e5, 0.5}, 3, 10), {.most_runs = 40}};
  const JointFit fit = calibration.fit(model_of(rock));
  CHECK(fit.parameters[1].at_bound);
  CHECK(fit.parameters[1].value == doctest::Approx(2e5));
  CHECK(fit.parameters[1].high == doctest::Approx(2e5));
  CHECK(fit.parameters[1].low < 2e5);
  CHECK_FALSE(fit.parameters[0].at_bound);
}
