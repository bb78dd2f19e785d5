#include "scree/laboratory/settled_bed.hpp"
#include "scree/measure/state_hash.hpp"
#include "scree/simulation/simulation.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace scree;

namespace {

struct Made {
  BedReport report;
  std::uint64_t hash;
  double highest;
  double fastest;
};

Made small_bed(const BedRecipe& recipe, std::uint64_t seed,
               const BedContainer& bed = BedContainer::box(0.3, 0.25, 0.16)) {
  Simulation<> simulation{};
  const auto rock = simulation.add_material({.density = 1518.0,
                                             .normal_stiffness = 4e4,
                                             .shear_stiffness = 4e4,
                                             .friction = 0.53,
                                             .restitution = 0.4});
  simulation.add_wall({.name = "trough", .surfaces = bed.surfaces(rock), .dynamics = Fixed{}});
  Random random{seed, "bed"};
  Made made{};
  made.report = settle_bed(simulation, bed, Assembly{default_rock(), 1.7}, rock, recipe, random,
                           [](const auto&, const Stage&) {});
  made.hash = state_hash(simulation.bodies());
  made.highest = -1.0;
  for (std::size_t b = 0; b < simulation.bodies().size(); ++b) {
    made.highest = std::max(made.highest, simulation.bodies().position(b).z());
    made.fastest = std::max(made.fastest, simulation.bodies().velocity(b).norm());
  }
  return made;
}

} // namespace

TEST_CASE("physics: a bed comes to rest, struck off at its brim, the same for the same seed") {
  const Made made = small_bed({}, 3);
  CHECK(made.report.unbalanced <= 0.05);
  CHECK(made.highest <= 1e-3);
  CHECK(made.fastest < 0.05);
  CHECK(made.report.at_rest);
  CHECK(made.report.porosity > 0.35);
  CHECK(made.report.porosity < 0.55);
  CHECK(made.report.kept < made.report.poured);
  // For this a bed needs no rest.
  const BedRecipe restless{.rest = {.unbalanced = 1.0, .moving = 1.0}};
  const Made once = small_bed(restless, 3);
  CHECK(small_bed(restless, 3).hash == once.hash);
  CHECK(small_bed(restless, 4).hash != once.hash);
}

TEST_CASE("physics: a requested porosity is reached within what the material allows") {
  const BedRecipe as_poured{.rest = {.moving = 0.01}};
  const BedReport loose = small_bed(as_poured, 3).report;
  const double requested = loose.porosity - 0.03;
  // With this surplus the same grains are poured.
  BedRecipe recipe = as_poured;
  recipe.porosity = requested;
  recipe.surplus = (1.0 + recipe.surplus) * (1.0 - recipe.expected_porosity) / (1.0 - requested) - 1.0;
  const BedReport denser = small_bed(recipe, 3).report;
  CHECK(denser.poured == loose.poured);
  CHECK(denser.poured_porosity == loose.poured_porosity);
  CHECK(std::abs(denser.porosity - requested) < recipe.porosity_tolerance);
  CHECK_THROWS_WITH_AS((void)small_bed({.porosity = 0.7}, 3),
                       doctest::Contains("looser than this material settles"), Error);
  CHECK_THROWS_WITH_AS((void)small_bed({.porosity = 0.1, .rest = {.patience = 1.0}}, 3),
                       doctest::Contains("denser than this material packs"), Error);
  CHECK_THROWS_WITH_AS((void)small_bed({.porosity = 1.4}, 3), doctest::Contains("bed porosity = 1.4"), Error);
}

TEST_CASE("physics: a shaped bed is filled over its whole length") {
  const Made made = small_bed({}, 5, BedContainer::shaped(0.6, 0.2, 0.18));
  CHECK(made.report.unbalanced <= 0.05);
  CHECK(made.highest > -0.03);
  CHECK(made.report.bulk_density > 0.8 * 1518.0 * (1.0 - made.report.porosity));
}
