#include "scree/calibrate/effects_kernel.hpp"
#include "scree/calibrate/response_surface.hpp"
#include "scree/core/random.hpp"

#include <doctest/doctest.h>

#include <Eigen/Dense>

#include <cmath>
#include <cstddef>
#include <vector>

using namespace scree;

namespace {

constexpr EffectsKernel::Shape shape{.length = 0.7, .ratio = 3.0, .effect_length = 0.4, .strength = 1.5};

Eigen::VectorXd nulls() {
  return Eigen::Vector3d{0.0, 0.3, 1.0};
}
/// Two coordinates and three effects of which two are active, each at another place.
std::vector<Eigen::VectorXd> places(std::size_t count, std::uint64_t seed) {
  Random random{seed};
  std::vector<Eigen::VectorXd> out;
  for (std::size_t k = 0; k < count; ++k) {
    Eigen::VectorXd at(5);
    at << random.uniform(), random.uniform(), nulls();
    for (std::size_t active = 0; active < k % 3; ++active) {
      at[2 + static_cast<Eigen::Index>((k + active) % 3)] = random.uniform();
    }
    out.push_back(at);
  }
  return out;
}
Eigen::MatrixXd rows(const std::vector<Eigen::VectorXd>& places) {
  Eigen::MatrixXd out(static_cast<Eigen::Index>(places.size()), places.front().size());
  for (Eigen::Index r = 0; r < out.rows(); ++r) {
    out.row(r) = places[static_cast<std::size_t>(r)].transpose();
  }
  return out;
}

/// A base, a kinked effect whose size depends on the base, one that multiplies it, and a third.
double answer(const Eigen::VectorXd& x) {
  const double kinked = std::tanh(4.0 * x[2]) * (1.0 + x[0]), times = 1.0 + 0.8 * (x[3] - 0.3);
  return std::sin(2.0 * x[0]) + x[1] + kinked * times + (1.0 - x[4]) * x[1] + times;
}

} // namespace

TEST_CASE("a kernel of effects is symmetric and positive, and its variance is its diagonal") {
  const auto at = places(40, 3);
  const EffectsKernel kernel{shape, nulls(), rows(at)};
  Eigen::MatrixXd covariance(40, 40);
  for (Eigen::Index k = 0; k < 40; ++k) {
    const Eigen::VectorXd& there = at[static_cast<std::size_t>(k)];
    covariance.col(k) = kernel.covariance(there);
    CHECK(covariance(k, k) == doctest::Approx(kernel.variance(there)).epsilon(1e-14));
  }
  CHECK((covariance - covariance.transpose()).norm() < 1e-12 * covariance.norm());
  CHECK(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>{covariance}.eigenvalues().minCoeff() >
        -1e-10 * covariance.norm());
}

TEST_CASE("effects at their null values change no covariance, and their strength none of what lacks them") {
  const auto at = places(40, 4);
  const EffectsKernel kernel{shape, nulls(), rows(at)};
  Eigen::VectorXd null(5);
  null << 0.2, 0.8, nulls();
  const Eigen::VectorXd with = kernel.covariance(null);
  const EffectsKernel plain{{.length = shape.length, .ratio = shape.ratio}, {}, rows(at).leftCols(2)};
  CHECK((with - plain.covariance(null.head(2))).norm() == 0.0);
  CHECK(kernel.variance(null) == shape.ratio * shape.ratio);
}

TEST_CASE("slopes of a kernel are its differences, at null values and away from them") {
  const auto at = places(20, 5);
  const EffectsKernel kernel{shape, nulls(), rows(at)};
  constexpr double step = 1e-5;
  for (const Eigen::VectorXd& there : places(6, 6)) {
    const std::vector<Eigen::Index> along{4, 1, 3, 0, 2};
    const Eigen::MatrixXd slopes = kernel.slopes(there, along);
    for (std::size_t a = 0; a < along.size(); ++a) {
      const Eigen::Index k = along[a];
      const Eigen::VectorXd aside = step * Eigen::VectorXd::Unit(there.size(), k);
      const Eigen::VectorXd difference =
          (kernel.covariance(there + aside) - kernel.covariance(there - aside)) / (2.0 * step);
      CHECK((slopes.col(static_cast<Eigen::Index>(a)) - difference).norm() <
            1e-8 * (1.0 + difference.norm()));
    }
  }
}

TEST_CASE("a response surface that knows where effects vanish predicts them better") {
  constexpr double noise = 0.02;
  Random random{7};
  std::vector<Run> runs;
  for (const Eigen::VectorXd& at : places(90, 8)) {
    runs.push_back({at, Eigen::VectorXd::Constant(1, answer(at) + noise * random.normal())});
  }
  const ResponseSurface knowing{runs, nulls()}, ignorant{runs};
  double of_knowing = 0.0, of_ignorant = 0.0, claimed = 0.0;
  constexpr std::size_t count = 60;
  for (const Eigen::VectorXd& there : places(count, 9)) {
    const auto predicted = knowing.predicted(there);
    of_knowing += std::pow(predicted.mean[0] - answer(there), 2) / count;
    of_ignorant += std::pow(ignorant.predicted(there).mean[0] - answer(there), 2) / count;
    claimed += predicted.variance[0] / count;
  }
  CHECK(std::sqrt(of_knowing) < 0.7 * std::sqrt(of_ignorant));
  CHECK(std::sqrt(claimed / of_knowing) > 0.5);
  CHECK(std::sqrt(claimed / of_knowing) < 2.0);
}
