#include "scree/laboratory/immersion.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

using namespace scree;

namespace {

/// Two spheres that overlap by half a radius.
RockSample pairs(MassConvention convention) {
  const Clump shape =
      make_clump("pair", std::vector<Sphere>{{{-0.75, 0.0, 0.0}, 1.0}, {{0.75, 0.0, 0.0}, 1.0}}, convention);
  const SieveCurve sizes{{0.01, 0.04}, {0.0, 1.0}, SieveBasis::mass};
  return {Assembly{{{shape, 1.0, sizes}}}, paper_material(), {}};
}

} // namespace

TEST_CASE(
    "rock that is weighed in water has the density of its particles, or what counting overlaps twice adds") {
  const double density = paper_material().density;
  const ImmersionResult solid =
      immerse({.sample = pairs(MassConvention::union_of_spheres), .grains = 50, .seed = 3});
  CHECK(solid.solid_density == doctest::Approx(density).epsilon(1e-9));
  CHECK(solid.batches.size() == 50);
  CHECK(solid.batches.front().mass > 0.0);
  CHECK(solid.batches.back().volume > solid.batches.front().volume);
  // The lens where two unit spheres 1.5 apart overlap: pi (4 + d) (2 - d)^2 / 12.
  const double pi = std::acos(-1.0), lens = pi * 5.5 * 0.25 / 12.0, both = 8.0 * pi / 3.0;
  const ImmersionResult twice =
      immerse({.sample = pairs(MassConvention::sum_of_spheres), .grains = 50, .seed = 3});
  CHECK(twice.solid_density == doctest::Approx(density * both / (both - lens)).epsilon(1e-6));
  CHECK(twice.batches.back().volume == doctest::Approx(solid.batches.back().volume).epsilon(1e-9));
}

TEST_CASE("an immersion with a wrong parameter says which") {
  CHECK_THROWS_WITH_AS(immerse({.grains = 0}), doctest::Contains("immersion grains = 0 is outside [1, "),
                       Error);
  RockSample light = pairs(MassConvention::sum_of_spheres);
  light.rock.density = -1.0;
  CHECK_THROWS_WITH_AS(immerse({.sample = light}), doctest::Contains("density = -1"), Error);
}
