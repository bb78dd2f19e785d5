/// \brief Confined compression of rock in a cylinder: load and displacement over a few cycles (Coetzee et al. 2010, section 4.4).
/// \smoke --rock.size_factor 2.5 --container.radius 0.12 --container.height 0.08 --load.cycles 2 --load.strain_rate 1 --load.points 50

#include "scree/laboratory/oedometer.hpp"
#include "scree/io/csv.hpp"
#include "support/workbench.hpp"

#include <string>

namespace {

using namespace scree;
namespace ex = scree::examples;

void bind(ex::Options& options, OedometerSetup& s) {
  options.group("Container and lid");
  options.add("container.radius", s.container.radius, {0.001, 100.0, "m"}, "of the tube",
              ex::Provenance::paper);
  options.add("container.height", s.container.height, {0.001, 100.0, "m"}, "to which it is filled",
              ex::Provenance::paper);
  options.add("load.low_stress", s.low_stress, {1e-3, 1e12, "Pa"}, "on the lid, at the end of unloading");
  options.add("load.high_stress", s.high_stress, {1e-3, 1e12, "Pa"}, "at the end of loading");
  options.add("load.cycles", s.cycles, {1.0, 1000.0}, "loadings");
  options.add("load.strain_rate", s.strain_rate, {1e-9, 1e3, "1/s"}, "of the lid");
  options.add("load.slope_from", s.slope_from, {0.0, 1.0},
              "share of the way to high load at which the slope begins");
  options.add("load.slope_to", s.slope_to, {0.0, 1.0}, "and ends");
  options.add("load.points", s.points, {10.0, 1e6}, "of the curve, in each branch");
}

void write(ex::Workbench& bench, const Oedometer<>& oedometer) {
  const OedometerResult& r = oedometer.result();
  CsvWriter curve{bench.folder() / "oedometer.csv",
                  {"time_s", "displacement_m", "strain", "lid_force_N", "lid_stress_Pa", "base_force_N",
                   "mantle_force_N", "cycle", "loading"},
                  "Zero where the lid carried the low load first; forces are means between two rows."};
  const double area = oedometer.setup().container.area();
  for (const OedometerPoint& p : r.curve) {
    curve.row({p.time, p.displacement, p.displacement / r.height, p.lid_force, p.lid_force / area,
               p.base_force, p.mantle_force, static_cast<double>(p.cycle + 1), p.loading ? 1.0 : 0.0});
  }
  auto& summary = bench.summary();
  summary["slope_N_m"] = r.slope;
  summary["modulus_Pa"] = r.modulus;
  summary["inertial_number"] = r.inertial_number;
  summary["height_m"] = r.height;
  summary["grains"] = r.fill.kept;
  summary["bulk_density_kg_m3"] = r.fill.bulk_density;
  for (const OedometerCycle& c : r.cycles) {
    summary["cycles"].push_back({{"slope_N_m", c.slope},
                                 {"slope_standard_error_N_m", c.slope_error},
                                 {"modulus_Pa", c.modulus},
                                 {"permanent_m", c.permanent},
                                 {"hysteresis_J", c.hysteresis}});
  }
  bench.plot("oedometer", bench.title("Confined compression"),
             {{"Load on the lid",
               "displacement, m",
               "N",
               {{"oedometer.csv", "displacement_m", "lid_force_N", "lid"},
                {"oedometer.csv", "displacement_m", "base_force_N", "base"}}},
              {"Stress and strain", "strain", "Pa", {{"oedometer.csv", "strain", "lid_stress_Pa", "lid"}}}});
}

void work(ex::Workbench& bench) {
  OedometerSetup setup = bench.desk() ? desk_oedometer() : OedometerSetup{};
  bind(bench.options(), setup);
  bench.begin();
  setup.sample = bench.sample();
  setup.seed = bench.seed();
  setup.threads = bench.threads();
  Oedometer<> oedometer{setup, {.step_safety = bench.step_safety()}};
  const OedometerResult& r =
      oedometer.run([&](const auto& simulation, const Stage& stage) { bench.watch(simulation, stage); });
  write(bench, oedometer);
  const double radius = setup.container.radius, lid = oedometer.lid_height();
  bench.view("oedometer_view", oedometer.simulation(),
             {Vector{-radius, -radius, 0.0}, Vector{radius, radius, lid}}, true,
             fmt::format("lid at {:.1f} mm, {:.0f} N", 1e3 * lid, r.curve.back().lid_force),
             [&](auto& renderer) {
               for (const double x : {-radius, radius}) {
                 renderer.line({x, 0.0, 0.0}, {x, 0.0, 1.1 * lid}, {90, 90, 90});
               }
               for (const double z : {0.0, lid}) {
                 renderer.line({-radius, 0.0, z}, {radius, 0.0, z}, {90, 90, 90}, 3.0);
               }
             });
  bench.finish(oedometer.simulation());
  fmt::print("slope {:.4g} N/m, modulus {:.4g} Pa, inertial number {:.2g}\n", r.slope, r.modulus,
             r.inertial_number);
}

} // namespace

int main(int argc, char** argv) {
  return ex::run_experiment("oedometer", "Confined compression of rock in a cylinder.", argc, argv, work);
}
