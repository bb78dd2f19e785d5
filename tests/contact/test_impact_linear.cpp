/// \file
/// Free impacts under the linear law against the damped oscillation that never pulls, and what every impact
/// keeps.

#include "support/relative_error.hpp"

#include "scree/simulation/simulation.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

using namespace scree;

namespace impact_linear_tests {
using test::relative_error;

namespace {

struct Side {
  double radius;
  Material material;
};

struct Impact {
  double restitution;        ///< separation speed over approach speed
  double contact_time;       ///< s
  double lost, viscous_work; ///< J
  double momentum_change;    ///< relative to the momentum of the first
};

Clump ball(double radius) {
  return make_clump("ball", std::vector<Sphere>{{Vector::Zero(), radius}});
}

/// A head-on impact of two spheres that touch at the start, in no special direction; `steps` of it at least.
Impact impact(const Side& a, const Side& b, Stiffness convention, double speed, int steps) {
  const Vector direction = Vector{1.0, 2.0, -2.0} / 3.0;
  const Clump clump_a = ball(a.radius), clump_b = ball(b.radius);
  const double m1 = a.material.density * clump_a.volume, m2 = b.material.density * clump_b.volume;
  const auto pair = mix(a.material, b.material, convention);
  const double half_period = std::numbers::pi * std::sqrt(m1 * m2 / (m1 + m2) / pair.normal_stiffness);
  const double dt = half_period / steps;

  Simulation<> sim{{.stiffness = convention, .gravity = Vector::Zero(), .time_step = dt, .sort_interval = 0}};
  const auto of_a = sim.add_material(a.material), of_b = sim.add_material(b.material);
  // The heavier comes in slowly: the sum of momenta is zero, and both change in proportion.
  sim.add({.clump = &clump_a, .material = of_a, .velocity = speed * m2 / (m1 + m2) * direction});
  sim.add({.clump = &clump_b,
           .material = of_b,
           .position = (a.radius + b.radius) * direction,
           .velocity = -speed * m1 / (m1 + m2) * direction});
  const auto& bodies = sim.bodies();
  const auto momentum = [&] { return Vector(m1 * bodies.velocity(0) + m2 * bodies.velocity(1)); };
  const auto energy = [&] { return bodies.kinetic_energy(0) + bodies.kinetic_energy(1); };
  const auto overlap = [&] { return a.radius + b.radius - (bodies.position(1) - bodies.position(0)).norm(); };
  const Vector momentum_before = momentum();
  const double energy_before = energy();
  double before = 0.0;
  do {
    before = overlap();
    sim.step();
  } while (overlap() > 0.0 || before <= 0.0);
  const double end = sim.time() - dt * overlap() / (overlap() - before); // where the chord crosses zero

  const double separation = (bodies.velocity(1) - bodies.velocity(0)).dot(direction);
  return {separation / speed, end, energy_before - energy(), sim.dissipation().viscous,
          (momentum() - momentum_before).norm() / (m1 * m2 / (m1 + m2) * speed)};
}

Material rock(double stiffness, double restitution, double density = 2650.0) {
  return {.density = density,
          .normal_stiffness = stiffness,
          .shear_stiffness = stiffness,
          .restitution = restitution};
}

} // namespace

TEST_CASE("physics: restitution and contact time of the linear law are those of the closed form") {
  // m* x'' + 2 z w m* x' + k x = 0 with w = sqrt(k/m*), until the force is 0 after the time
  // 2 acos(z) / (w sqrt(1 - z^2)), acosh(z) / (w sqrt(z^2 - 1)) beyond z = 1. Then x = 2 z e v / w is left,
  // and the spheres part at the speed e v.
  struct Pairing {
    double radius_a, stiffness_a, density_a, radius_b, stiffness_b, density_b;
  };
  // The dashpot sets in within one step: an error of about z pi / steps.
  for (const Pairing& p : {Pairing{0.01, 1e6, 2650, 0.01, 1e6, 2650},     // mass ratio 1
                           Pairing{0.01, 1e6, 2650, 0.02, 3e6, 2650},     // 8, springs of two kinds
                           Pairing{0.03, 2e6, 7850, 0.005, 5e5, 1500}}) { // 1130
    for (const double e : {1.0, 0.9, 0.5, 0.1}) {
      for (const auto convention : {Stiffness::of_particle, Stiffness::of_contact}) {
        CAPTURE(e);
        CAPTURE(p.radius_b / p.radius_a);
        CAPTURE(static_cast<int>(convention));
        const Side a{p.radius_a, rock(p.stiffness_a, e, p.density_a)},
            b{p.radius_b, rock(p.stiffness_b, 1.0, p.density_b)};
        const Impact result = impact(a, b, convention, 0.8, e < 0.5 ? 200000 : 100000);

        const double k = convention == Stiffness::of_contact
                             ? std::min(p.stiffness_a, p.stiffness_b)
                             : p.stiffness_a * p.stiffness_b / (p.stiffness_a + p.stiffness_b);
        const auto mass = [](double r, double density) {
          return density * 4.0 / 3.0 * std::numbers::pi * r * r * r;
        };
        const double m1 = mass(p.radius_a, p.density_a), m2 = mass(p.radius_b, p.density_b);
        const double reduced = m1 * m2 / (m1 + m2);
        const double z = damping_ratio(e), q = std::sqrt(std::abs(1.0 - z * z)), w = std::sqrt(k / reduced);
        const double time = 2.0 / w * ((z < 1.0 ? std::acos(z) : std::acosh(z)) / q + z);
        CHECK(relative_error(result.restitution, e) < 1e-4);
        CHECK(relative_error(result.contact_time, time) < 1e-4);
        CHECK(result.momentum_change < 1e-12);
        // What was lost is the dashpot's work.
        const double energy = 0.5 * reduced * 0.8 * 0.8;
        CHECK(std::abs(result.lost / energy - (1.0 - e * e)) < 1e-4);
        CHECK(std::abs(result.viscous_work - result.lost) < 1e-4 * energy);
      }
    }
  }
}

TEST_CASE("physics: the error of an impact falls with the time step") {
  // The dashpot sets in with the first step and ends with the last, each somewhere within it: an error in the
  // speed of at most 2 z w dt at either end, w dt = pi / steps.
  const Side a{0.01, rock(1e6, 0.5)}, b{0.015, rock(1e6, 0.5)};
  const double z = damping_ratio(0.5);
  for (const int steps : {250, 500, 1000, 2000, 4000, 8000, 16000}) {
    const double off = std::abs(impact(a, b, Stiffness::of_particle, 1.0, steps).restitution - 0.5);
    MESSAGE("restitution off by " << off << " with " << steps << " steps");
    CHECK(off < 2.0 * z * std::numbers::pi / steps);
  }
}

TEST_CASE("physics: restitution does not depend on the speed of a linear impact") {
  const Side a{0.01, rock(1e6, 0.7)}, b{0.02, rock(2e6, 0.7)};
  const double slow = impact(a, b, Stiffness::of_particle, 0.001, 4000).restitution;
  const double mean = impact(a, b, Stiffness::of_particle, 0.1, 4000).restitution;
  const double fast = impact(a, b, Stiffness::of_particle, 3.0, 4000).restitution;
  MESSAGE(slow << " at 1 mm/s, " << mean << " at 0.1 m/s, " << fast << " at 3 m/s");
  CHECK(std::abs(slow - mean) < 1e-7);
  CHECK(std::abs(fast - mean) < 1e-7);
}

TEST_CASE("physics: damping rates add to the dashpot in proportion to the reduced mass") {
  // Both give c = rate m*, so z = rate / (2 w).
  const double radius = 0.01;
  Material material = rock(1e6, 1.0);
  const double mass = material.density * ball(radius).volume, w = std::sqrt(0.5e6 / (0.5 * mass));
  const double z = 0.2;
  material.normal_damping_rate = 2.0 * z * w;
  const Impact result = impact({radius, material}, {radius, material}, Stiffness::of_particle, 0.5, 20000);
  CHECK(relative_error(result.restitution, restitution(z)) < 1e-4);
}

TEST_CASE("physics: a fixed partner and a wall are partners of infinite mass") {
  const Clump clump = ball(0.01);
  const double dt = 1e-7;
  const auto rebound = [&](bool wall) {
    Simulation<> sim{{.gravity = Vector::Zero(), .time_step = dt, .sort_interval = 0}};
    const auto of = sim.add_material(rock(1e6, 0.6));
    sim.add({.clump = &clump, .material = of, .position = {0, 0, 0.01}, .velocity = {0, 0, -0.5}});
    if (wall) {
      sim.add_wall({.name = "floor", .surfaces = {{Plane{}, of}}, .dynamics = Fixed{}});
    } else {
      sim.add({.clump = &clump, .material = of, .position = {0, 0, -0.01}, .fixed = true});
    }
    for (int k = 0; k < 20000; ++k) {
      sim.step();
    }
    return sim.bodies().velocity(0).z();
  };
  CHECK(relative_error(rebound(true), 0.3) < 1e-4);
  CHECK(relative_error(rebound(false), 0.3) < 1e-4);
}

} // namespace impact_linear_tests
