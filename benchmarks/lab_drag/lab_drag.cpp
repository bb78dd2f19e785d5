// How long does the drag of the paper's size take?

#include "scree/core/archive.hpp"
#include "scree/laboratory/bucket_body.hpp"
#include "scree/laboratory/drag_rig.hpp"
#include "scree/laboratory/rock_sample.hpp"

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <string>

namespace {

using namespace scree;

struct DragModel : DefaultModel {
  using Walls = scree::Walls<Fixed, RopeCoupled>;
  using Rest = RestingRegions;
};
using Rig = DragRig<DragModel>;

/// The steps that the paper's stiffness needs are too many to come anywhere. Softer rock of the same sizes
/// takes the same work a step, and longer ones by the root of this.
constexpr double softer = 2000.0;
constexpr double stretch = 0.1; // m
/// Of the paper's bed. Here the trough is as much smaller as leaves the bucket's surroundings as they are.
constexpr double paper_grains = 190600.0;

DragSetup setup_of(unsigned threads) {
  DragSetup setup;
  setup.threads = threads;
  setup.bed.rest.moving = 0.02; // the last rattlers do not matter here
  for (Material* material : {&setup.rock, &setup.steel, &setup.floor}) {
    material->normal_stiffness /= softer;
    material->shear_stiffness /= softer;
  }
  setup.drag_distance = stretch;
  setup.bed_length = 1.2;
  setup.bed_width = 0.6;
  setup.bed_depth = 0.35;
  setup.bucket_start = 0.1;
  setup.remove_behind = false;
  return setup;
}

/// A line now and then.
class Told {
public:
  template <class Sim>
  void operator()(const Sim& simulation, const Stage& stage) {
    if (++steps_ % 1000 == 0) {
      std::printf("%s: %.3f s, %d grains, %.1f ms a step\n", stage.name.c_str(), simulation.time(),
                  static_cast<int>(simulation.bodies().size()),
                  1e3 * (simulation.times().total() - seconds_) / 1000.0);
      std::fflush(stdout);
      seconds_ = simulation.times().total();
    }
  }

private:
  std::size_t steps_ = 0;
  double seconds_ = 0.0;
};

/// The rig with its bed, kept.
std::string made_bed(unsigned threads) {
  Rig rig{setup_of(threads), bucket_body()};
  const BedReport& bed = rig.make_bed(paper_rock().assembly, Told{});
  std::printf("bed: %d grains of %d spheres, porosity %.3f\n", static_cast<int>(bed.kept),
              static_cast<int>(rig.simulation().bodies().sphere_count()), bed.porosity);
  ArchiveWriter writer;
  writer(rig);
  return writer.bytes();
}

/// Drags over the stretch and says what the whole metre would take in the steps of the paper's rock.
void drag(const std::string& bed, unsigned threads, bool rest) {
  DragSetup setup = setup_of(threads);
  if (rest) {
    // Looked at as often as in benchmarks/resting; in steps of the paper's rock both numbers would be larger
    // by as much as these are smaller.
    setup.resting = {.speed = 0.01 * setup.drag_speed, .force = 0.1, .window = 500, .interval = 20};
  }
  Rig rig{setup, bucket_body()};
  ArchiveReader reader{bed, "the bed"};
  reader(rig);
  rig.place_bucket([](const auto&) {});
  const auto& simulation = rig.simulation();
  const StepTimes at_start = simulation.times();
  const double begin = simulation.time();
  const double grains = static_cast<double>(simulation.bodies().size());
  double steps = 0.0, left_out = 0.0, shown = 0.0;
  while (!rig.done()) {
    rig.advance(0.005, [&](const auto& s) {
      ++steps;
      left_out += static_cast<double>(s.resting_count()) / static_cast<double>(s.bodies().size());
    });
    if (rig.drag() >= shown) {
      const double seconds = simulation.times().total() - at_start.total();
      std::printf("%.3f m: %.0f steps in %.0f s, %.2f of the grain-steps left out\n", rig.drag(), steps,
                  seconds, left_out / steps);
      std::fflush(stdout);
      shown += 0.01;
    }
  }
  StepTimes spent = simulation.times();
  spent += at_start.scaled(-1.0);
  const double awake = grains * (1.0 - left_out / steps);
  std::printf("%s resting regions, %u threads: %.0f grains, %.0f of them stepped; %.2f ms a step, search "
              "%.2f of it\n",
              rest ? "with" : "without", threads, grains, awake, 1e3 * spent.total() / steps,
              spent.search / spent.total());
  // The whole metre. What search and rest take goes by the way, all else by the steps.
  const double span = simulation.time() - begin, dt = span / steps / std::sqrt(softer);
  const double metre = (1.0 + 0.5 * setup.drag_speed * setup.ramp) / setup.drag_speed; // s
  const double by_way = spent.search * metre / span;
  const double by_step = (spent.total() - spent.search) / steps * metre / dt;
  const double more = paper_grains / grains;
  std::printf("1 m in steps of %.2f us: %.1f h for these grains, %.1f h where %.0f more are %s\n", 1e6 * dt,
              (by_step + by_way) / 3600.0, (by_step * (rest ? 1.0 : more) + by_way * more) / 3600.0,
              paper_grains - grains, rest ? "at rest" : "stepped");
}

} // namespace

int main() {
  try {
    const std::string bed = made_bed(2);
    for (const unsigned threads : {1U, 2U}) {
      for (const bool rest : {false, true}) {
        drag(bed, threads, rest);
      }
    }
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "lab_drag: %s\n", error.what());
    return 1;
  }
}
