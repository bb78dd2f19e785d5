/// \file
/// Translation: a leapfrog whose velocities stand half a step behind the positions.

#include "support/relative_error.hpp"

#include "scree/integrators/leapfrog.hpp"
#include "scree/integrators/rotor_splitting.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace scree;
using test::relative_error;

namespace {

constexpr double frequency = 2.0; // rad/s
const Vec3<double> start{1.0, 0.0, -0.5}, speed{0.0, 1.5, 0.7};

Vec3<double> pull(const Vec3<double>& x) {
  return x * (-frequency * frequency);
}

struct Oscillator {
  Vec3<double> position = start, velocity = speed;

  /// As the simulation does it: the first kick takes velocities half a step on.
  template <class Integrator>
  void advance(int steps, double dt) {
    for (int k = 0; k < steps; ++k) {
      Integrator::translate(position, velocity, pull(position), {.dt = dt, .kick = fresh ? 0.5 * dt : dt});
      fresh = false;
    }
  }
  /// The velocity taken half a step on, to where the position is.
  [[nodiscard]] Vec3<double> velocity_here(double dt) const { return velocity + pull(position) * (0.5 * dt); }

  bool fresh = true;
};

/// Error of position and velocity after `duration` [s].
template <class Integrator>
double error(int steps, double duration) {
  const double dt = duration / steps;
  Oscillator o;
  o.advance<Integrator>(steps, dt);
  const double c = std::cos(frequency * duration), s = std::sin(frequency * duration);
  const Vec3<double> x = start * c + speed * (s / frequency), v = speed * c - start * (frequency * s);
  return std::max(norm(o.position - x), norm(o.velocity_here(dt) - v) / frequency);
}

} // namespace

TEST_CASE_TEMPLATE("translation is of second order, the half kick at the start included", Integrator,
                   Leapfrog, RotorSplitting) {
  const double duration = 7.3; // more than two periods, none of them whole
  double coarse = error<Integrator>(500, duration);
  for (const int steps : {1000, 2000, 4000, 8000}) {
    const double fine = error<Integrator>(steps, duration);
    const double order = std::log2(coarse / fine);
    MESSAGE(steps << " steps: error " << fine << " m, order " << order);
    CHECK(relative_error(order, 2.0) < 0.005);
    coarse = fine;
  }
}

TEST_CASE("the leapfrog of a harmonic oscillator keeps its own energy to rounding") {
  // x' = x + v dt with v at mid-step keeps v_half^2 + w^2 x x' exactly: what is conserved is known in closed
  // form.
  const double dt = 0.3 / frequency;
  Oscillator o;
  const auto invariant = [&] {
    const Vec3<double> before = o.position - o.velocity * dt;
    return squared_norm(o.velocity) + frequency * frequency * dot(o.position, before);
  };
  o.advance<Leapfrog>(1, dt);
  const double first = invariant();
  double worst = 0.0;
  for (int k = 0; k < 100000; ++k) {
    o.advance<Leapfrog>(1, dt);
    worst = std::max(worst, std::abs(invariant() / first - 1.0));
  }
  MESSAGE("largest relative change in 1e5 steps: " << worst);
  CHECK(worst < 1e-11); // 1e5 roundings of 1e-16, all of one sign at worst
}

TEST_CASE("a frequency above that of the step bursts, one below does not") {
  // Leapfrog is stable below w dt = 2.
  const auto farthest = [](double wdt) {
    Oscillator o;
    double most = 0.0;
    for (int k = 0; k < 2000; ++k) {
      o.advance<Leapfrog>(1, wdt / frequency);
      most = std::max(most, norm(o.position));
    }
    return most;
  };
  CHECK(farthest(1.99) < 100.0);
  CHECK(farthest(2.01) > 1e10);
}

TEST_CASE("a constant force gives the parabola without error") {
  const double dt = 0.01;
  const Vec3<double> g{0.0, 0.3, -9.81};
  Vec3<double> x{}, v{1.0, 2.0, 3.0};
  for (int k = 0; k < 1000; ++k) {
    Leapfrog::translate(x, v, g, {.dt = dt, .kick = k == 0 ? 0.5 * dt : dt});
  }
  const double t = 10.0;
  CHECK(norm(x - (Vec3<double>{1.0, 2.0, 3.0} * t + g * (0.5 * t * t))) < 1e-10);
}

TEST_CASE("translation runs back the way it came") {
  const double dt = 0.05;
  Oscillator o;
  o.advance<Leapfrog>(5000, dt);
  // Turned round at the step: half a kick on, the sign changed, and half a kick again, which is a fresh
  // start.
  o.velocity = -o.velocity_here(dt);
  o.fresh = true;
  o.advance<Leapfrog>(5000, dt);
  CHECK(norm(o.position - start) < 1e-11);
  CHECK(norm(o.velocity_here(dt) + speed) < 1e-11);
}
