#include "laboratory/experiment.hpp"

#include "scree/io/csv.hpp"
#include "scree/laboratory/immersion.hpp"

#include <fmt/format.h>

namespace scree::examples {

namespace {

class Immersion final : public Experiment {
public:
  explicit Immersion(bool desk) { setup_.grains = desk ? 2000 : 20'000; }

  void bind(Options& options) override {
    options.group("Immersion");
    options.add("batch.grains", setup_.grains, {1.0, 1e8}, "of the batch that is weighed");
  }
  std::vector<Observable> observables() const override { return {{"solid_density_kg_m3"}}; }
  CurveFile curve() const override {
    return {"immersion.csv", "displaced_volume_m3", "mass_kg", "Immersion", "displaced volume, m3", "kg"};
  }
  std::vector<double> observe(const Conditions& conditions,
                              const std::filesystem::path& folder) const override {
    const ImmersionResult r = immerse(detail::prepared(setup_, conditions));
    if (!folder.empty()) {
      CsvWriter table{folder / curve().file, {"displaced_volume_m3", "mass_kg"}, "Of the whole batch."};
      table.row({0.0, 0.0});
      table.row({r.volume, r.mass});
    }
    return {r.solid_density};
  }
  void show(Workbench& bench) const override {
    const double density = observe(detail::conditions_of(bench), bench.folder()).front();
    bench.summary()["solid_density_kg_m3"] = density;
    bench.finish(Simulation<>{});
    fmt::print("solid density {:.4g} kg/m3\n", density);
  }

private:
  ImmersionSetup setup_;
};

} // namespace

std::unique_ptr<Experiment> detail::make_immersion(bool desk) {
  return std::make_unique<Immersion>(desk);
}

} // namespace scree::examples
