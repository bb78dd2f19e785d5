#include "scree/laboratory/bulk_density.hpp"
#include "scree/measure/watchdog.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>

using namespace scree;

namespace {

BulkDensitySetup small_container() {
  BulkDensitySetup setup;
  setup.sample = desk_rock();
  setup.container = {.radius = 0.1, .height = 0.08};
  setup.threads = 1;
  return setup;
}

} // namespace

TEST_CASE("physics: a container is filled to the brim, and its slices weigh what it weighs") {
  BulkDensityTest<> test{small_container()};
  const BulkDensityResult& r = test.run();
  CHECK(r.fill.unrest.within(test.setup().fill.rest));
  CHECK(r.fill.kept < r.fill.poured);
  CHECK(r.bulk_density == doctest::Approx(r.mass / test.setup().container.volume()));
  CHECK(r.porosity > 0.35);
  CHECK(r.porosity < 0.6);
  // Grains whose centres are below the brim stick out of it, and so some of their mass is in no slice.
  double in_slices = 0.0;
  for (const DensitySlice& slice : r.profile) {
    in_slices += slice.density * test.setup().container.volume() / static_cast<double>(r.profile.size());
  }
  CHECK(in_slices < r.mass);
  CHECK(in_slices > 0.9 * r.mass);
  for (std::size_t b = 0; b < test.simulation().bodies().size(); ++b) {
    const Vector at = test.simulation().bodies().position(b);
    CHECK(at.head<2>().norm() < test.setup().container.radius);
    CHECK(at.z() > 0.0);
  }
}

TEST_CASE("a grain that has left its container ends the run") {
  const RoundContainer container{.radius = 0.1, .height = 0.08};
  const Clump grain = desk_rock().assembly.clumps().front();
  for (const Vector& at :
       {Vector{0.0, 0.0, 0.3}, Vector{0.11, 0.0, 0.04}, Vector{0.0, -0.11, 0.04}, Vector{0.0, 0.0, -0.01}}) {
    Simulation<> simulation{{.threads = 1}};
    const MaterialId rock = simulation.add_material(desk_rock().rock);
    simulation.add_wall({.name = "mantle", .surfaces = container.mantle(rock), .dynamics = Fixed{}});
    simulation.add({.clump = &grain, .material = rock, .position = at});
    Watchdog watchdog{{.domain = container.domain()}};
    if (container.domain().contains(at)) {
      CHECK_NOTHROW(watchdog.look(simulation));
    } else {
      CHECK_THROWS_WITH_AS(watchdog.look(simulation), doctest::Contains("is outside the domain"), Trouble);
    }
  }
}

TEST_CASE("physics: four times the density and the stiffness make four times the bulk density, in the same "
          "packing") {
  BulkDensitySetup setup = small_container();
  const double once = BulkDensityTest<>{setup}.run().bulk_density;
  // A power of 4, of which the root is a power of 2 too: the motion is then the same to the bit.
  for (Material* m : {&setup.sample.rock, &setup.sample.rig}) {
    m->density *= 4.0;
    m->normal_stiffness *= 4.0;
    m->shear_stiffness *= 4.0;
  }
  CHECK(BulkDensityTest<>{setup}.run().bulk_density == 4.0 * once);
  setup.seed = 2;
  CHECK(BulkDensityTest<>{setup}.run().bulk_density != 4.0 * once);
}

TEST_CASE("physics: the mass convention decides on the bulk density of clumps") {
  const auto density = [](MassConvention convention) {
    BulkDensitySetup setup = small_container();
    setup.sample = desk_rock(convention);
    return BulkDensityTest<>{setup}.run().bulk_density;
  };
  const double by_union = density(MassConvention::union_of_spheres);
  const double by_sum = density(MassConvention::sum_of_spheres);
  CHECK(by_sum > 1.05 * by_union);
}

TEST_CASE("BulkDensityTest refuses what cannot be done") {
  BulkDensitySetup setup = small_container();
  setup.container.radius = -1.0;
  CHECK_THROWS_WITH_AS(BulkDensityTest<>{setup}, doctest::Contains("container radius = -1"), Error);
  setup = small_container();
  setup.slices = 0;
  CHECK_THROWS_WITH_AS(BulkDensityTest<>{setup}, doctest::Contains("slices"), Error);
  setup = small_container();
  setup.fill.rest.patience = 0.0;
  CHECK_THROWS_WITH_AS(BulkDensityTest<>{setup}, doctest::Contains("rest: patience = 0"), Error);
  setup = small_container();
  setup.fill.expected_porosity = 0.9;
  CHECK_THROWS_WITH_AS(BulkDensityTest<>{setup}.run(), doctest::Contains("which grains of"), Error);
}
