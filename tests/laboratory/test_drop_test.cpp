#include "scree/laboratory/drop_test.hpp"
#include "scree/measure/state_hash.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

using namespace scree;

namespace {

/// Spheres, or the paper's other shapes, of one size.
RockSample sample_of(bool spheres, double restitution = 0.6) {
  const SieveCurve narrow{{0.0199, 0.0201}, {0.0, 1.0}, SieveBasis::number};
  const auto shapes = paper_shapes(MassConvention::sum_of_spheres);
  Material rock = paper_material();
  rock.normal_stiffness = rock.shear_stiffness = 1e7;
  rock.restitution = restitution;
  std::vector<ShapeFraction> parts;
  if (spheres) {
    parts = {{shapes[3], 1.0, narrow}};
  } else {
    parts = {{shapes[0], 0.4, narrow}, {shapes[1], 0.3, narrow}, {shapes[2], 0.3, narrow}};
  }
  Material plate = rock;
  plate.friction = 0.3;
  plate.restitution = 0.9;
  return {Assembly{std::move(parts)}, rock, plate};
}

} // namespace

TEST_CASE("physics: a dropped sphere comes back with the restitution of the pair") {
  for (const double e : {0.3, 0.6, 1.0}) {
    RockSample sample = sample_of(true, e);
    DropTest<> test{{.sample = sample, .speeds = {0.5, 2.0}, .drops = 3, .threads = 1}};
    const double pair = std::min(e, 0.9);
    CHECK(restitution(damping_ratio(pair)) == doctest::Approx(pair).epsilon(1e-9));
    const auto& result = test.run();
    CHECK(result.series.size() == 2);
    for (const DropSeries& series : result.series) {
      CAPTURE(e);
      CAPTURE(series.speed);
      CHECK(series.height == doctest::Approx(series.speed * series.speed / 19.62));
      CHECK(series.restitution.mean == doctest::Approx(pair).epsilon(0.01));
      CHECK(series.energy_restitution.mean == doctest::Approx(series.restitution.mean).epsilon(1e-9));
      CHECK(series.restitution.spread < 3e-3);
      CHECK(series.hit_again == 0);
      CHECK(series.stayed == 0);
    }
  }
}

TEST_CASE("physics: rocks come back more slowly than a sphere, as spin takes a part") {
  DropTest<> test{{.sample = sample_of(false), .speeds = {1.0, 3.0}, .drops = 60, .threads = 1}};
  for (const DropSeries& series : test.run().series) {
    CAPTURE(series.speed);
    CHECK(series.restitution.mean + 3.0 * series.restitution.error < 0.6);
    CHECK(series.energy_restitution.mean > series.restitution.mean);
    CHECK(series.energy_restitution.mean < 0.9);
    CHECK(series.restitution.error ==
          doctest::Approx(series.restitution.spread / std::sqrt(60.0)).epsilon(1e-12));
    CHECK(series.hit_again > 0);
    CHECK(series.stayed == 0);
    CHECK(series.drops.size() == 60);
  }
}

TEST_CASE("physics: drops are the same to the bit for the same seed, whatever the number of threads") {
  const auto values = [](std::uint64_t seed, unsigned threads) {
    DropTest<> test{
        {.sample = sample_of(false), .speeds = {1.0}, .drops = 20, .seed = seed, .threads = threads}};
    std::vector<double> out;
    for (const Drop& drop : test.run().series.front().drops) {
      out.push_back(drop.restitution);
    }
    return std::pair{out, state_hash(test.simulation().bodies())};
  };
  const auto once = values(5, 1);
  CHECK(values(5, 2) == once);
  CHECK(values(6, 1).first != once.first);
}

TEST_CASE("a drop test with a wrong parameter says which, what it is and what it may be") {
  const auto refused = [](DropTestSetup setup, const char* what, Setup<> physics = {}) {
    CHECK_THROWS_WITH_AS((DropTest<>{std::move(setup), std::move(physics)}), doctest::Contains(what), Error);
  };
  refused({.speeds = {}}, "drop test: number of speeds = 0 is outside [1, 1000]");
  refused({.speeds = {1.0, -2.0}}, "drop test speeds = -2 m/s must be a finite number above 0");
  refused({.drops = 1}, "drop test drops = 1 is outside [2, 1000000]");
  refused({.patience = 0.0}, "drop test patience = 0 s must be a finite number above 0");
  refused({}, "experiment: gravity = (0, 0, 0) m/s2 must be straight down", {.gravity = Vector::Zero()});
}
