#include "scree/walls/rope_coupled.hpp"

#include "scree/core/random.hpp"
#include "scree/integrators/leapfrog.hpp"
#include "support/relative_error.hpp"
#include "support/rotate.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

using namespace scree;

namespace {

const Vector down{0, 0, -9.81};
constexpr double g = 9.81;
constexpr double pi = std::numbers::pi;

/// A rope-coupled body by itself: what the simulation does with it, without grains.
struct Rig {
  RopeCoupled body;
  Vector gravity = down;
  double dt = 1e-4;
  WallMotion motion{};
  WallLoad load{};
  std::size_t steps = 0;

  [[nodiscard]] double time() const { return static_cast<double>(steps) * dt; }
  void step() {
    const bool first = steps == 0;
    const TimeStep now{time(), dt, first ? 0.5 * dt : dt, gravity};
    if (first) {
      body.start(motion, now);
    }
    body.advance(motion, load, now);
    ++steps;
  }
  void run(double duration) {
    const double end = time() + duration;
    while (time() < end - 0.5 * dt) {
      step();
    }
  }
  [[nodiscard]] Vector centre() const { return motion.to_space(body.centre()); }
};

MassProperties solid(double mass, const Vector& centre, const Matrix& inertia) {
  return {mass, centre, inertia};
}

/// A full inertia tensor of a solid: principal moments 0.05, 0.08, 0.1 in axes along none of the frame's.
Matrix skew_inertia() {
  const Matrix axes = Quaternion{0.9, 0.2, -0.3, 0.4}.normalized().toRotationMatrix();
  return axes * Vector{0.05, 0.08, 0.1}.asDiagonal() * axes.transpose();
}

/// s, of an oscillation of `signal` about 0 over several periods of about `guess`; by its upward crossings,
/// whose times are found between the steps.
template <class Signal>
double period_of(Rig& rig, double guess, int periods, Signal signal) {
  std::vector<double> crossings;
  double before = signal(rig);
  while (crossings.size() <= static_cast<std::size_t>(periods)) {
    REQUIRE(rig.time() < 2.0 * (periods + 2) * guess);
    rig.step();
    const double now = signal(rig);
    if (before < 0.0 && now >= 0.0) {
      crossings.push_back(rig.time() - rig.dt * now / (now - before));
    }
    before = now;
  }
  return (crossings.back() - crossings.front()) / periods;
}

} // namespace

TEST_CASE("hung on two ropes a body comes to rest where forces and moments balance") {
  // The centre of mass is nearer to the left rope, and off the plane of the two.
  const double mass = 8.0;
  const auto rope = [](const char* name, double x) {
    return Rope{.name = name, .hitch = {x, 0, 0}, .winch = {x, 0, 1}, .stiffness = 5e4};
  };
  Rig rig{
      RopeCoupled{solid(mass, {0.05, 0.01, -0.1}, skew_inertia()), {rope("left", 0.0), rope("right", 0.2)}}};
  for (int k = 0; k < 200000; ++k) {
    // A drag brings it to rest, which ropes in line with the motion cannot.
    rig.load.force = -60.0 * rig.body.velocity();
    rig.load.moment =
        -2.0 * rig.motion.angular_velocity + (rig.centre() - rig.motion.position).cross(rig.load.force);
    rig.step();
  }
  const auto& ropes = rig.body.ropes();
  Vector force = mass * down, moment = Vector::Zero();
  for (const Rope& r : ropes) {
    const Vector at = rig.motion.to_space(r.hitch);
    const Vector pull = r.tension * (r.winch - at).normalized();
    force += pull;
    moment += (at - rig.centre()).cross(pull);
  }
  CHECK(rig.motion.angular_velocity.norm() < 1e-5);
  CHECK(force.norm() < 1e-6 * mass * g);
  CHECK(moment.norm() < 1e-6 * mass * g * 0.2);
  CHECK(ropes[0].tension + ropes[1].tension == test::about(mass * g, 1e-6));
  CHECK(ropes[0].tension == test::about(0.75 * mass * g, 0.01)); // but for the tilt
}

TEST_CASE("hung on three ropes at rest a body's tensions are those of statics") {
  const double mass = 7.5;
  const std::vector<Vector> hitches{{0.15, 0, 0}, {-0.1, 0.12, 0}, {-0.1, -0.1, 0}};
  // Tensions from sum t = m g and sum t x_hitch = m g x_centre; the stretch that they need is there from the
  // start.
  Matrix system;
  for (int k = 0; k < 3; ++k) {
    const Vector& h = hitches[static_cast<std::size_t>(k)];
    system.col(k) = Vector{1.0, h.x(), h.y()};
  }
  const Vector tension = system.inverse() * (mass * g * Vector{1.0, 0.02, 0.01});
  std::vector<Rope> ropes;
  for (std::size_t k = 0; k < 3; ++k) {
    ropes.push_back({.hitch = hitches[k],
                     .winch = hitches[k] + Vector{0, 0, 2},
                     .stiffness = 1e5 * static_cast<double>(k + 1),
                     .slack = -tension[static_cast<int>(k)] / (1e5 * static_cast<double>(k + 1))});
  }
  Rig rig{RopeCoupled{solid(mass, {0.02, 0.01, -0.08}, skew_inertia()), ropes}};
  for (int k = 0; k < 20000; ++k) {
    rig.step();
    double sum = 0.0;
    for (std::size_t r = 0; r < 3; ++r) {
      REQUIRE(rig.body.ropes()[r].tension == test::about(tension[static_cast<int>(r)], 1e-6));
      sum += rig.body.ropes()[r].tension;
    }
    REQUIRE(sum == test::about(mass * g, 1e-6));
  }
  CHECK(rig.centre().isApprox(Vector{0.02, 0.01, -0.08}, 1e-9));
}

TEST_CASE("on two ropes from one winch a body swings as the compound pendulum about it") {
  // In the plane of the ropes the triangle of winch and hitches is rigid, so that the pivot is the winch
  // itself.
  const double mass = 8.0, depth = 0.7, amplitude = 0.01;
  const Matrix inertia = Vector{0.05, 0.08, 0.1}.asDiagonal(); // swings about y
  std::vector<Rope> ropes;
  for (const double side : {-0.3, 0.3}) {
    const double share = std::hypot(0.3, 0.6) / 0.6; // of the weight that a rope at this slope carries, twice
    ropes.push_back({.hitch = {side, 0, -0.6}, .stiffness = 2e7, .slack = -0.5 * mass * g * share / 2e7});
  }
  Rig rig{RopeCoupled{solid(mass, {0, 0, -depth}, inertia), ropes}, down, 2e-5};
  rig.motion.orientation = Eigen::AngleAxisd{amplitude, Vector::UnitY()};
  const double expected = 2.0 * pi * std::sqrt((inertia(1, 1) + mass * depth * depth) / (mass * g * depth)) *
                          (1.0 + amplitude * amplitude / 16.0);
  const double measured = period_of(rig, expected, 4, [](const Rig& r) { return r.centre().x(); });
  CHECK(measured == test::about(expected, 2e-5));
  CHECK(std::abs(rig.centre().y()) < 1e-9);
  // Not the simple pendulum of the same depth: 1 per cent longer.
  CHECK(measured > 1.009 * 2.0 * pi * std::sqrt(depth / g));
}

TEST_CASE(
    "on two parallel ropes a body swings across without turning, with the period of the ropes' length") {
  const double mass = 8.0, length = 1.3, amplitude = 0.01, k = 1e7;
  std::vector<Rope> ropes;
  for (const double side : {-0.2, 0.2}) {
    ropes.push_back({.hitch = {side, 0, 0.1}, .winch = {side, 0, 0.1 + length}, .stiffness = k});
    ropes.back().slack = -0.5 * mass * g / k;
  }
  Rig rig{RopeCoupled{solid(mass, {0, 0, 0}, skew_inertia()), ropes}, down, 2e-5};
  const double angle = amplitude;
  rig.motion.position = {length * std::sin(angle), 0, length * (1.0 - std::cos(angle))};
  const double expected = 2.0 * pi * std::sqrt(length / g) * (1.0 + angle * angle / 16.0);
  const double measured = period_of(rig, expected, 4, [](const Rig& r) { return r.centre().x(); });
  CHECK(measured == test::about(expected, 2e-5));
}

TEST_CASE("two parallel ropes resist a turn about the vertical as the bifilar suspension does") {
  const double mass = 8.0, length = 1.3, half = 0.2, k = 1e7;
  const double moment = 0.09; // about the vertical
  std::vector<Rope> ropes;
  for (const double side : {-half, half}) {
    ropes.push_back(
        {.hitch = {side, 0, 0}, .winch = {side, 0, length}, .stiffness = k, .slack = -0.5 * mass * g / k});
  }
  Rig rig{RopeCoupled{solid(mass, Vector::Zero(), Vector{0.05, 0.08, moment}.asDiagonal()), ropes}, down,
          2e-5};
  const double angle = 0.01;
  rig.motion.orientation = Eigen::AngleAxisd{angle, Vector::UnitZ()};
  rig.motion.position.z() = length - std::sqrt(length * length - 2.0 * half * half * (1.0 - std::cos(angle)));
  const double expected = 2.0 * pi * std::sqrt(moment * length / (mass * g * half * half));
  const double measured = period_of(rig, expected, 4, [](const Rig& r) { return r.motion.orientation.z(); });
  CHECK(measured == test::about(expected, 5e-5));
}

TEST_CASE("a winch that starts at once pulls a free body as the closed form says") {
  // In the frame of the winch the body is an oscillator that starts with the winch's speed.
  const double mass = 5.0, k = 2e4, speed = 0.1;
  const double w = std::sqrt(k / mass);
  Rope rope{.winch = {3, 0, 0}, .stiffness = k};
  rope.wound = [=](double t) { return speed * t; };
  Rig rig{RopeCoupled{solid(mass, Vector::Zero(), skew_inertia()), {rope}}, Vector::Zero(), 1e-5};
  double work = 0.0;
  for (int k2 = 0; k2 < 10000; ++k2) {
    const double t = rig.time();
    rig.step();
    const Rope& r = rig.body.ropes()[0];
    work += r.tension * speed * rig.dt;
    REQUIRE(std::abs(r.tension - std::max(0.0, k * speed / w * std::sin(w * t))) < 1e-5 * k * speed / w);
    if (std::sin(w * t) < 0.0) {
      break; // slack from here on
    }
    REQUIRE(std::abs(rig.centre().x() - (speed * rig.time() - speed / w * std::sin(w * rig.time()))) <
            1e-5 * speed / w);
  }
  CHECK(rig.time() > 0.99 * pi / w);
  const Rope& r = rig.body.ropes()[0];
  CHECK(r.winch_work == test::about(work, 1e-9));
  CHECK(r.winch_work == test::about(rig.body.kinetic_energy(), 1e-3)); // no stretch is left
  CHECK(r.impulse.x() == test::about(mass * rig.body.velocity().x(), 1e-12));
}

TEST_CASE("the stretch of the geometry is that which Coetzee et al. Eqs. (16)-(19) accumulate") {
  // A body that swings, turns and is wound in; its rope's stretch summed from velocities, as in the paper.
  const auto error = [](double dt) {
    Rope drag{.hitch = {0.1, 0.05, 0.0}, .winch = {2.0, 0.1, 0.3}, .stiffness = 2e3};
    drag.wound = [](double t) { return 0.2 * t; };
    const Rope hoist{.hitch = {-0.1, 0.0, 0.1}, .winch = {0, 0, 1.0}, .stiffness = 2e3};
    Rig rig{RopeCoupled{solid(4.0, {0.0, 0.01, -0.05}, skew_inertia()), {drag, hoist}}, down, dt};
    rig.motion.angular_velocity = {0.3, -0.2, 0.5};
    double accumulated = 0.0, worst = 0.0;
    for (int k = 0; rig.time() < 1.0; ++k) {
      const WallMotion before = rig.motion;
      rig.step();
      if (k > 0) {
        worst = std::max(worst, std::abs(rig.body.ropes()[0].stretch - accumulated));
      }
      // Hitch velocity along the rope, in the middle of the step, and the winch's speed.
      const Vector from = before.to_space(drag.hitch), to = rig.motion.to_space(drag.hitch);
      const Vector along = (drag.winch - 0.5 * (from + to)).normalized();
      const Vector mid_velocity =
          rig.body.velocity() +
          rig.motion.angular_velocity.cross(0.5 * (from + to) -
                                            0.5 * (before.to_space(rig.body.centre()) + rig.centre()));
      accumulated += (0.2 - mid_velocity.dot(along)) * dt;
    }
    CHECK(rig.body.ropes()[0].stretch != 0.0);
    return worst;
  };
  const double coarse = error(1e-3), fine = error(5e-4);
  CHECK(coarse < 1e-4);
  CHECK(fine < 0.35 * coarse); // second order, the integration error of the sum
}

TEST_CASE("a slack rope carries nothing, and becomes taut where its length says") {
  const double drop = 0.05;
  Rig rig{RopeCoupled{solid(3.0, Vector::Zero(), skew_inertia()),
                      {{.winch = {0, 0, 1}, .stiffness = 1e5, .slack = drop}}}};
  while (rig.centre().z() > -drop) {
    const double z = rig.centre().z();
    rig.step();
    REQUIRE(rig.body.ropes()[0].tension == 0.0);
    REQUIRE(rig.body.ropes()[0].stretch == test::about(-z - drop, 1e-9));
    const double t = rig.time();
    REQUIRE(rig.centre().z() == test::about(-0.5 * g * t * t, 1e-9));
  }
  rig.step();
  CHECK(rig.body.ropes()[0].tension > 0.0);
  CHECK(rig.body.ropes()[0].tension == test::about(1e5 * rig.body.ropes()[0].stretch));
}

TEST_CASE("a rope does not push, however fast its hitch comes") {
  Rig rig{RopeCoupled{solid(3.0, Vector::Zero(), skew_inertia()),
                      {{.winch = {1, 0, 0}, .stiffness = 1e4, .damping = 500.0, .slack = -1e-3}}},
          Vector::Zero()};
  rig.motion.velocity = {2, 0, 0};
  for (int k = 0; k < 500; ++k) {
    rig.step();
    REQUIRE(rig.body.ropes()[0].tension >= 0.0);
  }
  CHECK(rig.body.velocity().x() == test::about(2.0, 0.01));
}

TEST_CASE("without forces the body turns as the integrator of the grains has it") {
  const Vector moments{0.05, 0.08, 0.1};
  Rig rig{RopeCoupled{solid(2.0, Vector::Zero(), moments.asDiagonal())}, Vector::Zero(), 1e-3};
  const Quaternion start{0.3, 0.4, -0.5, 0.6};
  rig.motion.orientation = start.normalized();
  Quaternion q = rig.motion.orientation;
  Vector w{3.0, -5.0, 4.0}; // in the principal frame
  rig.motion.angular_velocity = q * w;
  for (int k = 0; k < 2000; ++k) {
    const TimeStep now{rig.time(), rig.dt, k == 0 ? 0.5 * rig.dt : rig.dt, Vector::Zero()};
    rig.step();
    test::rotate<Leapfrog>(q, w, Vector::Zero(), moments, now);
    REQUIRE(rig.motion.orientation.angularDistance(q) < 1e-11);
    REQUIRE((rig.motion.angular_velocity - q * w).norm() < 1e-11);
  }
}

TEST_CASE(
    "without forces the centre goes straight on, wherever it is in the wall's frame, and momenta are kept") {
  const Vector offset{0.3, -0.2, 0.5};
  const auto spin_drift = [&](double dt) {
    Rig rig{RopeCoupled{solid(2.0, offset, skew_inertia())}, Vector::Zero(), dt};
    rig.motion.position = {1, 2, 3};
    rig.motion.orientation = Quaternion{0.9, 0.1, 0.3, -0.2}.normalized();
    rig.motion.velocity = {0.4, 0.5, -0.6};
    rig.motion.angular_velocity = {3.0, -5.0, 4.0};
    const Vector from = rig.centre();
    const Vector v = rig.motion.velocity_at(from);
    const auto angular_momentum = [&] {
      const Matrix turn = rig.motion.orientation.toRotationMatrix();
      return Vector(turn * skew_inertia() * turn.transpose() * rig.motion.angular_velocity);
    };
    rig.step();
    const Vector before = angular_momentum();
    const double energy = rig.body.kinetic_energy();
    double worst = 0.0;
    while (rig.time() < 5.0) {
      rig.step();
      worst = std::max(worst, (angular_momentum() - before).norm() / before.norm());
      REQUIRE((rig.centre() - from - v * rig.time()).norm() < 1e-11);
      REQUIRE(rig.body.kinetic_energy() == test::about(energy, 1e-9));
    }
    return worst;
  };
  const double coarse = spin_drift(1e-3), fine = spin_drift(5e-4);
  CHECK(coarse < 1e-2);
  CHECK(fine < 0.6 * coarse); // the velocity stands half a step behind the orientation: first order, bounded
}

TEST_CASE("a force of the grains acts at its point") {
  // A constant force on the wall, told as force and moment about the frame's origin, at the centre of mass:
  // no turn.
  Rig rig{RopeCoupled{solid(2.0, {0.3, 0.0, 0.1}, skew_inertia())}, Vector::Zero(), 1e-3};
  const Vector force{1.0, 2.0, -3.0};
  rig.load.force = force;
  rig.load.moment = Vector{0.3, 0.0, 0.1}.cross(force);
  rig.run(0.5);
  CHECK(rig.motion.angular_velocity.norm() < 1e-14);
  CHECK((rig.centre() - Vector{0.3, 0.0, 0.1} - force / 2.0 * 0.125).norm() < 1e-12);

  // A pure moment turns a body about its centre, about a principal axis as a wheel.
  Rig wheel{RopeCoupled{solid(2.0, {0.3, 0.0, 0.1}, Vector{0.05, 0.08, 0.1}.asDiagonal())}, Vector::Zero(),
            1e-3};
  wheel.load.moment = {0, 0.4, 0};
  wheel.run(0.5);
  CHECK((wheel.centre() - Vector{0.3, 0.0, 0.1}).norm() < 1e-14);
  CHECK(Eigen::AngleAxisd{wheel.motion.orientation}.angle() == test::about(0.5 * 0.4 / 0.08 * 0.25, 1e-9));
}

TEST_CASE("the stable step of ropes lies below the true limit of the stiffest motion") {
  // Three ropes that pull along one line on a hitch away from the centre.
  std::vector<Rope> ropes;
  for (int k = 0; k < 3; ++k) {
    ropes.push_back(
        {.hitch = {0.2, 0, 0}, .winch = {0.2, 0, 1.0}, .stiffness = 1e4 * (k + 1), .slack = -0.01});
  }
  const RopeCoupled body{solid(3.0, Vector::Zero(), Vector{0.05, 0.08, 0.1}.asDiagonal()), ropes};
  const double true_frequency2 = 6e4 * (1.0 / 3.0 + 0.04 / 0.08); // vertical force at a lever of 0.2 about y
  CHECK(body.squared_frequency() >= true_frequency2);
  CHECK(body.squared_frequency() < 2.0 * true_frequency2);
  CHECK(body.holder().find("rope") != std::string::npos);
  CHECK(RopeCoupled{solid(3.0, Vector::Zero(), skew_inertia())}.squared_frequency() == 0.0);
}

TEST_CASE("a rope-coupled body refuses what no rig has") {
  const Matrix good = skew_inertia();
  CHECK_THROWS_AS(RopeCoupled(solid(0.0, Vector::Zero(), good)), Error);
  CHECK_THROWS_AS(RopeCoupled(solid(1.0, Vector::Constant(std::nan("")), good)), Error);
  CHECK_THROWS_AS(RopeCoupled(solid(1.0, Vector::Zero(), Vector{1, 1, 2.1}.asDiagonal())), Error);
  CHECK_THROWS_AS(RopeCoupled(solid(1.0, Vector::Zero(), Vector{0, 1, 1}.asDiagonal())), Error);
  Matrix lopsided = good;
  lopsided(0, 1) += 0.01;
  CHECK_THROWS_AS(RopeCoupled(solid(1.0, Vector::Zero(), lopsided)), Error);
  CHECK_NOTHROW(RopeCoupled(solid(1.0, Vector::Zero(), Vector{1, 1, 2}.asDiagonal()))); // a flat plate

  const auto hung = [&](Rope rope) {
    Rig rig{RopeCoupled{solid(1.0, Vector::Zero(), good), {rope}}};
    rig.step();
  };
  CHECK_NOTHROW(hung({.winch = {0, 0, 1}, .stiffness = 1.0}));
  CHECK_THROWS_WITH_AS(hung({.name = "drag", .winch = {0, 0, 1}}),
                       doctest::Contains("rope 'drag': stiffness"), Error);
  CHECK_THROWS_WITH_AS(hung({.winch = {0, 0, 1}, .stiffness = 1.0, .damping = -1.0}),
                       doctest::Contains("damping"), Error);
  CHECK_THROWS_WITH_AS(hung({.name = "drag", .stiffness = 1.0}), doctest::Contains("reached the winch"),
                       Error);
}
