#include "laboratory/experiment.hpp"
#include "support/recipe_options.hpp"

#include "scree/io/csv.hpp"
#include "scree/laboratory/tilt_test.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace scree::examples {

namespace {

void write_tables(const std::filesystem::path& folder, const TiltTestResult& r, bool single) {
  CsvWriter curve{folder / "tilt_test.csv",
                  {"time_s", "angle_deg", "share_moved", "displacement_m"},
                  single ? "Of the rocks that are no lone spheres." : "Of the grains of the upper half."};
  for (const TiltPoint& p : r.curve) {
    curve.row({p.time, p.angle, p.share, p.displacement});
  }
  if (!single) {
    return;
  }
  CsvWriter rocks{folder / "rocks.csv",
                  {"shape", "scale", "lone_sphere", "moved", "rolled", "angle_deg", "failure_angle_deg"},
                  "Shapes are counted from 1; scale is the diameter of a clump's spheres in m."};
  for (const TiltedRock& k : r.rocks) {
    rocks.row({static_cast<double>(k.rock.shape + 1), k.rock.scale, k.sphere ? 1.0 : 0.0, k.moved ? 1.0 : 0.0,
               k.rolled ? 1.0 : 0.0, k.angle, k.failure_angle});
  }
}

void summarise(nlohmann::ordered_json& summary, const TiltTestResult& r, bool single) {
  summary["failed"] = r.failed;
  // Of a layer that holds there is no angle; of rocks it is that of those that moved.
  if (r.failure_angle > 0.0) {
    summary["angle_deg"] = r.angle;
    summary["failure_angle_deg"] = r.failure_angle;
  }
  summary["unbalanced_before"] = r.unrest.unbalanced;
  summary["moving_before"] = r.unrest.moving;
  if (!single) {
    summary["grains"] = r.free + r.glued;
    summary["grains_held_to_the_floor"] = r.glued;
    summary["grain_size_m"] = r.grain_size;
    summary["porosity"] = r.bed.porosity;
    return;
  }
  summary["angle_standard_error_deg"] = r.error;
  summary["angle_standard_deviation_deg"] = r.spread;
  summary["angle_median_deg"] = r.median;
  if (r.slid > 0) {
    summary["slid_angle_deg"] = r.slid_angle;
  }
  summary["slid"] = r.slid;
  summary["rolled"] = r.rolled;
  summary["held"] = r.held;
  summary["lone_spheres"] = r.spheres;
}

void view(Workbench& bench, const TiltTest<>& test) {
  const auto& bodies = test.simulation().bodies();
  const std::string caption = fmt::format("at {:.1f} degrees; down the slope is to the right", test.angle());
  if (test.setup().method == TiltMethod::layer) {
    const Tray& tray = test.setup().tray;
    bench.view(
        "tilt_view", test.simulation(),
        {Vector{0.0, -0.5 * tray.width, -tray.depth}, Vector{tray.length, 0.5 * tray.width, tray.depth}},
        true, caption, [&](auto& renderer) {
          for (const double x : {0.0, tray.length}) {
            renderer.line({x, 0.0, -tray.depth}, {x, 0.0, 0.0}, {90, 90, 90});
          }
          renderer.line({0.0, 0.0, -tray.depth}, {tray.length, 0.0, -tray.depth}, {90, 90, 90}, 3.0);
        });
    return;
  }
  double widest = 0.0;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    widest = std::max(widest, 2.0 * bodies.bounding_radius(b));
  }
  const double length = 12.0 * widest; // some of the rocks, as all would be small
  bench.view("tilt_view", test.simulation(),
             {Vector{-widest, -widest, 0.0}, Vector{length, widest, 2.0 * widest}}, false, caption,
             [&](auto& renderer) {
               renderer.line({-widest, 0.0, 0.0}, {length, 0.0, 0.0}, {90, 90, 90}, 3.0);
             });
}

class TiltTestExperiment final : public Experiment {
public:
  explicit TiltTestExperiment(bool desk) {
    if (desk) {
      setup_ = desk_tilt_test();
    }
  }

  void bind(Options& options) override {
    options.group("Tilting");
    options.add("tilt.method", method_, {"single", "layer"},
                "rocks apart on a plate, or a tray full of rock");
    options.add("tilt.rocks", setup_.rocks, {2.0, 1e6}, "on the plate");
    options.add("tilt.rate", setup_.rate, {1e-6, 1e4, "degrees/s"}, "of tilting");
    options.add("tilt.steepest", setup_.steepest, {1e-3, 90.0, "degrees"}, "where the test ends");
    options.add("tilt.moved", setup_.moved, {1e-6, 1e3}, "times its size must a rock or the upper half move");
    options.add("tilt.onset_speed", setup_.onset_speed, {1e-12, 1e3, "m/s"}, "up to which it has not begun");
    options.add("tilt.rolled", setup_.rolled, {1e-3, 180.0, "degrees"},
                "by which a rock that slides turns at most");
    options.add("tilt.points", setup_.points, {10.0, 1e6}, "of the curve up to the steepest angle");
    options.group("Tray");
    options.add("tray.length", setup_.tray.length, {1e-3, 100.0, "m"}, "along the slope");
    options.add("tray.width", setup_.tray.width, {1e-3, 100.0, "m"}, "across it");
    options.add("tray.depth", setup_.tray.depth, {1e-3, 100.0, "m"}, "to the brim");
    options.add("tray.rough", setup_.tray.rough, "whether the grains on the floor are held there");
    bind_bed(options, setup_.bed);
    options.group("At rest before it is tilted");
    bind_rest(options, "rest", setup_.rest);
  }
  std::vector<Observable> observables() const override {
    return {{"angle_deg", false}, {"failure_angle_deg", false}, {"slid_angle_deg", false}};
  }
  CurveFile curve() const override {
    return {"tilt_test.csv", "angle_deg", "share_moved", "Share that has moved", "angle, degrees", ""};
  }
  std::vector<double> observe(const Conditions& conditions,
                              const std::filesystem::path& folder) const override {
    return detail::with_physics_of(conditions, [&]<class Model>(const Setup<Model>& physics) {
      TiltTest<Model> test{prepared(conditions), physics};
      const TiltTestResult& r = test.run(detail::limited(conditions));
      if (!folder.empty()) {
        write_tables(folder, r, single());
      }
      // A mean without those that hold would be too low.
      if (!r.failed) {
        throw Error(
            single() ? message("tilt test: ", r.held, " of ", r.slid + r.rolled + r.held,
                               " rocks hold up to steepest = ", setup_.steepest, " degrees")
                     : message("tilt test: the layer holds up to steepest = ", setup_.steepest, " degrees"));
      }
      return std::vector{r.angle, r.failure_angle,
                         r.slid > 0 ? r.slid_angle : std::numeric_limits<double>::quiet_NaN()};
    });
  }
  void show(Workbench& bench) const override {
    TiltTest<> test{prepared(detail::conditions_of(bench)), {.step_safety = bench.step_safety()}};
    const TiltTestResult& r = bench.run(test);
    write_tables(bench.folder(), r, single());
    summarise(bench.summary(), r, single());
    bench.plot("tilt_test", bench.title("Tilt test"),
               {{"Share that has moved",
                 "angle, degrees",
                 "",
                 {{"tilt_test.csv", "angle_deg", "share_moved", single() ? "rocks" : "upper half"}}},
                {single() ? "Mean displacement" : "Median displacement",
                 "angle, degrees",
                 "m",
                 {{"tilt_test.csv", "angle_deg", "displacement_m", single() ? "rocks" : "upper half"}}}});
    view(bench, test);
    bench.finish(test.simulation());
    if (single()) {
      fmt::print("angle {:.2f} +- {:.2f} degrees, median {:.2f}: {} slid at {:.2f}, {} rolled, {} held; "
                 "{} lone spheres apart\n",
                 r.angle, r.error, r.median, r.slid, r.slid_angle, r.rolled, r.held, r.spheres);
    } else if (r.failed) {
      fmt::print("the layer began to move at {:.2f} and failed at {:.2f} degrees\n", r.angle,
                 r.failure_angle);
    } else {
      fmt::print("the layer held up to {:.2f} degrees\n", test.angle());
    }
  }

private:
  [[nodiscard]] bool single() const { return method_ == to_string(TiltMethod::single); }
  [[nodiscard]] TiltTestSetup prepared(const Conditions& conditions) const {
    TiltTestSetup setup = detail::prepared(setup_, conditions);
    setup.method = single() ? TiltMethod::single : TiltMethod::layer;
    return setup;
  }

  TiltTestSetup setup_;
  std::string method_{to_string(TiltMethod::single)};
};

} // namespace

std::unique_ptr<Experiment> detail::make_tilt_test(bool desk) {
  return std::make_unique<TiltTestExperiment>(desk);
}

} // namespace scree::examples
