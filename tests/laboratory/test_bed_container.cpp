#include "scree/laboratory/bed_container.hpp"
#include "support/relative_error.hpp"

#include <doctest/doctest.h>

using namespace scree;

TEST_CASE("a box holds its volume and the shaped bed about three quarters of it") {
  const auto box = BedContainer::box(3.0, 0.9, 0.525);
  const auto shaped = BedContainer::shaped(3.0, 0.9, 0.525);
  CHECK(box.volume() == test::about(3.0 * 0.9 * 0.525));
  // Coetzee et al. (2010), section 6.1: 25 % fewer particles than the rectangular bed.
  CHECK(shaped.volume() / box.volume() == test::about(0.75, 0.02));
  CHECK(shaped.deepest() == test::about(0.525));
  CHECK(shaped.shallowest() < 0.25);
}

TEST_CASE("depth is linear between the points of the floor and held beyond its ends") {
  const BedContainer bed{2.0, 1.0, {{0.0, 0.2}, {1.0, 0.6}, {2.0, 0.4}}};
  CHECK(bed.depth_at(0.5) == test::about(0.4));
  CHECK(bed.depth_at(1.5) == test::about(0.5));
  CHECK(bed.depth_at(-1.0) == test::about(0.2));
  CHECK(bed.depth_at(3.0) == test::about(0.4));
}

TEST_CASE("a floor that does not span the bed is refused by name") {
  const BedContainer open{2.0, 1.0, {{0.0, 0.2}, {1.0, 0.6}}};
  CHECK_THROWS_WITH_AS((void)open.surfaces(0), doctest::Contains("from x = 0 to the length 2 m"), Error);
  const BedContainer shallow{2.0, 1.0, {{0.0, 0.2}, {2.0, -0.1}}};
  CHECK_THROWS_WITH_AS((void)shallow.surfaces(0), doctest::Contains("bed floor depth 1 = -0.1 m"), Error);
  const BedContainer narrow{2.0, 0.0, {{0.0, 0.2}, {2.0, 0.1}}};
  CHECK_THROWS_WITH_AS((void)narrow.surfaces(0), doctest::Contains("bed width"), Error);
}
