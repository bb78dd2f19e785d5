/// \file
/// The tangential spring: it turns with the contact, slides at Coulomb's limit, and its work is accounted
/// for.

#include "support/driven_contact.hpp"
#include "support/relative_error.hpp"

#include "scree/contact/hertz_mindlin.hpp"
#include "scree/contact/linear_spring.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

using namespace scree;
using namespace scree::test;

namespace tangential_spring_tests {

namespace {

constexpr double radius_i = 0.01, radius_j = 0.015, overlap = 2e-5, dt = 1e-5;
const Vector no_spin = Vector::Zero();

Material material(double friction, double restitution = 1.0) {
  return {.normal_stiffness = 1e6,
          .shear_stiffness = 8e5,
          .youngs_modulus = 1e9,
          .poisson_ratio = 0.3,
          .friction = friction,
          .restitution = restitution};
}

/// A pair under `overlap` whose spring a slip of 0.1 um has loaded, far below the friction limit.
template <class Law>
DrivenContact<Law> loaded() {
  DrivenContact<Law> contact{Law{}, material(0.6), radius_i, radius_j};
  const Vector i{0.0, 0.0, radius_i + radius_j - overlap};
  contact.place(i, Vector::Zero());
  for (int k = 1; k <= 100; ++k) {
    contact.move(i + 1e-9 * k * Vector{0.6, 0.8, 0.0}, 1e-9 * k * Vector{-0.2, 0.1, 0.0}, no_spin, no_spin,
                 dt);
  }
  return contact;
}

struct Turned {
  double size_off, direction_off; // relative, rad
};

/// A pair with a loaded spring that turns as one body by `angle` [rad] about `axis`.
template <class Law>
Turned turned(const Vector& axis, double angle, int steps) {
  auto contact = loaded<Law>();
  const Vector i{0.0, 0.0, radius_i + radius_j - overlap}, j = Vector::Zero();
  const auto before = contact.tangential();
  const Vector spring{before.x(), before.y(), 0.0}; // less the 1e-5 rad by which loading tilted the pair
  contact.history[0] = spring.x();
  contact.history[1] = spring.y();
  contact.history[2] = 0.0;
  REQUIRE(spring.norm() > 0.01);
  const Vector centre{0.003, -0.002, 0.006};
  const Vector spin = axis.normalized() * (angle / steps / dt);
  for (int k = 1; k <= steps; ++k) {
    const Matrix turn = Eigen::AngleAxisd{angle * k / steps, axis.normalized()}.toRotationMatrix();
    contact.move_rigidly(turn * (i - centre), turn * (j - centre), spin, dt);
  }
  const Matrix turn = Eigen::AngleAxisd{angle, axis.normalized()}.toRotationMatrix();
  const Vector after = contact.tangential();
  CHECK(std::abs(contact.friction) < 1e-14); // of some 1e-9 J in the spring
  return {std::abs(after.norm() / spring.norm() - 1.0),
          (after.normalized() - turn * spring.normalized()).norm()};
}

} // namespace

TEST_CASE_TEMPLATE("the tangential force turns with a pair that turns as one body and keeps its size", Law,
                   LinearSpring<>, HertzMindlin<>) {
  const double full = 2.0 * std::numbers::pi;
  for (const Vector& axis :
       {Vector{0.0, 0.0, 1.0}, Vector{1.0, 0.0, 0.0}, Vector{0.3, -1.0, 0.0}, Vector{1.0, 2.0, -0.7}}) {
    CAPTURE(axis.transpose());
    // Ten turns and a bit. A step of angle a is turned to third order: a^4 / 8 off in size, a^3 / 6 in
    // direction.
    const double angle = 10.3 * full;
    for (const int steps : {5000, 20000}) {
      const Turned off = turned<Law>(axis, angle, steps);
      const double a = angle / steps;
      MESSAGE("steps of " << a << " rad about " << axis.transpose() << ": size off by " << off.size_off
                          << ", direction by " << off.direction_off);
      CHECK(off.size_off < 1.01 * steps * a * a * a * a / 8.0 + 1e-11);
      CHECK(off.direction_off < 1.01 * steps * a * a * a / 6.0 + 1e-11);
    }
  }
}

TEST_CASE("a spring of a contact that does not turn stays as it was, to the bit") {
  auto contact = loaded<LinearSpring<>>();
  const auto before = contact.history;
  const Vector i = Vector{0.0, 0.0, radius_i + radius_j - overlap}, j = Vector::Zero();
  contact.place(i, j);
  contact.history = {before[0], before[1], 0.0};
  for (int k = 0; k < 1000; ++k) {
    contact.move(i, j, no_spin, no_spin, dt);
  }
  CHECK(contact.history[0] == before[0]);
  CHECK(contact.history[1] == before[1]);
  CHECK(contact.history[2] == 0.0);
}

TEST_CASE_TEMPLATE("rolling without slip loads no tangential spring", Law, LinearSpring<>, HertzMindlin<>) {
  // Gear wheels: contact points of the two spheres move alike.
  DrivenContact<Law> contact{Law{}, material(0.5), radius_i, radius_j};
  const Vector i{0.0, 0.0, radius_i + radius_j - overlap}, j = Vector::Zero();
  contact.place(i, j);
  const double spin = 50.0;
  const double ratio = (radius_i - 0.5 * overlap) / (radius_j - 0.5 * overlap);
  for (int k = 0; k < 1000; ++k) {
    contact.move(i, j, {spin, 0.0, 0.0}, {-spin * ratio, 0.0, 0.0}, dt);
    REQUIRE(contact.tangential().norm() < 1e-10);
  }
  // The same spin of both slips by twice as much, to the limit.
  for (int k = 0; k < 1000; ++k) {
    contact.move(i, j, {spin, 0.0, 0.0}, {spin, 0.0, 0.0}, dt);
  }
  CHECK(relative_error(contact.tangential().norm(), 0.5 * contact.force.normal) < 1e-12);
}

TEST_CASE_TEMPLATE("the tangential force grows with the stiffness and stops at the friction limit", Law,
                   LinearSpring<>, HertzMindlin<>) {
  for (const double friction : {0.0, 0.2, 0.7}) {
    CAPTURE(friction);
    DrivenContact<Law> contact{Law{}, material(friction), radius_i, radius_j};
    const Vector i{0.0, 0.0, radius_i + radius_j - overlap};
    contact.place(i, Vector::Zero());
    const auto at = [](double slip) { return Vector{slip, 0.0, radius_i + radius_j - overlap}; };
    const double reduced_radius = radius_i * radius_j / (radius_i + radius_j);
    const double shear_modulus = 1e9 / (2.6 * 1.7) / 2.0;
    const bool hertz = Law::history_size > 3;
    const double stiffness = hertz ? 8.0 * shear_modulus * std::sqrt(reduced_radius * overlap) : 8e5;
    for (int k = 1; k <= 5000; ++k) {
      const double slip = 1e-8 * k; // to 50 um, where the limit is
      contact.move(at(slip), Vector::Zero(), no_spin, no_spin, dt);
      const double expected = std::min(stiffness * slip, friction * contact.force.normal);
      // The pair tilts by slip/distance and the overlap falls by half the square of it: a few 1e-3 at most.
      REQUIRE(std::abs(-contact.tangential().x() - expected) <= 0.01 * expected);
      REQUIRE(contact.tangential().norm() <= friction * contact.force.normal * (1.0 + 1e-14));
    }
  }
}

TEST_CASE_TEMPLATE("the force turns against the slip when that turns, and slides at the same limit", Law,
                   LinearSpring<>, HertzMindlin<>) {
  DrivenContact<Law> contact{Law{}, material(0.3), radius_i, radius_j};
  const Vector i{0.0, 0.0, radius_i + radius_j - overlap};
  contact.place(i, Vector::Zero());
  // Slip from counter-rotation, so that the normal stays: half a circle of directions.
  Vector slip{};
  for (int k = 0; k < 20000; ++k) {
    const double a = std::numbers::pi * k / 20000;
    slip = {std::cos(a), std::sin(a), 0.0};
    const Vector spin =
        20.0 * Vector::UnitZ().cross(slip); // contact point of i moves along -(spin x z) = slip
    contact.move(i, Vector::Zero(), -spin, no_spin, dt);
  }
  const Vector moves = to_eigen(contact.kinematics.velocity).normalized();
  CHECK(relative_error(contact.tangential().norm(), 0.3 * contact.force.normal) < 1e-12);
  CHECK(contact.tangential().normalized().dot(-moves) > 0.999);
}

TEST_CASE_TEMPLATE("the work of a driven cycle is lost in friction and dashpots or held in the springs", Law,
                   LinearSpring<>, HertzMindlin<>) {
  for (const double restitution : {1.0, 0.5}) {
    for (const double amplitude : {1e-6, 2e-5}) { // below and far above the friction limit
      CAPTURE(restitution);
      CAPTURE(amplitude);
      DrivenContact<Law> contact{Law{}, material(0.4, restitution), radius_i, radius_j};
      const Vector centre{0.0, 0.0, radius_i + radius_j - overlap};
      contact.place(centre, Vector::Zero());
      contact.move(centre, Vector::Zero(), no_spin, no_spin, dt);
      const double at_start = contact.elastic_energy();
      contact.work_put_in = contact.friction = contact.viscous = 0.0;
      const double duration = 0.02;
      const int steps = 40000; // two turns of an ellipse, with the overlap coming and going
      for (int k = 1; k <= steps; ++k) {
        const double a = 4.0 * std::numbers::pi * k / steps;
        const Vector at = centre + amplitude * Vector{std::sin(a), 0.5 * (1.0 - std::cos(a)), 0.0} +
                          Vector{0.0, 0.0, 0.25 * overlap * std::sin(2.0 * a)};
        contact.move(at, Vector::Zero(), no_spin, no_spin, duration / steps);
      }
      const double held = contact.elastic_energy() - at_start;
      const double lost = contact.friction + contact.viscous;
      const std::string name = Law::history_size > 3 ? "Hertz" : "linear";
      MESSAGE(name << ", restitution " << restitution << ", slip " << amplitude << " m: put in "
                   << contact.work_put_in << " J, friction " << contact.friction << ", dashpots "
                   << contact.viscous << ", held " << held);
      CHECK(std::abs(contact.work_put_in - lost - held) <
            std::max(0.01 * contact.work_put_in, 1e-3 * at_start));
      if (amplitude > 1e-5) {
        CHECK(contact.friction > 0.5 * contact.work_put_in);
      }
      CHECK((contact.viscous > 0.0) == (restitution < 1.0));
    }
  }
}

TEST_CASE("Mindlin's spring makes no energy when the normal force falls") {
  // Loaded under a large overlap, unloaded under a small one: an increment law without correction would give
  // back more than was put in (Elata & Berryman 1996).
  DrivenContact<HertzMindlin<>> contact{{}, material(0.8), radius_i, radius_j};
  const double distance = radius_i + radius_j;
  const auto at = [&](double slip, double depth) { return Vector{slip, 0.0, distance - depth}; };
  contact.place(at(0.0, 5e-5), Vector::Zero());
  double put_in = 0.0;
  for (int cycle = 0; cycle < 3; ++cycle) {
    const int steps = 4000;
    const auto leg = [&](double slip0, double depth0, double slip1, double depth1) {
      for (int k = 1; k <= steps; ++k) {
        const double f = static_cast<double>(k) / steps;
        contact.move(at(slip0 + f * (slip1 - slip0), depth0 + f * (depth1 - depth0)), Vector::Zero(), no_spin,
                     no_spin, 1e-6);
      }
    };
    contact.work_put_in = 0.0;
    leg(0.0, 5e-5, 5e-6, 5e-5);
    leg(5e-6, 5e-5, 5e-6, 1e-5);
    leg(5e-6, 1e-5, 0.0, 1e-5);
    leg(0.0, 1e-5, 0.0, 5e-5);
    put_in += contact.work_put_in;
  }
  MESSAGE("put in by three cycles: " << put_in << " J");
  CHECK(put_in > 0.0);
}

} // namespace tangential_spring_tests
