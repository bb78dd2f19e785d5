/// \brief Single rocks dropped on a plate at several speeds: restitution of their rebound.
/// \smoke --drop.drops 10 --drop.speeds 0.5,1,1.5,2,3

#include "scree/laboratory/drop_test.hpp"
#include "scree/io/csv.hpp"
#include "support/workbench.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <string>

namespace {

using namespace scree;
namespace ex = scree::examples;

void bind(ex::Options& options, DropTestSetup& s) {
  options.group("Drops");
  options.add("drop.speeds", s.speeds, {1e-3, 1e3, "m/s"}, "five, at which the rocks come to the plate");
  options.add("drop.drops", s.drops, {2.0, 1e6}, "at each speed");
  options.add("drop.patience", s.patience, {1e-6, 1e3, "s"}, "for a rock to leave the plate");
}

void write(ex::Workbench& bench, const DropTestResult& r) {
  CsvWriter table{bench.folder() / "drop_test.csv",
                  {"speed_m_s", "height_m", "restitution", "standard_error", "standard_deviation", "low",
                   "high", "energy_restitution", "energy_standard_error", "energy_standard_deviation",
                   "hit_again", "stayed"},
                  "Mean of all drops at each speed; low and high are one standard error off."};
  CsvWriter drops{bench.folder() / "drops.csv",
                  {"speed_m_s", "shape", "scale", "restitution", "energy_restitution", "hits", "left"},
                  "Shapes are counted from 1; scale is the diameter of a clump's spheres in m."};
  auto& summary = bench.summary();
  for (const DropSeries& s : r.series) {
    const DropMean &e = s.restitution, &energy = s.energy_restitution;
    table.row({s.speed, s.height, e.mean, e.error, e.spread, e.mean - e.error, e.mean + e.error, energy.mean,
               energy.error, energy.spread, static_cast<double>(s.hit_again), static_cast<double>(s.stayed)});
    for (const Drop& drop : s.drops) {
      drops.row({s.speed, static_cast<double>(drop.rock.shape + 1), drop.rock.scale, drop.restitution,
                 drop.energy_restitution, static_cast<double>(drop.hits), drop.left ? 1.0 : 0.0});
    }
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
void view(ex::Workbench& bench, const DropTest<>& test) {
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

void work(ex::Workbench& bench) {
  DropTestSetup setup = bench.desk() ? desk_drop_test() : DropTestSetup{};
  bind(bench.options(), setup);
  bench.begin();
  setup.sample = bench.sample();
  setup.seed = bench.seed();
  setup.threads = bench.threads();
  DropTest<> test{setup, {.step_safety = bench.step_safety()}};
  const DropTestResult& r =
      test.run([&](const auto& simulation, const Stage& stage) { bench.watch(simulation, stage); });
  write(bench, r);
  bench.plot("drop_test", bench.title("Drop test"),
             {{"Restitution",
               "speed at the plate, m/s",
               "",
               {{"drop_test.csv", "speed_m_s", "restitution", "vertical speed, mean"},
                {"drop_test.csv", "speed_m_s", "low", "one standard error below"},
                {"drop_test.csv", "speed_m_s", "high", "and above"}}},
              {"Root of the energy left",
               "speed at the plate, m/s",
               "",
               {{"drop_test.csv", "speed_m_s", "energy_restitution", "mean, with spin and sliding"}}}});
  view(bench, test);
  bench.finish(test.simulation());
  for (const DropSeries& s : r.series) {
    fmt::print("{:.3g} m/s ({:.3g} m): restitution {:.3f} +- {:.3f}, of the energy {:.3f}\n", s.speed,
               s.height, s.restitution.mean, s.restitution.error, s.energy_restitution.mean);
  }
}

} // namespace

int main(int argc, char** argv) {
  return ex::run_experiment("drop_test", "Restitution of single rocks dropped on a plate.", argc, argv, work);
}
