/// \brief Bulk density of rock poured into a container and struck off (Coetzee et al. 2010, section 4.3).
/// \smoke --rock.size_factor 2.5 --container.radius 0.12 --container.height 0.1

#include "scree/laboratory/bulk_density.hpp"
#include "scree/io/csv.hpp"
#include "support/workbench.hpp"

#include <string>

namespace {

using namespace scree;
namespace ex = scree::examples;

void work(ex::Workbench& bench) {
  BulkDensitySetup setup;
  if (bench.desk()) {
    setup.container = {.radius = 0.15, .height = 0.15};
  }
  bench.options().group("Container");
  bench.options().add("container.radius", setup.container.radius, {0.001, 100.0, "m"}, "of the tube");
  bench.options().add("container.height", setup.container.height, {0.001, 100.0, "m"}, "to the brim");
  bench.options().add("container.slices", setup.slices, {1.0, 1e4}, "of the density's profile");
  bench.begin();
  setup.sample = bench.sample();
  setup.seed = bench.seed();
  setup.threads = bench.threads();
  BulkDensityTest<> test{setup, {.step_safety = bench.step_safety()}};
  const BulkDensityResult& r =
      test.run([&](const auto& simulation, const Stage& stage) { bench.watch(simulation, stage); });

  {
    CsvWriter table{bench.folder() / "density.csv",
                    {"height_m", "density_kg_m3"},
                    "Mass of each slice over its volume, slices from the floor up."};
    for (const DensitySlice& slice : r.profile) {
      table.row({slice.height, slice.density});
    }
  }
  auto& summary = bench.summary();
  summary["bulk_density_kg_m3"] = r.bulk_density;
  summary["mass_kg"] = r.mass;
  summary["porosity"] = r.porosity;
  summary["grains"] = r.fill.kept;
  bench.plot("density", bench.title("Bulk density"),
             {{"Density over the height",
               "height above the floor, m",
               "kg/m3",
               {{"density.csv", "height_m", "density_kg_m3", "slice"}}}});
  const double radius = setup.container.radius, brim = setup.container.height;
  bench.view("density_view", test.simulation(), {Vector{-radius, -radius, 0.0}, Vector{radius, radius, brim}},
             true, fmt::format("{:.0f} kg/m3, porosity {:.3f}", r.bulk_density, r.porosity),
             [&](auto& renderer) {
               for (const double x : {-radius, radius}) {
                 renderer.line({x, 0.0, 0.0}, {x, 0.0, brim}, {90, 90, 90});
               }
               renderer.line({-radius, 0.0, 0.0}, {radius, 0.0, 0.0}, {90, 90, 90}, 3.0);
             });
  bench.finish(test.simulation());
  fmt::print("bulk density {:.4g} kg/m3, {:.4g} kg, porosity {:.3f}\n", r.bulk_density, r.mass, r.porosity);
}

} // namespace

int main(int argc, char** argv) {
  return ex::run_experiment("bulk_density", "Bulk density of rock poured into a container and struck off.",
                            argc, argv, work);
}
