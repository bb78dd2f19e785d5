#include "laboratory/experiment.hpp"

#include "scree/io/csv.hpp"
#include "scree/laboratory/immersion.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace scree::examples {

namespace {

/// Densities of the first grains, about 200 rows of them.
void write_batches(const std::filesystem::path& folder, const ImmersionResult& r) {
  CsvWriter table{folder / "immersion.csv",
                  {"grains", "mass_kg", "displaced_volume_m3", "density_kg_m3"},
                  "Of the first grains of the batch together."};
  const std::size_t step = std::max<std::size_t>(1, r.batches.size() / 200);
  for (std::size_t k = step - 1; k < r.batches.size(); k += step) {
    const ImmersedBatch& b = r.batches[k];
    table.row({static_cast<double>(k + 1), b.mass, b.volume, b.mass / b.volume});
  }
}

class Immersion final : public Experiment {
public:
  explicit Immersion(bool desk) {
    if (desk) {
      setup_ = desk_immersion();
    }
  }

  void bind(Options& options) override {
    options.group("Immersion");
    options.add("batch.grains", setup_.grains, {1.0, 1e8}, "of the batch that is weighed");
  }
  std::vector<Observable> observables() const override {
    return {{"solid_density_kg_m3"}, {"grain_mass_kg"}};
  }
  CurveFile curve() const override {
    return {"immersion.csv", "grains", "density_kg_m3", "Density of the first grains", "grains", "kg/m3"};
  }
  std::vector<double> observe(const Conditions& conditions,
                              const std::filesystem::path& folder) const override {
    const ImmersionResult r = immerse(detail::prepared(setup_, conditions));
    if (!folder.empty()) {
      write_batches(folder, r);
    }
    return {r.solid_density, r.batches.back().mass / static_cast<double>(r.batches.size())};
  }
  void show(Workbench& bench) const override {
    const ImmersionResult r = immerse(detail::prepared(setup_, detail::conditions_of(bench)));
    write_batches(bench.folder(), r);
    auto& summary = bench.summary();
    summary["solid_density_kg_m3"] = r.solid_density;
    summary["grain_mass_kg"] = r.batches.back().mass / static_cast<double>(r.batches.size());
    summary["mass_kg"] = r.batches.back().mass;
    summary["displaced_volume_m3"] = r.batches.back().volume;
    summary["grains"] = r.batches.size();
    const CurveFile c = curve();
    bench.plot("immersion", bench.title("Immersion"),
               {{c.title, c.x_label, c.y_label, {{c.file, c.x, c.y, "mass over displaced volume"}}}});
    bench.finish(Simulation<>{});
    fmt::print("solid density {:.5g} kg/m3\n", r.solid_density);
  }

private:
  ImmersionSetup setup_;
};

} // namespace

std::unique_ptr<Experiment> detail::make_immersion(bool desk) {
  return std::make_unique<Immersion>(desk);
}

} // namespace scree::examples
