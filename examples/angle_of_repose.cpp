/// \brief Angle of repose of rock: a heap below a funnel or of a lifted cylinder (Coetzee et al. 2010, section 4.5).
/// \smoke --heap.method lifted_cylinder --rock.size_factor 1.8 --tube.radius 0.15 --tube.height 0.18 --tube.lift_speed 1

#include "scree/io/csv.hpp"
#include "scree/laboratory/heap.hpp"
#include "support/workbench.hpp"

#include <cmath>
#include <numbers>
#include <string>

namespace {

using namespace scree;
namespace ex = scree::examples;

constexpr double degree = std::numbers::pi / 180.0;

void bind(ex::Options& options, HeapSetup& s, std::string& method) {
  options.group("Heap");
  options.add("heap.method", method, {"funnel", "lifted_cylinder"}, "how it is made", ex::Provenance::paper);
  options.add("heap.patience", s.patience, {1e-3, 1e4, "s"}, "until funnel or tube are empty");
  options.add("heap.azimuths", s.flank.azimuths, {8.0, 1e5}, "at which its angle is taken");
  options.add("heap.flank_from", s.flank.from, {0.0, 0.9}, "share of the height at which the flank begins");
  options.add("heap.flank_to", s.flank.to, {0.1, 1.0}, "and ends");
  ex::add_contact_options(options, "plate", s.plate, ex::Provenance::ours, ex::Provenance::ours);
  options.group("Funnel");
  options.add("funnel.outlet", s.funnel.outlet, {1e-3, 100.0, "m"}, "radius of the lower end");
  options.add("funnel.rim", s.funnel.rim, {1e-3, 100.0, "m"}, "radius of the upper end");
  options.add("funnel.steepness", s.funnel.steepness, {0.1, 1.5, "rad"}, "of the cone");
  options.add("funnel.clearance", s.funnel.clearance, {1e-3, 100.0, "m"}, "from plate to outlet");
  options.add("funnel.solid", s.funnel.solid, {1e-9, 1e3, "m3"}, "of rock, without its pores");
  options.group("Tube");
  options.add("tube.radius", s.tube.radius, {1e-3, 100.0, "m"}, "of the lifted cylinder");
  options.add("tube.height", s.tube.height, {1e-3, 100.0, "m"}, "to which it is filled");
  options.add("tube.lift_speed", s.lift_speed, {1e-6, 100.0, "m/s"}, "at which it is drawn up");
}

void write(ex::Workbench& bench, const HeapResult& r) {
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
  {
    CsvWriter profile{bench.folder() / "profile.csv", {"radius_m", "height_m"}, "Mean over all azimuths."};
    for (const HeapPoint& p : flank.profile) {
      profile.row({p.radius, p.height});
    }
    CsvWriter line{bench.folder() / "flank.csv", {"radius_m", "height_m"}, "The flank at the mean angle."};
    for (const double r_end : {flank.inner, flank.outer}) {
      line.row({r_end, height - std::tan(flank.angle) * (r_end - radius)});
    }
    CsvWriter azimuths{
        bench.folder() / "azimuths.csv", {"azimuth_deg", "angle_deg"}, "Along each radial line."};
    for (std::size_t k = 0; k < flank.azimuths.size(); ++k) {
      azimuths.row({360.0 * static_cast<double>(k) / static_cast<double>(flank.azimuths.size()),
                    flank.azimuths[k] / degree});
    }
  }
  auto& summary = bench.summary();
  summary["angle_deg"] = flank.angle / degree;
  summary["standard_error_deg"] = flank.standard_error / degree;
  summary["independent_azimuths"] = flank.independent;
  summary["grains"] = r.grains;
  summary["mass_kg"] = r.mass;
  summary["flow_time_s"] = r.flow_time;
  bench.plot("heap", bench.title("Angle of repose"),
             {{"Profile",
               "radius, m",
               "m",
               {{"profile.csv", "radius_m", "height_m", "mean surface"},
                {"flank.csv", "radius_m", "height_m", fmt::format("{:.1f} degrees", flank.angle / degree)}}},
              {"Around the heap",
               "azimuth, degrees",
               "degrees",
               {{"azimuths.csv", "azimuth_deg", "angle_deg", "angle"}}}});
}

void work(ex::Workbench& bench) {
  HeapSetup setup = bench.desk() ? desk_heap() : HeapSetup{};
  std::string method = "funnel";
  bind(bench.options(), setup, method);
  bench.begin();
  setup.method = method == "funnel" ? HeapSetup::Method::funnel : HeapSetup::Method::lifted_cylinder;
  setup.sample = bench.sample();
  setup.seed = bench.seed();
  setup.threads = bench.threads();
  HeapTest<> test{setup, {.step_safety = bench.step_safety()}};
  const HeapResult& r =
      test.run([&](const auto& simulation, const Stage& stage) { bench.watch(simulation, stage); });
  write(bench, r);
  const double reach = r.flank.profile.back().radius, top = r.flank.profile.front().height;
  bench.view("heap_view", test.simulation(), {Vector{-reach, -reach, 0.0}, Vector{reach, reach, 1.3 * top}},
             false,
             fmt::format("{:.1f} +- {:.1f} degrees", r.flank.angle / degree, r.flank.standard_error / degree),
             [&](auto& renderer) {
               renderer.line({-reach, 0.0, 0.0}, {reach, 0.0, 0.0}, {90, 90, 90}, 3.0);
             });
  bench.finish(test.simulation());
  fmt::print("angle of repose {:.2f} +- {:.2f} degrees ({} grains)\n", r.flank.angle / degree,
             r.flank.standard_error / degree, r.grains);
}

} // namespace

int main(int argc, char** argv) {
  return ex::run_experiment("angle_of_repose", "Angle of repose of a heap of rock.", argc, argv, work);
}
