#pragma once
/// \file
/// scree's side of the comparison: steps on a bed.

#include "../support/periodic_bed.hpp"
#include "scree/geometry/dragline_bucket.hpp"

#include <sys/resource.h>

#include <chrono>
#include <cstddef>
#include <optional>

namespace scree::benchmarks {

template <class Number, bool audit>
struct TimedModel : DefaultModel {
  using Real = Number;
  using Walls = scree::Walls<Fixed, Prescribed>;
  static constexpr bool energy_audit = audit;
};

/// What is timed, beside the bed.
struct TimedRun {
  unsigned threads = 1;
  double tilt = 0.0; ///< rad, of gravity towards x
  std::optional<BucketDetail> bucket;
  int warm = 100, steps = 500; ///< before the timed ones, and timed
};

struct Timed {
  double seconds = 0.0;
  std::size_t grains = 0, contacts = 0; ///< with the floor, at the end
  std::size_t list_renewals = 0;        ///< within the timed steps
  double megabytes = 0.0;               ///< the most memory that the program held
};

/// Where the bucket of the benchmark starts; it goes on along x.
inline Vector bucket_place(const PeriodicBed& bed) {
  return {0.1, 0.5 * bed.period.y(), 0.05};
}

/// A bed with its floor, and a bucket if one is asked for.
template <class Model>
struct TimedScene {
  Simulation<Model> simulation;

  TimedScene(const PeriodicBed& bed, const TimedRun& run, double time_step = 1e-5)
      : simulation{setup(bed, run, time_step)} {
    fill(simulation, bed);
    if (run.bucket) {
      simulation.add_wall({.name = "bucket",
                           .surfaces = {{make_dragline_bucket({}, *run.bucket), 0}},
                           .dynamics = Prescribed::constant_velocity(
                               {0.2, 0.0, 0.0}, {bucket_place(bed), Quaternion::Identity()})});
    }
  }
  void advance(int steps) {
    for (int k = 0; k < steps; ++k) {
      simulation.step();
    }
  }

private:
  static Setup<Model> setup(const PeriodicBed& bed, const TimedRun& run, double time_step) {
    Setup<Model> out = bed_setup<Model>(bed, run.threads, time_step);
    out.gravity = 9.81 * Vector{std::sin(run.tilt), 0.0, -std::cos(run.tilt)};
    return out;
  }
};

template <class Model>
Timed timed_steps(PeriodicBed bed, const TimedRun& run) {
  TimedScene<Model> scene{bed, run};
  bed = {}; // as it would count as memory of the simulation
  const Simulation<Model>& simulation = scene.simulation;
  scene.advance(run.warm);
  Timed timed;
  const std::size_t renewals = simulation.list_renewals();
  const auto begin = std::chrono::steady_clock::now();
  scene.advance(run.steps);
  timed.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  timed.grains = simulation.bodies().size();
  timed.list_renewals = simulation.list_renewals() - renewals;
  simulation.visit_contacts([&timed](const ContactView&) { ++timed.contacts; });
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  timed.megabytes = static_cast<double>(used.ru_maxrss) / 1024.0;
  return timed;
}

} // namespace scree::benchmarks
