#include "laboratory/experiment.hpp"
#include "support/recipe_options.hpp"

#include "scree/io/csv.hpp"
#include "scree/laboratory/bulk_density.hpp"

#include <fmt/format.h>

namespace scree::examples {

namespace {

void write_profile(const std::filesystem::path& folder, const BulkDensityResult& r) {
  CsvWriter table{folder / "density.csv",
                  {"height_m", "density_kg_m3"},
                  "Mass of each slice over its volume, slices from the floor up."};
  for (const DensitySlice& slice : r.profile) {
    table.row({slice.height, slice.density});
  }
}

class BulkDensity final : public Experiment {
public:
  explicit BulkDensity(bool desk) {
    if (desk) {
      setup_ = desk_bulk_density();
    }
  }

  void bind(Options& options) override {
    options.group("Container");
    options.add("container.radius", setup_.container.radius, {0.001, 100.0, "m"}, "of the tube");
    options.add("container.height", setup_.container.height, {0.001, 100.0, "m"}, "to the brim");
    options.add("container.slices", setup_.slices, {1.0, 1e4}, "of the density's profile");
    bind_fill(options, setup_.fill);
  }
  std::vector<Observable> observables() const override { return {{"bulk_density_kg_m3"}}; }
  CurveFile curve() const override {
    return {
        "density.csv", "height_m", "density_kg_m3", "Density over the height", "height above the floor, m",
        "kg/m3"};
  }
  std::vector<double> observe(const Conditions& conditions,
                              const std::filesystem::path& folder) const override {
    return detail::with_physics_of(conditions, [&]<class Model>(const Setup<Model>& physics) {
      BulkDensityTest<Model> test{detail::prepared(setup_, conditions), physics};
      const BulkDensityResult& r = test.run(detail::limited(conditions));
      if (!folder.empty()) {
        write_profile(folder, r);
      }
      return std::vector{r.bulk_density};
    });
  }
  void show(Workbench& bench) const override {
    BulkDensityTest<> test{detail::prepared(setup_, detail::conditions_of(bench)),
                           {.step_safety = bench.step_safety()}};
    const BulkDensityResult& r = bench.run(test, setup_.container.domain());
    write_profile(bench.folder(), r);
    auto& summary = bench.summary();
    summary["bulk_density_kg_m3"] = r.bulk_density;
    summary["mass_kg"] = r.mass;
    summary["porosity"] = r.porosity;
    summarise_fill(summary, r.fill);
    bench.plot("density", bench.title("Bulk density"),
               {{"Density over the height",
                 "height above the floor, m",
                 "kg/m3",
                 {{"density.csv", "height_m", "density_kg_m3", "slice"}}}});
    const double radius = test.setup().container.radius, brim = test.setup().container.height;
    bench.view("density_view", test.simulation(),
               {Vector{-radius, -radius, 0.0}, Vector{radius, radius, brim}}, true,
               fmt::format("{:.0f} kg/m3, porosity {:.3f}", r.bulk_density, r.porosity), [&](auto& renderer) {
                 for (const double x : {-radius, radius}) {
                   renderer.line({x, 0.0, 0.0}, {x, 0.0, brim}, {90, 90, 90});
                 }
                 renderer.line({-radius, 0.0, 0.0}, {radius, 0.0, 0.0}, {90, 90, 90}, 3.0);
               });
    bench.finish(test.simulation());
    fmt::print("bulk density {:.4g} kg/m3, {:.4g} kg, porosity {:.3f}\n", r.bulk_density, r.mass, r.porosity);
  }

private:
  BulkDensitySetup setup_;
};

} // namespace

std::unique_ptr<Experiment> detail::make_bulk_density(bool desk) {
  return std::make_unique<BulkDensity>(desk);
}

} // namespace scree::examples
