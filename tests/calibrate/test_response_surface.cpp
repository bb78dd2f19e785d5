#include "scree/calibrate/response_surface.hpp"
#include "scree/core/random.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <vector>

using namespace scree;

namespace response_surface_tests {

namespace {

/// A plane, a bend, and the two with a sign changed; the noises of the first and the last are alike.
Eigen::VectorXd answer(const Eigen::VectorXd& x) {
  const double plane = 3.0 + 2.0 * x[0] - x[1], bend = std::exp(-2.0 * x[0]) + 0.5 * x[0] * x[1];
  return Eigen::Vector3d{plane, bend, -plane};
}
constexpr double noise = 0.05;

std::vector<Run> runs(std::size_t count, std::uint64_t seed) {
  Random random{seed};
  std::vector<Run> out;
  for (std::size_t k = 0; k < count; ++k) {
    Run run{Eigen::Vector2d{random.uniform(), random.uniform()}, {}};
    const double common = noise * random.normal();
    run.observed = answer(run.at) + Eigen::Vector3d{common, noise * random.normal(), common};
    out.push_back(std::move(run));
  }
  return out;
}

} // namespace

TEST_CASE("a response surface predicts what runs answer between them, and knows how well") {
  constexpr std::size_t surfaces = 40, count = 40;
  const Eigen::Vector2d there{0.4, 0.6};
  Eigen::Vector3d error2 = Eigen::Vector3d::Zero(), claimed2 = Eigen::Vector3d::Zero();
  Eigen::Vector3d seen = Eigen::Vector3d::Zero();
  double correlated = 0.0, slope2 = 0.0;
  for (std::size_t k = 0; k < surfaces; ++k) {
    const ResponseSurface surface{runs(count, k)};
    const auto predicted = surface.predicted(there);
    error2 += (predicted.mean - answer(there)).cwiseAbs2() / surfaces;
    claimed2 += predicted.variance / surfaces;
    seen += surface.noise() / surfaces;
    correlated += surface.correlation()(0, 2) / surfaces;
    CHECK(surface.correlation()(1, 1) == 1.0);
    CHECK(std::abs(surface.correlation()(0, 1)) < 0.7);
    const Eigen::MatrixXd slopes = surface.slopes(there);
    slope2 += std::pow(slopes(1, 0) - (-2.0 * std::exp(-0.8) + 0.3), 2) / surfaces;
    CHECK(slopes(0, 0) == doctest::Approx(2.0).epsilon(0.15));
  }
  for (Eigen::Index m = 0; m < 3; ++m) {
    // A plane of 40 runs knows its middle to 0.17 of their noise, a bent surface less well.
    CHECK(std::sqrt(error2[m]) < 0.5 * noise);
    CHECK(std::sqrt(claimed2[m] / error2[m]) > 0.7);
    CHECK(std::sqrt(claimed2[m] / error2[m]) < 1.6);
    CHECK(std::sqrt(seen[m]) == doctest::Approx(noise).epsilon(0.1));
  }
  CHECK(correlated > 0.95);
  CHECK(std::sqrt(slope2) < 0.3);
}

TEST_CASE("a response surface passes through runs without noise") {
  std::vector<Run> exact = runs(30, 7);
  for (Run& run : exact) {
    run.observed = answer(run.at);
  }
  const ResponseSurface surface{exact};
  for (const Run& run : exact) {
    CHECK((surface.predicted(run.at).mean - run.observed).norm() < 2e-3);
  }
  CHECK((surface.predicted(Eigen::Vector2d{0.5, 0.5}).mean - answer(Eigen::Vector2d{0.5, 0.5})).norm() <
        5e-3);
  CHECK(std::abs(surface.slopes(Eigen::Vector2d{0.5, 0.5})(0, 1) + 1.0) < 1e-6);
}

TEST_CASE("a response surface refuses too few runs") {
  CHECK_THROWS_WITH_AS(ResponseSurface{runs(4, 1)}, doctest::Contains("4 runs came to an end, too few for 2"),
                       Error);
  CHECK_THROWS_WITH_AS(ResponseSurface{std::vector<Run>{}}, doctest::Contains("too few"), Error);
}

TEST_CASE("what some runs do not show is left out for that observable alone") {
  std::vector<Run> some = runs(30, 8), without;
  for (std::size_t k = 0; k < some.size(); ++k) {
    if (k % 4 == 1) {
      some[k].observed[1] = std::nan("");
    } else {
      without.push_back(some[k]);
    }
  }
  const Eigen::Vector2d there{0.4, 0.6};
  const auto all = ResponseSurface{runs(30, 8)}.predicted(there),
             part = ResponseSurface{some}.predicted(there), fewer = ResponseSurface{without}.predicted(there);
  CHECK(part.mean[0] == all.mean[0]);
  CHECK(part.mean[1] == fewer.mean[1]);
  CHECK(part.variance[1] == fewer.variance[1]);
}

TEST_CASE("a part of the surfaces is what its observables alone give") {
  const std::vector<Run> both = runs(30, 9);
  std::vector<Run> second = both;
  for (Run& run : second) {
    run.observed = run.observed.tail(2).eval();
  }
  const ResponseSurface part = ResponseSurface{both}.part(1, 2), alone{second};
  const Eigen::Vector2d there{0.4, 0.6};
  CHECK((part.predicted(there).mean - alone.predicted(there).mean).norm() < 1e-12);
  CHECK((part.predicted(there).variance - alone.predicted(there).variance).norm() < 1e-14);
  CHECK((part.slopes(there) - alone.slopes(there)).norm() < 1e-12);
  CHECK(part.freedom() == doctest::Approx(alone.freedom()).epsilon(1e-12));
  CHECK((part.noise() - alone.noise()).norm() < 1e-14);
  CHECK((part.correlation() - alone.correlation()).norm() < 1e-12);
}

} // namespace response_surface_tests
