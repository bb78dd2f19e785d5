#include "laboratory/experiment.hpp"
#include "support/degree.hpp"
#include "support/recipe_options.hpp"

#include "scree/io/csv.hpp"
#include "scree/laboratory/heap.hpp"

#include <fmt/format.h>

#include <cmath>

namespace scree::examples {

namespace {

void write_profiles(const std::filesystem::path& folder, const HeapResult& r) {
  const HeapAngle& flank = r.flank;
  // The fitted flank, through the middle of the measured one.
  double middle = 0.0, count = 0.0;
  for (const HeapPoint& p : flank.profile) {
    if (p.radius >= flank.inner && p.radius <= flank.outer) {
      middle += p.height;
      count += 1.0;
    }
  }
  const double radius = 0.5 * (flank.inner + flank.outer), height = middle / count;
  CsvWriter profile{folder / "profile.csv", {"radius_m", "height_m"}, "Mean over all azimuths."};
  for (const HeapPoint& p : flank.profile) {
    profile.row({p.radius, p.height});
  }
  CsvWriter line{folder / "flank.csv", {"radius_m", "height_m"}, "The flank at the mean angle."};
  for (const double r_end : {flank.inner, flank.outer}) {
    line.row({r_end, height - std::tan(flank.angle) * (r_end - radius)});
  }
  CsvWriter azimuths{folder / "azimuths.csv", {"azimuth_deg", "angle_deg"}, "Along each radial line."};
  for (std::size_t k = 0; k < flank.azimuths.size(); ++k) {
    azimuths.row({360.0 * static_cast<double>(k) / static_cast<double>(flank.azimuths.size()),
                  flank.azimuths[k] / degree});
  }
}

class AngleOfRepose final : public Experiment {
public:
  explicit AngleOfRepose(bool desk) {
    if (desk) {
      setup_ = desk_heap();
    }
  }

  void bind(Options& options) override {
    options.group("Heap");
    options.add("heap.method", method_, {"funnel", "lifted_cylinder"}, "how it is made", Provenance::paper);
    options.add("heap.patience", setup_.patience, {1e-3, 1e4, "s"},
                "in which no grain leaves a choked funnel");
    options.add("heap.azimuths", setup_.flank.azimuths, {8.0, 1e5}, "at which its angle is taken");
    options.add("heap.flank_from", setup_.flank.from, {0.0, 0.9},
                "share of the height at which the flank begins");
    options.add("heap.flank_to", setup_.flank.to, {0.1, 1.0}, "and ends");
    options.add("heap.flank_spacing", setup_.flank.spacing, {0.01, 10.0},
                "of the points along a flank, in mean radii of the spheres");
    options.add("heap.plate_friction", setup_.plate_friction, {0.0, 10.0}, "a pair takes the smaller");
    options.group("Funnel");
    options.add("funnel.outlet", setup_.funnel.outlet, {1e-3, 100.0, "m"}, "radius of the lower end");
    options.add("funnel.rim", setup_.funnel.rim, {1e-3, 100.0, "m"}, "radius of the upper end");
    options.add("funnel.steepness", setup_.funnel.steepness, {0.1, 1.5, "rad"}, "of the cone");
    options.add("funnel.clearance", setup_.funnel.clearance, {1e-3, 100.0, "m"},
                "from plate to outlet at first");
    options.add("funnel.lift_speed", setup_.funnel.lift_speed, {0.0, 100.0, "m/s"},
                "at which it rises while it runs out; 0: it stands still");
    options.add("funnel.solid", setup_.funnel.solid, {1e-9, 1e3, "m3"}, "of rock, without its pores");
    options.group("Tube");
    options.add("tube.radius", setup_.tube.radius, {1e-3, 100.0, "m"}, "of the lifted cylinder");
    options.add("tube.height", setup_.tube.height, {1e-3, 100.0, "m"}, "to which it is filled");
    options.add("tube.lift_speed", setup_.lift_speed, {1e-6, 100.0, "m/s"}, "at which it is drawn up");
    bind_fill(options, setup_.fill);
    options.group("Heap at rest");
    bind_rest(options, "rest", setup_.rest);
  }
  std::vector<Observable> observables() const override { return {{"angle_deg", false}}; }
  CurveFile curve() const override {
    return {"profile.csv", "radius_m", "height_m", "Profile of the heap", "radius, m", "m"};
  }
  std::vector<double> observe(const Conditions& conditions,
                              const std::filesystem::path& folder) const override {
    return detail::with_physics_of(conditions, [&]<class Model>(const Setup<Model>& physics) {
      HeapTest<Model> test{prepared(conditions), physics};
      const HeapResult& r = test.run(detail::limited(conditions));
      if (!folder.empty()) {
        write_profiles(folder, r);
      }
      return std::vector{r.flank.angle / degree};
    });
  }
  void show(Workbench& bench) const override {
    HeapTest<> test{prepared(detail::conditions_of(bench)), {.step_safety = bench.step_safety()}};
    const HeapResult& r = bench.run(test);
    write_profiles(bench.folder(), r);
    const HeapAngle& flank = r.flank;
    auto& summary = bench.summary();
    summary["angle_deg"] = flank.angle / degree;
    summary["standard_error_deg"] = flank.standard_error / degree;
    summary["independent_azimuths"] = flank.independent;
    summary["grains"] = r.grains;
    summary["mass_kg"] = r.mass;
    summary["flow_time_s"] = r.flow_time;
    summary["unbalanced"] = r.unrest.unbalanced;
    summary["moving"] = r.unrest.moving;
    bench.plot(
        "heap", bench.title("Angle of repose"),
        {{"Profile",
          "radius, m",
          "m",
          {{"profile.csv", "radius_m", "height_m", "mean surface"},
           {"flank.csv", "radius_m", "height_m", fmt::format("{:.1f} degrees", flank.angle / degree)}}},
         {"Around the heap",
          "azimuth, degrees",
          "degrees",
          {{"azimuths.csv", "azimuth_deg", "angle_deg", "angle"}}}});
    const double reach = r.flank.profile.back().radius, top = r.flank.profile.front().height;
    bench.view(
        "heap_view", test.simulation(), {Vector{-reach, -reach, 0.0}, Vector{reach, reach, 1.3 * top}}, false,
        fmt::format("{:.1f} +- {:.1f} degrees", r.flank.angle / degree, r.flank.standard_error / degree),
        [&](auto& renderer) {
          renderer.line({-reach, 0.0, 0.0}, {reach, 0.0, 0.0}, {90, 90, 90}, 3.0);
        });
    bench.finish(test.simulation());
    fmt::print("angle of repose {:.2f} +- {:.2f} degrees ({} grains)\n", r.flank.angle / degree,
               r.flank.standard_error / degree, r.grains);
  }

private:
  [[nodiscard]] HeapSetup prepared(const Conditions& conditions) const {
    HeapSetup setup = detail::prepared(setup_, conditions);
    setup.method = method_ == "funnel" ? HeapSetup::Method::funnel : HeapSetup::Method::lifted_cylinder;
    return setup;
  }

  HeapSetup setup_;
  std::string method_ = "funnel";
};

} // namespace

std::unique_ptr<Experiment> detail::make_angle_of_repose(bool desk) {
  return std::make_unique<AngleOfRepose>(desk);
}

} // namespace scree::examples
