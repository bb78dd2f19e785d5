/// \file
/// Rolling resistance: its threshold, its work, and that its null value is the base law.

#include "support/driven_contact.hpp"
#include "support/models.hpp"
#include "support/relative_error.hpp"

#include "scree/contact/linear_spring.hpp"
#include "scree/contact/rolling_resistance.hpp"
#include "scree/simulation/simulation.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace scree;

namespace rolling_resistance_tests {
using test::DrivenContact;
using test::relative_error;

namespace {

using Rolling = LinearSpring<RollingResistance>;

constexpr double radius_i = 0.01, radius_j = 0.015, overlap = 2e-5;
constexpr double reduced_radius = radius_i * radius_j / (radius_i + radius_j);

Material material(double rolling_friction) {
  return {.normal_stiffness = 1e6,
          .shear_stiffness = 8e5,
          .friction = 0.9,
          .restitution = 0.3,
          .rolling_friction = rolling_friction};
}

} // namespace

TEST_CASE("the rolling couple grows with the relative turn and stops at mu_r R* F_n") {
  const double mu_r = 0.2, dt = 1e-6, spin = 0.4;
  DrivenContact<Rolling> contact{Rolling{}, material(mu_r), radius_i, radius_j};
  const Vector i{0.0, 0.0, radius_i + radius_j - overlap}, j = Vector::Zero();
  contact.place(i, j);
  const double stiffness = 2.25 * 1e6 * mu_r * mu_r * reduced_radius * reduced_radius;
  const double limit = mu_r * reduced_radius * 1e6 * overlap;
  const double ratio = (radius_i - 0.5 * overlap) / (radius_j - 0.5 * overlap); // without slip
  for (int k = 1; k <= 200000; ++k) {
    contact.move(i, j, {spin, 0.0, 0.0}, {-spin * ratio, 0.0, 0.0}, dt);
    const double turned = spin * (1.0 + ratio) * dt * k;
    const double expected = std::min(stiffness * turned, limit);
    REQUIRE(relative_error(-contact.force.couple.x, expected) < 1e-6);
    REQUIRE(std::abs(contact.force.couple.y) + std::abs(contact.force.couple.z) == 0.0);
  }
  CHECK(relative_error(-contact.force.couple.x, limit) < 1e-9);
  // Rolled on at the limit, the couple's work is lost, but for what the spring holds.
  const double held = limit * limit / (2.0 * stiffness);
  CHECK(relative_error(contact.friction, contact.work_put_in - held) < 1e-3);
  CHECK(contact.friction > 10.0 * held);
}

TEST_CASE("the rolling dashpot adds to the spring below the limit, and nothing beyond it") {
  const double mu_r = 0.2, dt = 1e-6, spin = 0.4, damping = 0.3;
  DrivenContact<Rolling> bare{Rolling{}, material(mu_r), radius_i, radius_j};
  DrivenContact<Rolling> damped{Rolling{RollingResistance{damping}}, material(mu_r), radius_i, radius_j};
  const Vector i{0.0, 0.0, radius_i + radius_j - overlap}, j = Vector::Zero();
  const double reduced_mass = 0.5; // of two of 1 kg
  const double stiffness = 2.25 * 1e6 * mu_r * mu_r * reduced_radius * reduced_radius;
  const double dashpot =
      2.0 * damping * std::sqrt(1.4 * reduced_mass * reduced_radius * reduced_radius * stiffness);
  bare.place(i, j);
  damped.place(i, j);
  for (auto* contact : {&bare, &damped}) {
    contact->move(i, j, {spin, 0.0, 0.0}, Vector::Zero(), dt);
  }
  CHECK(relative_error(bare.force.couple.x - damped.force.couple.x, dashpot * spin) < 1e-9);
  for (int k = 0; k < 400000; ++k) {
    for (auto* contact : {&bare, &damped}) {
      contact->move(i, j, {spin, 0.0, 0.0}, Vector::Zero(), dt);
    }
  }
  CHECK(damped.force.couple.x == bare.force.couple.x);
  CHECK(damped.friction > bare.friction);
}

TEST_CASE("spin about the normal meets no rolling resistance") {
  DrivenContact<Rolling> contact{Rolling{}, material(0.3), radius_i, radius_j};
  const Vector i{0.0, 0.0, radius_i + radius_j - overlap}, j = Vector::Zero();
  contact.place(i, j);
  for (int k = 0; k < 1000; ++k) {
    contact.move(i, j, {0.0, 0.0, 10.0}, {0.0, 0.0, -3.0}, 1e-5);
  }
  CHECK(norm(contact.force.couple) < 1e-15);
}

TEST_CASE("the rolling couple turns with a pair that turns as one body") {
  const double dt = 1e-5;
  DrivenContact<Rolling> contact{Rolling{}, material(0.3), radius_i, radius_j};
  const Vector i{0.0, 0.0, radius_i + radius_j - overlap}, j = Vector::Zero();
  contact.place(i, j);
  const double ratio = (radius_i - 0.5 * overlap) / (radius_j - 0.5 * overlap);
  for (int k = 0; k < 10; ++k) {
    contact.move(i, j, {1.0, 0.4, 0.0}, {-ratio, -0.4 * ratio, 0.0}, dt);
  }
  const Vector before = to_eigen(contact.force.couple);
  REQUIRE(before.norm() > 1e-6);
  REQUIRE(contact.friction == 0.0);
  const Vector axis = Vector{1.0, -0.5, 2.0}.normalized();
  const double angle = 9.0;
  const int steps = 20000;
  for (int k = 1; k <= steps; ++k) {
    const Matrix turn = Eigen::AngleAxisd{angle * k / steps, axis}.toRotationMatrix();
    contact.move_rigidly(turn * i, turn * j, axis * (angle / steps / dt), dt);
  }
  const Matrix turn = Eigen::AngleAxisd{angle, axis}.toRotationMatrix();
  CHECK((to_eigen(contact.force.couple) - turn * before).norm() < 1e-6 * before.norm());
}

TEST_CASE("physics: a sphere on an incline rolls off only where its slope is above the rolling friction") {
  // At rest the couple must carry m g r sin(theta), and carries at most mu_r r m g cos(theta); the force acts
  // on the shorter arm r - overlap/2, 5e-5 off.
  const double radius = 0.01, gravity = 9.81;
  const Clump ball = make_clump("ball", std::vector<Sphere>{{Vector::Zero(), radius}});
  // m, travelled within half a second after the slope has been raised slowly to `slope`.
  const auto travel = [&](double mu_r, double slope) {
    const double dt = 2e-5, ramp = 0.3;
    Simulation<test::RollingLinear> sim{{.gravity = {0, 0, -gravity}, .time_step = dt}};
    Material m = material(mu_r);
    m.normal_stiffness = m.shear_stiffness = 1e5;
    const auto rock = sim.add_material(m);
    sim.add_wall({.name = "slope", .surfaces = {{Plane{}, rock}}, .dynamics = Fixed{}});
    const double weight = m.density * ball.volume * gravity;
    sim.add({.clump = &ball, .material = rock, .position = {0, 0, radius - weight / 0.5e5}});
    while (sim.time() < ramp + 0.5) {
      // A smooth start and end of the ramp, for the rolling spring has no dashpot.
      const double s = std::min(1.0, sim.time() / ramp);
      const double angle = std::atan(slope) * s * s * s * (10.0 - 15.0 * s + 6.0 * s * s);
      sim.set_gravity(gravity * Vector{std::sin(angle), 0.0, -std::cos(angle)});
      sim.step();
    }
    return sim.bodies().position(0).x();
  };
  for (const double mu_r : {0.05, 0.3}) {
    const double below = travel(mu_r, 0.98 * mu_r), above = travel(mu_r, 1.02 * mu_r);
    MESSAGE("rolling friction " << mu_r << ": moves " << below << " m at a slope of 0.98 of it, " << above
                                << " m at 1.02");
    // The spring gives way by limit / k_r = F_n / (2.25 k_n mu_r r) rad before it yields.
    const double given_way = 0.11 / (2.25 * 0.5e5 * mu_r * radius) * radius;
    CHECK(below < 2.0 * given_way);
    CHECK(above > 50.0 * given_way);
  }
}

TEST_CASE(
    "physics: a rolling sphere is slowed by mu_r g / (1 + 2/5) and what it loses is the couple's work") {
  const double radius = 0.01, gravity = 9.81, mu_r = 0.02, speed = 0.3, dt = 5e-6;
  const Clump ball = make_clump("ball", std::vector<Sphere>{{Vector::Zero(), radius}});
  Simulation<test::RollingLinear> sim{{.gravity = {0, 0, -gravity}, .time_step = dt}};
  const auto rock = sim.add_material(material(mu_r));
  sim.add_wall({.name = "floor", .surfaces = {{Plane{}, rock}}, .dynamics = Fixed{}});
  const double weight = material(mu_r).density * ball.volume * gravity;
  sim.add({.clump = &ball,
           .material = rock,
           .position = {0, 0, radius - weight / 0.5e6},
           .velocity = {speed, 0, 0},
           .angular_velocity = {0, speed / radius, 0}});
  const double before = sim.bodies().kinetic_energy(0), duration = 1.0;
  while (sim.time() < duration - 0.5 * dt) {
    sim.step();
  }
  // m a = -F, 2/5 m r^2 a / r = F r - mu_r m g r.
  const double expected = speed - mu_r * gravity / 1.4 * duration;
  CHECK(relative_error(sim.bodies().velocity(0).x(), expected) < 2e-3);
  CHECK(relative_error(sim.dissipation().total(), before - sim.bodies().kinetic_energy(0)) < 0.01);
}

} // namespace rolling_resistance_tests
