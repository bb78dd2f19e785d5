#include "scree/laboratory/settled_bed.hpp"
#include "scree/measure/state_hash.hpp"
#include "scree/simulation/simulation.hpp"
#include "support/relative_error.hpp"

#include <doctest/doctest.h>

using namespace scree;

namespace {

struct Made {
  BedReport report;
  std::uint64_t hash;
  double highest;
  double moving; ///< share of the grains that are faster than 0.05 m/s
};

Made small_bed(double porosity, std::uint64_t seed,
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
  made.report = settle_bed(simulation, bed, Assembly{default_rock(), 1.3}, rock,
                           BedRecipe{.porosity = porosity}, random, [](const auto&, const BedStage&) {});
  made.hash = state_hash(simulation.bodies());
  made.highest = -1.0;
  for (std::size_t b = 0; b < simulation.bodies().size(); ++b) {
    made.highest = std::max(made.highest, simulation.bodies().position(b).z());
    made.moving += simulation.bodies().velocity(b).norm() > 0.05 ? 1.0 : 0.0;
  }
  made.moving /= static_cast<double>(simulation.bodies().size());
  return made;
}

} // namespace

TEST_CASE("physics: a bed comes to rest, struck off at its brim, the same for the same seed") {
  const Made made = small_bed(0.0, 3);
  CHECK(made.report.unbalanced <= 0.05);
  CHECK(made.highest <= 1e-3);
  CHECK(made.moving <= 0.01);
  CHECK(made.report.at_rest);
  CHECK(made.report.porosity > 0.35);
  CHECK(made.report.porosity < 0.55);
  CHECK(made.report.kept < made.report.poured);
  CHECK(small_bed(0.0, 3).hash == made.hash);
  CHECK(small_bed(0.0, 4).hash != made.hash);
}

TEST_CASE("physics: a requested porosity is reached within what the material allows") {
  const double loose = small_bed(0.0, 3).report.porosity;
  const Made denser = small_bed(loose - 0.03, 3);
  CHECK(denser.report.porosity == test::about(loose - 0.03, 0.02));
  CHECK(denser.report.poured_porosity == test::about(loose, 0.05));
  CHECK_THROWS_WITH_AS((void)small_bed(0.7, 3), doctest::Contains("looser than this material settles"),
                       Error);
  CHECK_THROWS_WITH_AS((void)small_bed(0.1, 3), doctest::Contains("denser than this material packs"), Error);
  CHECK_THROWS_WITH_AS((void)small_bed(1.4, 3), doctest::Contains("bed porosity = 1.4"), Error);
}

TEST_CASE("physics: a shaped bed is filled over its whole length") {
  const Made made = small_bed(0.0, 5, BedContainer::shaped(0.6, 0.2, 0.18));
  CHECK(made.report.unbalanced <= 0.05);
  CHECK(made.highest > -0.03);
  CHECK(made.report.bulk_density > 0.8 * 1518.0 * (1.0 - made.report.porosity));
}
