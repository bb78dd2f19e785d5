// What do resting regions gain in a drag, and what do they change?

#include "scree/core/archive.hpp"
#include "scree/laboratory/bucket_body.hpp"
#include "scree/laboratory/drag_rig.hpp"
#include "scree/laboratory/rock_sample.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <numbers>
#include <string>
#include <vector>

namespace {

using namespace scree;

struct DragModel : DefaultModel {
  using Walls = scree::Walls<Fixed, RopeCoupled>;
  using Rest = RestingRegions;
};

constexpr std::size_t bins = 10; // of the way

/// What is compared of a drag, for each bin of the way: force [N], pitch [degrees], depth [m], mass [kg].
constexpr std::array<const char*, 4> names{"force, N", "pitch, degrees", "depth, mm", "mass, kg"};
using Curve = std::array<std::array<double, bins>, names.size()>;

struct Outcome {
  Curve curve{};
  double seconds = 0.0; // of stepping
  double resting = 0.0; // mean share of the grains
};

/// The drag of the rig that was kept before the bucket was laid on its bed.
Outcome dragged(const DragSetup& setup, const std::string& kept) {
  DragRig<DragModel> rig{setup, bucket_body()};
  ArchiveReader reader{kept, "the bed"};
  reader(rig);
  double steps = 0.0;
  Outcome out;
  const auto count = [&](const auto& s) {
    out.resting += static_cast<double>(s.resting_count()) / static_cast<double>(s.bodies().size());
    ++steps;
  };
  const double before = rig.simulation().times().total();
  rig.place_bucket(count);
  std::array<double, bins> samples{};
  while (!rig.done()) {
    rig.advance(0.005, count);
    const DragSample s = rig.sample();
    const double place = s.drag / setup.drag_distance * static_cast<double>(bins);
    if (place >= 0.0 && place < static_cast<double>(bins)) {
      const auto bin = static_cast<std::size_t>(place);
      const std::array<double, names.size()> values{s.force, s.attitude.pitch * 180.0 / std::numbers::pi,
                                                    1e3 * s.depth, s.fill.struck};
      for (std::size_t n = 0; n < values.size(); ++n) {
        out.curve[n][bin] += values[n];
      }
      ++samples[bin];
    }
  }
  for (auto& values : out.curve) {
    for (std::size_t bin = 0; bin < bins; ++bin) {
      values[bin] /= samples[bin];
    }
  }
  out.seconds = rig.simulation().times().total() - before;
  out.resting /= steps;
  return out;
}

struct Spread {
  double mean = 0.0, deviation = 0.0;
};
Spread spread_of(const std::vector<Outcome>& runs, std::size_t name, std::size_t bin) {
  Spread out;
  const auto n = static_cast<double>(runs.size());
  for (const Outcome& run : runs) {
    out.mean += run.curve[name][bin] / n;
  }
  for (const Outcome& run : runs) {
    out.deviation += std::pow(run.curve[name][bin] - out.mean, 2) / (n - 1.0);
  }
  out.deviation = std::sqrt(out.deviation);
  return out;
}

/// Drags with and without resting regions over the same beds, one for each seed.
void compare(double speed, double distance, std::uint64_t seeds) {
  std::printf("\nRopes at %g m/s over %g m, %d seeds\n", speed, distance, static_cast<int>(seeds));
  std::vector<Outcome> stepped, rested;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    DragSetup setup = desk_drag();
    setup.threads = 1;
    setup.seed = seed;
    setup.drag_speed = speed;
    setup.drag_distance = distance;
    DragRig<DragModel> rig{setup, bucket_body()};
    rig.make_bed(desk_rock().assembly, [](const auto&...) {});
    ArchiveWriter writer;
    writer(rig);
    stepped.push_back(dragged(setup, writer.bytes()));
    setup.resting = {.speed = 0.01 * speed, .force = 0.1, .window = 500, .interval = 20};
    rested.push_back(dragged(setup, writer.bytes()));
    const Outcome &a = stepped.back(), &b = rested.back();
    std::printf(
        "seed %d: %.1f s, with resting regions %.1f s: %.2f times; %.2f of the grain-steps left out\n",
        static_cast<int>(seed), a.seconds, b.seconds, a.seconds / b.seconds, b.resting);
    std::fflush(stdout);
  }
  for (std::size_t name = 0; name < names.size(); ++name) {
    std::printf("\n%s\n%6s%12s%12s%12s%12s\n", names[name], "m", "without", "+-", "with", "+-");
    for (std::size_t bin = 0; bin < bins; ++bin) {
      const Spread a = spread_of(stepped, name, bin), b = spread_of(rested, name, bin);
      std::printf("%6.3f%12.4g%12.2g%12.4g%12.2g\n",
                  distance * (static_cast<double>(bin) + 0.5) / static_cast<double>(bins), a.mean,
                  a.deviation, b.mean, b.deviation);
    }
  }
}

} // namespace

int main() {
  try {
    compare(0.75, 1.0, 5);
    compare(0.15, 0.1, 3);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "resting: %s\n", error.what());
    return 1;
  }
}
