/// \file
/// The quaternion update and Euler's equations by themselves.

#include "scree/core/random.hpp"
#include "scree/state/rotation.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

using namespace scree;

namespace {

/// rad, between two orientations.
double angle_between(const Quaternion& a, const Quaternion& b) {
  return 2.0 * (a.conjugate() * b).vec().norm();
}

Vector random_vector(Random& random) {
  return {random.normal(), random.normal(), random.normal()};
}

} // namespace

TEST_CASE("the quaternion update turns about the axis in the body by the angle |w| dt") {
  Random random{1};
  for (const double angle : {1e-12, 1e-7, 1e-4, 1e-2, 0.0399, 0.0401, 1.0, 3.0, 6.0}) {
    CAPTURE(angle);
    const double dt = 1e-3;
    for (int k = 0; k < 20; ++k) {
      const Quaternion q = random.orientation();
      const Vector axis = random_vector(random).normalized();
      const Quaternion expected = q * Quaternion{Eigen::AngleAxisd{angle, axis}};
      CHECK(angle_between(turned(q, axis * (angle / dt), dt), expected) < 1e-15 * 4.0);
    }
  }
}

TEST_CASE("the quaternion update is Eqs. (11)-(15) of the paper") {
  // q' = (cos(|w| dt / 2) + Omega sin(|w| dt / 2) / |w|) q, with Omega q = q (0, w), written out.
  Random random{2};
  for (int k = 0; k < 50; ++k) {
    const Quaternion q = random.orientation();
    const Vector w = 30.0 * random_vector(random);
    const double dt = 0.01, half = 0.5 * w.norm() * dt;
    const Eigen::Vector4d r{q.w(), q.x(), q.y(), q.z()};
    const double r0 = r[0], r1 = r[1], r2 = r[2], r3 = r[3];
    const Eigen::Vector4d omega_q{-r1 * w.x() - r2 * w.y() - r3 * w.z(), r0 * w.x() + r2 * w.z() - r3 * w.y(),
                                  r0 * w.y() + r3 * w.x() - r1 * w.z(), r0 * w.z() + r1 * w.y() - r2 * w.x()};
    const Eigen::Vector4d next = std::cos(half) * r + std::sin(half) / w.norm() * omega_q;
    const Quaternion q2 = turned(q, w, dt);
    CHECK((next - Eigen::Vector4d{q2.w(), q2.x(), q2.y(), q2.z()}).norm() < 1e-15);
  }
}

TEST_CASE("a constant angular velocity is followed for 1e5 steps without drift") {
  const Vector axis = Vector{1.0, -2.0, 0.5}.normalized();
  const double rate = 40.0, dt = 1e-4;
  const int steps = 100000;
  Quaternion q = Quaternion::Identity();
  for (int k = 0; k < steps; ++k) {
    q = turned(q, rate * axis, dt);
  }
  const double angle = std::remainder(rate * dt * steps, 2.0 * std::numbers::pi);
  const double drift = angle_between(q, Quaternion{Eigen::AngleAxisd{angle, axis}});
  MESSAGE("drift in 1e5 steps: " << drift << " rad");
  CHECK(drift < 1e-11); // 1e5 roundings of 1e-16, all of one sign at worst
  CHECK(std::abs(q.norm() - 1.0) < 1e-15);
}

TEST_CASE("Euler's equations are those of the angular momentum in space") {
  // d(I w)/dt = M - w x I w in the body's frame.
  Random random{3};
  for (int k = 0; k < 50; ++k) {
    const Vector inertia{random.uniform(1.0, 2.0), random.uniform(1.0, 2.0), random.uniform(1.0, 2.0)};
    const Vector w = random_vector(random), moment = random_vector(random);
    const Vector gyroscopic = to_eigen(gyroscopic_moment(to_vec3(inertia), to_vec3(w)));
    CHECK((gyroscopic + w.cross(inertia.cwiseProduct(w))).norm() < 1e-14);
    // The kick takes the gyroscopic moment at the mean: an implicit equation, solved to rounding.
    const double dt = 0.05;
    const Vector next = kicked(w, moment, inertia, dt), mean = 0.5 * (w + next);
    const Vector expected = w + dt * (moment - mean.cross(inertia.cwiseProduct(mean))).cwiseQuotient(inertia);
    CHECK((next - expected).norm() < 1e-14 * w.norm());
  }
}

TEST_CASE("physics: the kick of a free body keeps its energy and the magnitude of its angular momentum") {
  const Vector inertia{1.0, 2.0, 2.7};
  Vector w{0.8, 1.1, -0.3};
  const double dt = 0.02; // |w| dt of 0.03, far more than a time step has
  const auto energy = [&] { return w.dot(inertia.cwiseProduct(w)); };
  const auto momentum = [&] { return inertia.cwiseProduct(w).norm(); };
  const double e0 = energy(), l0 = momentum();
  for (int k = 0; k < 100000; ++k) {
    w = kicked(w, Vector::Zero(), inertia, dt);
  }
  MESSAGE("relative change in 1e5 kicks: energy " << energy() / e0 - 1.0 << ", angular momentum "
                                                  << momentum() / l0 - 1.0);
  CHECK(std::abs(energy() / e0 - 1.0) < 1e-11);
  CHECK(std::abs(momentum() / l0 - 1.0) < 1e-11);
}

TEST_CASE("a moment about a principal axis gives an even acceleration") {
  const Vector inertia{1.0, 2.0, 4.0};
  Vector w = Vector::Zero();
  for (int k = 0; k < 1000; ++k) {
    w = kicked(w, {0.0, 6.0, 0.0}, inertia, 1e-3);
  }
  CHECK((w - Vector{0.0, 3.0, 0.0}).norm() < 1e-12);
}
