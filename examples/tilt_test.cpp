/// \brief Rocks on a plate or a layer in a tray, tilted until they move.
/// \smoke --tilt.rocks 6 --tilt.rate 10 --tilt.steepest 30

#include "scree/laboratory/tilt_test.hpp"
#include "scree/io/csv.hpp"
#include "support/workbench.hpp"

#include <algorithm>
#include <cstddef>
#include <string>

namespace {

using namespace scree;
namespace ex = scree::examples;

void bind(ex::Options& options, TiltTestSetup& s, std::string& method) {
  options.group("Tilting");
  options.add("tilt.method", method, {"single", "layer"}, "rocks apart on a plate, or a tray full of rock");
  options.add("tilt.rocks", s.rocks, {2.0, 1e6}, "on the plate");
  options.add("tilt.rate", s.rate, {1e-6, 1e4, "degrees/s"}, "of tilting");
  options.add("tilt.steepest", s.steepest, {1e-3, 90.0, "degrees"}, "where the test ends");
  options.add("tilt.moved", s.moved, {1e-6, 1e3}, "times its size must a rock or the upper half move");
  options.add("tilt.onset_speed", s.onset_speed, {1e-12, 1e3, "m/s"}, "up to which it has not begun");
  options.add("tilt.rolled", s.rolled, {1e-3, 180.0, "degrees"}, "by which a rock that slides turns at most");
  options.add("tilt.points", s.points, {10.0, 1e6}, "of the curve up to the steepest angle");
  options.group("Tray");
  options.add("tray.length", s.tray.length, {1e-3, 100.0, "m"}, "along the slope");
  options.add("tray.width", s.tray.width, {1e-3, 100.0, "m"}, "across it");
  options.add("tray.depth", s.tray.depth, {1e-3, 100.0, "m"}, "to the brim");
  options.add("tray.rough", s.tray.rough, "whether the grains on the floor are held there");
}

void write(ex::Workbench& bench, const TiltTestResult& r, bool single) {
  {
    CsvWriter curve{bench.folder() / "tilt_test.csv",
                    {"time_s", "angle_deg", "share_moved", "displacement_m"},
                    single ? "Of the rocks that are no lone spheres." : "Of the grains of the upper half."};
    for (const TiltPoint& p : r.curve) {
      curve.row({p.time, p.angle, p.share, p.displacement});
    }
  }
  auto& summary = bench.summary();
  summary["angle_deg"] = r.angle;
  summary["failure_angle_deg"] = r.failure_angle;
  summary["failed"] = r.failed;
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
  summary["angle_of_those_that_slid_deg"] = r.slid_angle;
  summary["slid"] = r.slid;
  summary["rolled"] = r.rolled;
  summary["held"] = r.held;
  summary["lone_spheres"] = r.spheres;
  CsvWriter rocks{bench.folder() / "rocks.csv",
                  {"shape", "scale", "lone_sphere", "moved", "rolled", "angle_deg", "failure_angle_deg"},
                  "Shapes are counted from 1; scale is the diameter of a clump's spheres in m."};
  for (const TiltedRock& k : r.rocks) {
    rocks.row({static_cast<double>(k.rock.shape + 1), k.rock.scale, k.sphere ? 1.0 : 0.0, k.moved ? 1.0 : 0.0,
               k.rolled ? 1.0 : 0.0, k.angle, k.failure_angle});
  }
}

void view(ex::Workbench& bench, const TiltTest<>& test) {
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

void work(ex::Workbench& bench) {
  TiltTestSetup setup = bench.desk() ? desk_tilt_test() : TiltTestSetup{};
  std::string method{to_string(setup.method)};
  bind(bench.options(), setup, method);
  bench.begin();
  setup.method = method == to_string(TiltMethod::layer) ? TiltMethod::layer : TiltMethod::single;
  setup.sample = bench.sample();
  setup.seed = bench.seed();
  setup.threads = bench.threads();
  const bool single = setup.method == TiltMethod::single;
  TiltTest<> test{setup, {.step_safety = bench.step_safety()}};
  const TiltTestResult& r =
      test.run([&](const auto& simulation, const Stage& stage) { bench.watch(simulation, stage); });
  write(bench, r, single);
  bench.plot("tilt_test", bench.title("Tilt test"),
             {{"Share that has moved",
               "angle, degrees",
               "",
               {{"tilt_test.csv", "angle_deg", "share_moved", single ? "rocks" : "upper half"}}},
              {"Mean displacement",
               "angle, degrees",
               "m",
               {{"tilt_test.csv", "angle_deg", "displacement_m", single ? "rocks" : "upper half"}}}});
  view(bench, test);
  bench.finish(test.simulation());
  if (single) {
    fmt::print("angle {:.2f} +- {:.2f} degrees, median {:.2f}: {} slid at {:.2f}, {} rolled, {} held; "
               "{} lone spheres apart\n",
               r.angle, r.error, r.median, r.slid, r.slid_angle, r.rolled, r.held, r.spheres);
  } else if (r.failed) {
    fmt::print("the layer began to move at {:.2f} and failed at {:.2f} degrees\n", r.angle, r.failure_angle);
  } else {
    fmt::print("the layer held up to {:.2f} degrees\n", test.angle());
  }
}

} // namespace

int main(int argc, char** argv) {
  return ex::run_experiment("tilt_test", "Angle at which rock on a plate or in a tray moves.", argc, argv,
                            work);
}
