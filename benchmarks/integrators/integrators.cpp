// How long does an integrator take to move one body?

#include "scree/core/random.hpp"
#include "scree/integrators/leapfrog.hpp"
#include "scree/integrators/rotor_splitting.hpp"

#include <benchmark/benchmark.h>

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

/// Bodies of unlike moments that tumble under a moment.
template <class Integrator>
void rotate(benchmark::State& state) {
  Random random{3};
  struct Body {
    Quaternion orientation;
    Vector angular_velocity, moment, inertia;
  };
  std::vector<Body> bodies;
  for (std::size_t b = 0; b < body_count; ++b) {
    bodies.push_back(
        {random.orientation(), 20.0 * direction(random), 1e-6 * direction(random), {1e-7, 2e-7, 2.5e-7}});
  }
  for (auto _ : state) {
    for (Body& body : bodies) {
      Integrator::rotate(body.orientation, body.angular_velocity, body.moment, body.inertia, step);
    }
    benchmark::ClobberMemory();
  }
  count_bodies(state);
}

template <class Integrator, class Real>
void translate(benchmark::State& state) {
  Random random{3};
  struct Body {
    Vec3<double> position;
    Vec3<Real> velocity, acceleration;
  };
  std::vector<Body> bodies;
  for (std::size_t b = 0; b < body_count; ++b) {
    bodies.push_back({to_vec3(direction(random)), {}, to_vec3<Real>(direction(random))});
  }
  for (auto _ : state) {
    for (Body& body : bodies) {
      Integrator::translate(body.position, body.velocity, body.acceleration, step);
    }
    benchmark::ClobberMemory();
  }
  count_bodies(state);
}

} // namespace

BENCHMARK_TEMPLATE(rotate, Leapfrog);
BENCHMARK_TEMPLATE(rotate, RotorSplitting);
BENCHMARK_TEMPLATE(translate, Leapfrog, double);
BENCHMARK_TEMPLATE(translate, Leapfrog, float);
