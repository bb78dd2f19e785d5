#include "laboratory/experiment.hpp"

#include "scree/io/csv.hpp"
#include "scree/laboratory/drop_test.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace scree::examples {

namespace {

void write_tables(const std::filesystem::path& folder, const DropTestResult& r) {
  CsvWriter table{folder / "drop_test.csv",
                  {"speed_m_s", "height_m", "restitution", "standard_error", "standard_deviation",
                   "energy_restitution", "energy_standard_error", "energy_standard_deviation", "hit_again",
                   "stayed"},
                  "Mean of all drops at each speed."};
  CsvWriter drops{folder / "drops.csv",
                  {"speed_m_s", "shape", "scale", "restitution", "energy_restitution", "hits", "left"},
                  "Shapes are counted from 1; scale is the diameter of a clump's spheres in m."};
  for (const DropSeries& s : r.series) {
    const DropMean &e = s.restitution, &energy = s.energy_restitution;
    table.row({s.speed, s.height, e.mean, e.error, e.spread, energy.mean, energy.error, energy.spread,
               static_cast<double>(s.hit_again), static_cast<double>(s.stayed)});
    for (const Drop& drop : s.drops) {
      drops.row({s.speed, static_cast<double>(drop.rock.shape + 1), drop.rock.scale, drop.restitution,
                 drop.energy_restitution, static_cast<double>(drop.hits), drop.left ? 1.0 : 0.0});
    }
  }
}

void summarise(nlohmann::ordered_json& summary, const DropTestResult& r) {
  for (const DropSeries& s : r.series) {
    const DropMean &e = s.restitution, &energy = s.energy_restitution;
    summary["speeds"].push_back({{"speed_m_s", s.speed},
                                 {"height_m", s.height},
                                 {"restitution", e.mean},
                                 {"restitution_standard_error", e.error},
                                 {"restitution_standard_deviation", e.spread},
                                 {"energy_restitution", energy.mean},
                                 {"hit_again", s.hit_again},
                                 {"stayed", s.stayed}});
  }
}

/// The first rocks beside each other, as high and as turned as they are now.
void view(Workbench& bench, const DropTest<>& test) {
  const auto clumps = test.setup().sample.assembly.clumps();
  const auto& bodies = test.simulation().bodies();
  const DropSeries& last = test.result().series.back();
  std::uint64_t first = std::numeric_limits<std::uint64_t>::max();
  double widest = 0.0, top = 0.0;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    first = std::min(first, bodies.id(b));
    widest = std::max(widest, 2.0 * bodies.bounding_radius(b));
  }
  Simulation<> shown;
  const MaterialId rock = shown.add_material(test.setup().sample.rock);
  const std::size_t most = std::min<std::size_t>(10, last.drops.size());
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const std::size_t k = bodies.id(b) - first;
    if (k < most) {
      const DrawnClump& grain = last.drops[k].rock;
      const double z = bodies.position(b).z();
      shown.add({.clump = &clumps[grain.shape],
                 .material = rock,
                 .position = {(static_cast<double>(k) + 0.5) * widest, 0.0, z},
                 .orientation = bodies.orientation(b),
                 .scale = grain.scale});
      top = std::max(top, z + bodies.bounding_radius(b));
    }
  }
  const double length = static_cast<double>(most) * widest;
  bench.view("drop_view", shown, {Vector{0.0, -widest, 0.0}, Vector{length, widest, top}}, false,
             fmt::format("the first {} rocks after they came to the plate at {} m/s", most, last.speed),
             [&](auto& renderer) {
               renderer.line(Vector::Zero(), {length, 0.0, 0.0}, {90, 90, 90}, 3.0);
             });
}

class DropTestExperiment final : public Experiment {
public:
  explicit DropTestExperiment(bool desk) {
    if (desk) {
      setup_ = desk_drop_test();
    }
  }

  void bind(Options& options) override {
    options.group("Drops");
    options.add_series("drop.speeds", setup_.speeds, 1, {1e-3, 1e3, "m/s"},
                       "at which the rocks come to the plate");
    options.add("drop.drops", setup_.drops, {2.0, 1e6}, "at each speed");
    options.add("drop.patience", setup_.patience, {1e-6, 1e3, "s"}, "for a rock to leave the plate");
  }
  std::vector<Observable> observables() const override {
    return {{"restitution", false}, {"energy_restitution", false}};
  }
  CurveFile curve() const override {
    return {"drop_test.csv", "speed_m_s", "restitution", "Restitution", "speed at the plate, m/s", ""};
  }
  std::vector<double> observe(const Conditions& conditions,
                              const std::filesystem::path& folder) const override {
    return detail::with_physics_of(conditions, [&]<class Model>(const Setup<Model>& physics) {
      DropTest<Model> test{detail::prepared(setup_, conditions), physics};
      const DropTestResult& r = test.run(detail::limited(conditions));
      if (!folder.empty()) {
        write_tables(folder, r);
      }
      for (const DropSeries& s : r.series) {
        if (10 * s.stayed > s.drops.size()) {
          throw Error(message("drop test: ", s.stayed, " of ", s.drops.size(), " rocks dropped at ", s.speed,
                              " m/s have not left the plate within patience = ", setup_.patience, " s"));
        }
      }
      // Means over the speeds.
      double restitution = 0.0, of_energy = 0.0;
      for (const DropSeries& s : r.series) {
        restitution += s.restitution.mean / static_cast<double>(r.series.size());
        of_energy += s.energy_restitution.mean / static_cast<double>(r.series.size());
      }
      return std::vector{restitution, of_energy};
    });
  }
  void show(Workbench& bench) const override {
    DropTest<> test{detail::prepared(setup_, detail::conditions_of(bench)),
                    {.step_safety = bench.step_safety()}};
    const DropTestResult& r = bench.run(test);
    write_tables(bench.folder(), r);
    summarise(bench.summary(), r);
    bench.plot("drop_test", bench.title("Drop test"),
               {{"Restitution",
                 "speed at the plate, m/s",
                 "",
                 {{.file = "drop_test.csv",
                   .x = "speed_m_s",
                   .y = "restitution",
                   .title = "vertical speed, mean and its standard error",
                   .error = "standard_error"}}},
                {"Root of the energy left",
                 "speed at the plate, m/s",
                 "",
                 {{.file = "drop_test.csv",
                   .x = "speed_m_s",
                   .y = "energy_restitution",
                   .title = "with spin and sliding, mean and its standard error",
                   .error = "energy_standard_error"}}}});
    view(bench, test);
    bench.finish(test.simulation());
    for (const DropSeries& s : r.series) {
      fmt::print("{:.3g} m/s ({:.3g} m): restitution {:.3f} +- {:.3f}, of the energy {:.3f}\n", s.speed,
                 s.height, s.restitution.mean, s.restitution.error, s.energy_restitution.mean);
    }
  }

private:
  DropTestSetup setup_;
};

} // namespace

std::unique_ptr<Experiment> detail::make_drop_test(bool desk) {
  return std::make_unique<DropTestExperiment>(desk);
}

} // namespace scree::examples
