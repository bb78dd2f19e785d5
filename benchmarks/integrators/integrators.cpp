// How long does an integrator take to move one body?

#include "scree/core/random.hpp"
#include "scree/integrators/leapfrog.hpp"
#include "scree/integrators/rotor_splitting.hpp"

#include <benchmark/benchmark.h>

#include <array>
#include <cstddef>
#include <vector>

namespace {

using namespace scree;

constexpr std::size_t body_count = 256;
const TimeStep step{0.0, 1e-5, 1e-5, Vector{0.0, 0.0, -9.81}};

Vector direction(Random& random) {
  return random.orientation() * Vector::UnitX();
}

void count_bodies(benchmark::State& state) {
  state.counters["body"] =
      benchmark::Counter(static_cast<double>(body_count),
                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

/// Numbers that differ from lane to lane.
template <class T>
Vec3<T> drawn(Random& random, double size) {
  std::array<Vector, Lanes<T>::width> lanes;
  for (Vector& v : lanes) {
    v = size * direction(random);
  }
  const auto along = [&](int axis) {
    return Lanes<T>::generated([&](std::size_t lane) { return lanes[lane][axis]; });
  };
  return {along(0), along(1), along(2)};
}

/// Bodies of unlike moments that tumble under a moment, as many at a time as T has lanes.
template <class Integrator, class T>
void rotate(benchmark::State& state) {
  Random random{3};
  struct Group {
    Quat<T> orientation;
    Vec3<T> angular_velocity, moment, inertia;
  };
  std::vector<Group> groups;
  for (std::size_t b = 0; b < body_count; b += Lanes<T>::width) {
    groups.push_back(
        {Quat<T>{}, drawn<T>(random, 20.0), drawn<T>(random, 1e-6), {T(1e-7), T(2e-7), T(2.5e-7)}});
  }
  for (auto _ : state) {
    for (Group& group : groups) {
      Integrator::rotate(group.orientation, group.angular_velocity, group.moment, group.inertia, step);
    }
    benchmark::ClobberMemory();
  }
  count_bodies(state);
}

template <class Integrator, class T>
void translate(benchmark::State& state) {
  Random random{3};
  struct Group {
    Vec3<T> position, velocity, acceleration;
  };
  std::vector<Group> groups;
  for (std::size_t b = 0; b < body_count; b += Lanes<T>::width) {
    groups.push_back({drawn<T>(random, 1.0), {T(0), T(0), T(0)}, drawn<T>(random, 1.0)});
  }
  for (auto _ : state) {
    for (Group& group : groups) {
      Integrator::translate(group.position, group.velocity, group.acceleration, step);
    }
    benchmark::ClobberMemory();
  }
  count_bodies(state);
}

} // namespace

BENCHMARK_TEMPLATE(rotate, Leapfrog, double);
BENCHMARK_TEMPLATE(rotate, Leapfrog, Pack<double>);
BENCHMARK_TEMPLATE(rotate, RotorSplitting, double);
BENCHMARK_TEMPLATE(rotate, RotorSplitting, Pack<double>);
BENCHMARK_TEMPLATE(translate, Leapfrog, double);
BENCHMARK_TEMPLATE(translate, Leapfrog, Pack<double>);
