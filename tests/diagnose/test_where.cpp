#include "scree/diagnose/where.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

using namespace scree;

namespace {

/// Two curves of six points and a number, of which a straight model with one parameter simulates all.
struct Bench {
  std::vector<Measured> measured;
  std::vector<Run> runs;

  explicit Bench(const std::vector<double>& excess) {
    for (std::size_t k = 0; k < 13; ++k) {
      const std::string curve = k < 6 ? "loading" : k < 12 ? "unloading" : "";
      measured.push_back({.name = curve + std::to_string(k),
                          .replicates = {1.0 + 0.1 * static_cast<double>(k) + excess[k]},
                          .error = 0.1,
                          .specimens = k < 12 ? "oedometer" : "other",
                          .curve = curve});
    }
    Random random{1};
    for (int r = 0; r < 20; ++r) {
      Run run{Eigen::VectorXd::Constant(1, r / 19.0), Eigen::VectorXd(13)};
      for (Eigen::Index k = 0; k < 13; ++k) {
        run.observed[k] = 0.5 + run.at[0] + 0.1 * static_cast<double>(k) + 1e-3 * random.normal();
      }
      runs.push_back(std::move(run));
    }
  }
  [[nodiscard]] Where where() const {
    const ResponseSurface response{runs};
    const Noise noise{measured, response};
    const Prior prior = Prior::even(1);
    const Eigen::VectorXd at = most_probable(measured, response, prior, Eigen::VectorXd::Constant(1, 0.5));
    const auto predicted = response.predicted(at);
    return where_wrong(noise, measured, {at, predicted.mean, predicted.variance, response.slopes(at)}, prior);
  }
};

} // namespace

TEST_CASE("the stretch of a curve where a model goes wrong is told from its onset to its end") {
  std::vector<double> excess(13, 0.0);
  excess[8] = 0.5;
  excess[9] = 0.9;
  excess[10] = 0.6;
  const Where where = Bench{excess}.where();
  CHECK(where.observable == 9);
  CHECK(where.onset == 8);
  CHECK(where.end == 10);
  CHECK(where.residuals[9] > 5.0);
  CHECK(std::abs(where.residuals[2]) < 0.5 * where.residuals[9]);
}

TEST_CASE("a number by itself has no stretch, and neither has a curve beyond its ends") {
  std::vector<double> excess(13, 0.0);
  excess[12] = -0.8;
  const Where number = Bench{excess}.where();
  CHECK(number.observable == 12);
  CHECK(number.onset == 12);
  CHECK(number.end == 12);
  CHECK(number.residuals[12] < -4.0);

  excess[12] = 0.0;
  excess[5] = excess[6] = 0.7; // the last of one curve and the first of the other
  const Where where = Bench{excess}.where();
  CHECK(where.onset == where.end);
}
