/// \file
/// Free impacts under Hertz's law against the closed form.

#include "support/models.hpp"
#include "support/relative_error.hpp"

#include "scree/contact/hertz_mindlin.hpp"
#include "scree/simulation/simulation.hpp"

#include <boost/math/special_functions/beta.hpp>
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

using namespace scree;

namespace impact_hertz_tests {
using test::relative_error;

namespace {

constexpr double radius_a = 0.01, radius_b = 0.025;
constexpr double reduced_radius = radius_a * radius_b / (radius_a + radius_b);

Material glass(double restitution) {
  return {.density = 2500, .youngs_modulus = 6e8, .poisson_ratio = 0.2, .restitution = restitution};
}
Material rubber(double restitution) {
  return {.density = 1100, .youngs_modulus = 2e8, .poisson_ratio = 0.45, .restitution = restitution};
}

double effective_modulus() {
  return 1.0 / ((1.0 - 0.04) / 6e8 + (1.0 - 0.2025) / 2e8);
}

double reduced_mass() {
  const auto volume = [](double r) { return 4.0 / 3.0 * std::numbers::pi * r * r * r; };
  const double m1 = 2500 * volume(radius_a), m2 = 1100 * volume(radius_b);
  return m1 * m2 / (m1 + m2);
}

/// Where all the energy of the approach is in the spring: m* v^2 / 2 = 8/15 E* sqrt(R*) U^(5/2).
double greatest_overlap(double speed) {
  return std::pow(
      15.0 / 16.0 * reduced_mass() * speed * speed / (effective_modulus() * std::sqrt(reduced_radius)), 0.4);
}

/// t = 2/v int_0^U dx / sqrt(1 - (x/U)^(5/2)) = 4/5 B(2/5, 1/2) U / v = 2.94 U / v.
double contact_time(double speed) {
  return 0.8 * boost::math::beta(0.4, 0.5) * greatest_overlap(speed) / speed;
}

struct Impact {
  double restitution, contact_time, greatest_overlap, greatest_force, lost, viscous_work, momentum_change;
};

Impact impact(double restitution, double speed, int steps) {
  const Vector direction = Vector{2.0, -1.0, 2.0} / 3.0;
  const Clump a = make_clump("a", std::vector<Sphere>{{Vector::Zero(), radius_a}});
  const Clump b = make_clump("b", std::vector<Sphere>{{Vector::Zero(), radius_b}});
  const double dt = contact_time(speed) / steps;
  Simulation<test::Hertzian> sim{
      {.gravity = Vector::Zero(), .time_step = dt, .top_speed = speed, .sort_interval = 0}};
  const auto of_a = sim.add_material(glass(restitution)), of_b = sim.add_material(rubber(1.0));
  sim.add({.clump = &a, .material = of_a, .velocity = speed * direction});
  sim.add({.clump = &b, .material = of_b, .position = (radius_a + radius_b) * direction});
  const auto& bodies = sim.bodies();
  const double m1 = bodies.mass(0), m2 = bodies.mass(1);
  const auto overlap = [&] { return radius_a + radius_b - (bodies.position(1) - bodies.position(0)).norm(); };
  const auto energy = [&] { return bodies.kinetic_energy(0) + bodies.kinetic_energy(1); };
  const double energy_before = energy();

  Impact result{};
  double before = 0.0;
  do {
    before = overlap();
    sim.step();
    result.greatest_overlap = std::max(result.greatest_overlap, overlap());
    result.greatest_force = std::max(result.greatest_force, to_eigen(bodies.forces()[0].force).norm());
  } while (overlap() > 0.0 || before <= 0.0);
  result.contact_time = sim.time() - dt * overlap() / (overlap() - before);
  result.restitution = (bodies.velocity(1) - bodies.velocity(0)).dot(direction) / speed;
  result.lost = energy_before - energy();
  result.viscous_work = sim.dissipation().viscous;
  result.momentum_change =
      (m1 * bodies.velocity(0) + m2 * bodies.velocity(1) - m1 * speed * direction).norm() / (m1 * speed);
  return result;
}

} // namespace

TEST_CASE("the closed form of Hertz's contact time is the textbook's") {
  // 2.87 (m*^2 / (R* E*^2 v))^(1/5) (Johnson, Contact Mechanics, 1985, section 11.4, in rounded figures).
  const double m = reduced_mass(), e = effective_modulus(), v = 0.3;
  const double textbook = 2.87 * std::pow(m * m / (reduced_radius * e * e * v), 0.2);
  CHECK(relative_error(contact_time(v), textbook) < 2e-3);
}

TEST_CASE("physics: an elastic impact lasts, overlaps and pushes as Hertz's closed form has it") {
  for (const double speed : {0.02, 0.3, 2.0}) {
    CAPTURE(speed);
    const Impact result = impact(1.0, speed, 20000);
    const double overlap = greatest_overlap(speed);
    const double force = 4.0 / 3.0 * effective_modulus() * std::sqrt(reduced_radius * overlap) * overlap;
    CHECK(relative_error(result.contact_time, contact_time(speed)) < 1e-4);
    CHECK(relative_error(result.greatest_overlap, overlap) < 1e-6);
    CHECK(relative_error(result.greatest_force, force) < 1e-6);
    CHECK(relative_error(result.restitution, 1.0) < 1e-6);
    CHECK(result.momentum_change < 1e-12);
    CHECK(result.viscous_work == 0.0);
  }
}

TEST_CASE("physics: the dashpot of Hertz's law gives the requested restitution at any speed") {
  // A dashpot in proportion to x^(1/4) turns the equation of motion into that of the linear oscillator
  // (Antypov & Elliott, EPL 94:50004, 2011), so that the formula is exact for a contact that ends where the
  // overlap does.
  for (const double e : {0.95, 0.7, 0.3, 0.1}) {
    for (const double speed : {0.02, 2.0}) {
      CAPTURE(e);
      CAPTURE(speed);
      const Impact result = impact(e, speed, 40000);
      MESSAGE("restitution " << e << " at " << speed << " m/s: off by " << result.restitution - e);
      CHECK(std::abs(result.restitution - e) < 1e-4);
      CHECK(result.momentum_change < 1e-12);
      const double energy = 0.5 * reduced_mass() * speed * speed;
      CHECK(std::abs(result.viscous_work - result.lost) < 1e-4 * energy);
      CHECK(relative_error(result.lost / energy, 1.0 - e * e) < 2e-4);
    }
  }
}

TEST_CASE("physics: the elastic impact converges with the second order of the leapfrog") {
  const double exact = greatest_overlap(0.5);
  const auto off = [&](int steps) { return std::abs(impact(1.0, 0.5, steps).restitution - 1.0); };
  const double coarse = off(100), fine = off(1600);
  MESSAGE("restitution off by " << coarse << " with 100 steps, by " << fine << " with 1600; overlap " << exact
                                << " m");
  CHECK(fine < coarse / 100.0); // 256 for second order, less the chance of where the last step falls
}

} // namespace impact_hertz_tests
