#pragma once
/// \file
/// scree's side of the comparison: steps on the settled bed.

#include "../support/periodic_bed.hpp"

#include <chrono>
#include <cstddef>

namespace scree::benchmarks {

template <class Number, bool audit>
struct TimedModel : DefaultModel {
  using Real = Number;
  using Walls = scree::Walls<Fixed>;
  static constexpr bool energy_audit = audit;
};

struct Timed {
  double seconds = 0.0;
  std::size_t contacts = 0;      ///< with the floor, at the end
  std::size_t list_renewals = 0; ///< within the timed steps
};

template <class Model>
Timed timed_steps(const PeriodicBed& bed, unsigned threads, int warm, int steps) {
  Simulation<Model> simulation{bed_setup<Model>(bed, threads)};
  fill(simulation, bed);
  for (int k = 0; k < warm; ++k) {
    simulation.step();
  }
  Timed timed;
  const std::size_t renewals = simulation.list_renewals();
  const auto begin = std::chrono::steady_clock::now();
  for (int k = 0; k < steps; ++k) {
    simulation.step();
  }
  timed.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  timed.list_renewals = simulation.list_renewals() - renewals;
  simulation.visit_contacts([&timed](const ContactView&) { ++timed.contacts; });
  return timed;
}

} // namespace scree::benchmarks
