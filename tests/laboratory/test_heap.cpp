#include "scree/laboratory/heap.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numbers>

using namespace scree;

namespace {

constexpr double degree = std::numbers::pi / 180.0;

HeapSetup small_heap(HeapSetup::Method method) {
  HeapSetup setup = desk_heap();
  setup.method = method;
  setup.tube = {.radius = 0.11, .height = 0.15};
  setup.lift_speed = 0.4;
  setup.funnel.solid = 0.002;
  setup.threads = 1;
  return setup;
}

} // namespace

TEST_CASE("physics: rock of more friction makes a steeper heap") {
  const auto of = [](double friction) {
    HeapSetup setup = small_heap(HeapSetup::Method::lifted_cylinder);
    setup.sample.rock.friction = friction;
    return HeapTest<>{setup};
  };
  HeapTest<> smooth = of(0.15), rough = of(0.7);
  smooth.run();
  rough.run();
  const HeapAngle &low = smooth.result().flank, &high = rough.result().flank;
  CAPTURE(low.angle / degree);
  CAPTURE(high.angle / degree);
  CHECK(high.angle > low.angle + 2.0 * (low.standard_error + high.standard_error));
  CHECK(high.angle < 50.0 * degree);
  CHECK(rough.result().unrest.within(rough.setup().rest));
}

TEST_CASE("physics: a funnel empties onto the plate, and no grain is lost") {
  // One such heap has 11 to 22 degrees.
  constexpr std::uint64_t heaps = 4;
  double angles = 0.0;
  for (std::uint64_t seed = 1; seed <= heaps; ++seed) {
    CAPTURE(seed);
    HeapSetup setup = small_heap(HeapSetup::Method::funnel);
    setup.seed = seed;
    HeapTest<> test{setup};
    std::size_t most = 0;
    const HeapResult& r =
        test.run([&](const auto& s, const Stage&) { most = std::max(most, s.bodies().size()); });
    CHECK(r.grains == most);
    CHECK(r.flow_time > 0.1);
    angles += r.flank.angle;
    for (std::size_t b = 0; b < test.simulation().bodies().size(); ++b) {
      CHECK(test.simulation().bodies().position(b).z() > 0.0);
      CHECK(test.simulation().bodies().position(b).z() < 0.2);
    }
  }
  CHECK(angles / static_cast<double>(heaps) > 12.0 * degree);
  CHECK(angles / static_cast<double>(heaps) < 40.0 * degree);
}

TEST_CASE("both heaps can be made of the paper's rock, with the default funnel and tube") {
  for (const auto method : {HeapSetup::Method::funnel, HeapSetup::Method::lifted_cylinder}) {
    HeapSetup setup;
    setup.method = method;
    CHECK_NOTHROW(HeapTest<>{setup});
  }
}

TEST_CASE("physics: a heap that grows up to its funnel is no heap") {
  HeapSetup setup = small_heap(HeapSetup::Method::funnel);
  setup.funnel.clearance = 0.04;
  setup.funnel.lift_speed = 0.0;
  setup.patience = 0.3;
  CHECK_THROWS_WITH_AS(HeapTest<>{setup}.run(), doctest::Contains("the heap has grown up to it"), Error);
}

TEST_CASE("HeapTest refuses what cannot be done") {
  HeapSetup setup = small_heap(HeapSetup::Method::funnel);
  setup.funnel.rim = setup.funnel.outlet;
  CHECK_THROWS_WITH_AS(HeapTest<>{setup}, doctest::Contains("funnel rim = 0.12 m must be above"), Error);
  setup = small_heap(HeapSetup::Method::funnel);
  setup.lift_speed = 0.0;
  CHECK_THROWS_WITH_AS(HeapTest<>{setup}, doctest::Contains("heap lift_speed = 0"), Error);
  setup = small_heap(HeapSetup::Method::funnel);
  setup.funnel.outlet = 0.05;
  CHECK_THROWS_WITH_AS(HeapTest<>{setup}, doctest::Contains("funnel outlet = 0.05 m: an opening of less"),
                       Error);
  setup = small_heap(HeapSetup::Method::lifted_cylinder);
  setup.tube.radius = 0.05;
  CHECK_THROWS_WITH_AS(HeapTest<>{setup}, doctest::Contains("tube radius = 0.05 m"), Error);
}
