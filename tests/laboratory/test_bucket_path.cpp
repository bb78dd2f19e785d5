#include "scree/laboratory/bucket_path.hpp"
#include "scree/laboratory/digging_path.hpp"
#include "scree/measure/attitude.hpp"
#include "support/relative_error.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

using namespace scree;

namespace {

const BucketFloor level{.heel = -0.1, .lip = 0.15, .underside = -0.05};

std::string refusal(const std::vector<PathPoint>& points) {
  try {
    const BucketPath path{points};
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

} // namespace

TEST_CASE("a path goes through its points, turns where they do, and straight on beyond its end") {
  const BucketPath path{
      {{0, 0, 0}, {0.1, 0.05, 0.0}, {0.3, -0.1, 0.02}, {0.5, -0.1, 0.04}, {1.0, 0.0, 0.06}}};
  CHECK(path.length() == 1.0);
  CHECK(path.at(0.3).pitch == test::about(-0.1));
  CHECK(path.at(0.3).depth == test::about(0.02));
  double most = 0.0, least = 0.0;
  for (int k = 0; k <= 1000; ++k) {
    most = std::max(most, path.at(0.001 * k).pitch);
    least = std::min(least, path.at(0.001 * k).pitch);
  }
  CHECK(most == test::about(0.05));
  CHECK(least == test::about(-0.1));
  const double slope = path.at(1.2).depth - path.at(1.1).depth;
  CHECK(path.at(1.3).depth - path.at(1.2).depth == test::about(slope));
  CHECK(path.at(1.0).depth == test::about(0.06));
}

TEST_CASE("points that make no path are refused by what is wrong with them") {
  CHECK(refusal({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}).find("needs 4 points or more, not 3") !=
        std::string::npos);
  CHECK(refusal({{0, 0.1, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}).find("first point") != std::string::npos);
  CHECK(refusal({{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {3, 0, 0}}).find("point 2: drag = 1 m must be above 1 m") !=
        std::string::npos);
  CHECK(refusal({{0, 0, 0}, {1, 2, 0}, {2, 0, 0}, {3, 0, 0}}).find("point 1: pitch = 2 rad") !=
        std::string::npos);
}

TEST_CASE("rows in which the bucket sprang back are left out of its recorded path") {
  const std::vector<DragRow> rows{{.drag = 0.0},
                                  {.drag = 0.1, .pitch = 0.1},
                                  {.drag = 0.05, .pitch = 9.0},
                                  {.drag = 0.2, .pitch = 0.2},
                                  {.drag = 0.3, .pitch = 0.3}};
  const BucketPath path = recorded_path(rows);
  CHECK(path.at(0.05).pitch == test::about(0.05));
  CHECK(path.at(0.2).pitch == test::about(0.2));
}

TEST_CASE("a bucket with its lip up rides on its heel") {
  const double up = 0.05;
  const BucketPath path = digging_path([&](double drag) { return drag > 0.0 ? up : 0.0; }, 1.0, level);
  // The heel stays at its height: the centre is raised by how far it is ahead of it.
  CHECK(-path.at(0.8).depth == test::about(0.1 * std::sin(up) - 0.05 * (1.0 - std::cos(up))));
}

TEST_CASE("with its lip down a bucket stays on its heel for one length, then goes along its own floor") {
  const double down = 0.1, length = 0.25;
  const BucketPath path = digging_path([&](double drag) { return drag > 0.0 ? -down : 0.0; }, 1.0, level);
  const double at_first = 0.1 * std::sin(down) + 0.05 * (1.0 - std::cos(down));
  CHECK(path.at(0.2).depth == test::about(at_first));
  // One length further on it is deeper by what the floor falls over its length.
  for (const double drag : {0.45, 0.6, 0.75}) {
    CHECK(path.at(drag + length).depth - path.at(drag).depth == test::about(length * std::sin(down)));
  }
  CHECK_THROWS_AS(digging_path([](double) { return 0.0; }, 1.0, BucketFloor{0.1, 0.1, -0.05}), Error);
}

TEST_CASE("an orientation has the angles that it was made of") {
  const Attitude angles{.pitch = -0.3, .roll = 0.2, .yaw = 0.7};
  const Attitude found = attitude(orientation(angles));
  CHECK(found.pitch == test::about(angles.pitch));
  CHECK(found.roll == test::about(angles.roll));
  CHECK(found.yaw == test::about(angles.yaw));
}
