#include "scree/calibrate/reach.hpp"
#include "scree/calibrate/response_surface.hpp"
#include "scree/core/random.hpp"

#include <Eigen/Core>

#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

using namespace scree;

namespace {

/// A weight that the first parameter makes, and an angle that all three make.
std::vector<Run> runs(std::size_t count, std::uint64_t seed) {
  Random random{seed, "runs"};
  std::vector<Run> out;
  for (std::size_t r = 0; r < count; ++r) {
    const Eigen::Vector3d at{random.uniform(), random.uniform(), random.uniform()};
    out.push_back({at, Eigen::Vector2d{3.0 + at[0] + 0.1 * random.normal(),
                                       at[0] - at[1] + std::sin(3.0 * at[2]) + 0.1 * random.normal()}});
  }
  return out;
}

} // namespace

TEST_CASE("parameters reach the kinds of experiment that they name, and unnamed ones all") {
  const std::vector<Parameter> parameters{{.name = "density"},
                                          {.name = "friction", .touches = {"heap", "box"}},
                                          {.name = "rope", .touches = {"drag"}}};
  const std::vector<Measured> observables{{.name = "weight", .kind = "scales"},
                                          {.name = "angle", .kind = "heap"},
                                          {.name = "force", .kind = "drag"},
                                          {.name = "of an unknown kind"}};
  CHECK(reach_of(parameters, observables) == Reach{{0}, {0, 1}, {0, 2}, {0, 1, 2}});
}

TEST_CASE("a parameter that cannot change an observable neither moves nor blurs it") {
  const std::vector<Run> made = runs(24, 3);
  const ResponseSurface knowing{made, {}, Reach{{0}, {0, 1, 2}}}, ignorant{made};
  std::vector<Run> without = made;
  for (Run& run : without) {
    run.at = run.at.head(1).eval();
  }
  const ResponseSurface alone{without};
  const Eigen::Vector3d near{0.3, 0.2, 0.7}, far{0.3, 0.9, 0.0};
  const auto there = knowing.predicted(near), elsewhere = knowing.predicted(far);
  CHECK(there.mean[0] == elsewhere.mean[0]);
  CHECK(there.variance[0] == elsewhere.variance[0]);
  CHECK(there.mean[0] == alone.predicted(near.head(1)).mean[0]);
  CHECK(there.variance[0] < ignorant.predicted(near).variance[0]);
  CHECK(knowing.noise()[0] == alone.noise()[0]);
  // The other observable is as it was.
  CHECK(there.mean[1] == ignorant.predicted(near).mean[1]);
  CHECK(there.mean[1] != elsewhere.mean[1]);

  const Eigen::MatrixXd slopes = knowing.slopes(near);
  CHECK(slopes(0, 0) == alone.slopes(near.head(1))(0, 0));
  CHECK(slopes(0, 1) == 0.0);
  CHECK(slopes(0, 2) == 0.0);
  CHECK(slopes.row(1) == ignorant.slopes(near).row(1));
  const std::vector<Eigen::Index> backwards{2, 0};
  CHECK(knowing.slopes(near, backwards)(0, 0) == 0.0);
  CHECK(knowing.slopes(near, backwards)(0, 1) == slopes(0, 0));
}

TEST_CASE("effects that cannot change an observable leave those that can") {
  std::vector<Run> made = runs(40, 4);
  const Eigen::VectorXd null = Eigen::Vector2d{0.5, 0.0};
  for (std::size_t r = 0; r < made.size(); ++r) { // one effect at work in each
    made[r].at[r % 2 == 0 ? 1 : 2] = null[r % 2 == 0 ? 0 : 1];
  }
  const ResponseSurface knowing{made, null, Reach{{0, 2}, {0, 1, 2}}};
  std::vector<Run> without = made;
  for (Run& run : without) {
    run.at = Eigen::Vector2d{run.at[0], run.at[2]};
  }
  const ResponseSurface alone{without, null.tail(1)};
  const Eigen::Vector3d there{0.3, 0.8, 0.6};
  CHECK(knowing.predicted(there).mean[0] == alone.predicted(Eigen::Vector2d{0.3, 0.6}).mean[0]);
  CHECK(knowing.slopes(there)(0, 2) == alone.slopes(Eigen::Vector2d{0.3, 0.6})(0, 1));
}

TEST_CASE("an observable that no parameter can change is its mean") {
  const std::vector<Run> made = runs(12, 5);
  const ResponseSurface surface{made, {}, Reach{{}, {0, 1, 2}}};
  double sum = 0.0;
  for (const Run& run : made) {
    sum += run.observed[0];
  }
  const auto there = surface.predicted(Eigen::Vector3d{0.1, 0.5, 0.9});
  CHECK(there.mean[0] == doctest::Approx(sum / 12.0).epsilon(1e-9));
  CHECK(there.variance[0] == doctest::Approx(surface.noise()[0] / 12.0).epsilon(1e-6));
  CHECK(surface.slopes(Eigen::Vector3d{0.1, 0.5, 0.9}).row(0).norm() == 0.0);
}
