/// \file
/// A free asymmetric body against its exact motion, in Jacobi's elliptic functions (Landau & Lifshitz,
/// Mechanics, §37).

#include "support/relative_error.hpp"
#include "support/rotate.hpp"
#include "validation/free_rotor.hpp"

#include "scree/integrators/leapfrog.hpp"
#include "scree/integrators/rotor_splitting.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <type_traits>

using namespace scree;
using test::relative_error;
using validation::FreeRotor;

namespace {

/// A body on its way under an integrator, stepped as the simulation steps it.
template <class Integrator>
struct Rotor {
  Quaternion orientation;
  Vector angular_velocity;
  Vector inertia;
  bool fresh = true;

  explicit Rotor(const FreeRotor& exact)
      : orientation{exact.orientation(0.0)},
        angular_velocity{exact.angular_velocity(0.0)},
        inertia{exact.inertia()} {}

  void advance(int steps, double dt) {
    for (int k = 0; k < steps; ++k) {
      test::rotate<Integrator>(orientation, angular_velocity, Vector::Zero(), inertia,
                               {.dt = dt, .kick = fresh ? 0.5 * dt : dt});
      fresh = false;
    }
  }
  /// Taken to the time of the orientation. A leapfrog has it half a step behind; the splitting turns the
  /// momentum with the body and only the kicks of moments stand half a step behind.
  [[nodiscard]] Vector angular_velocity_here(double dt) const {
    return std::is_same_v<Integrator, Leapfrog> ? kicked(angular_velocity, Vector::Zero(), inertia, 0.5 * dt)
                                                : angular_velocity;
  }
  [[nodiscard]] double energy() const {
    return 0.5 * angular_velocity.dot(inertia.cwiseProduct(angular_velocity));
  }
  [[nodiscard]] Vector momentum(double dt) const {
    return orientation * inertia.cwiseProduct(angular_velocity_here(dt));
  }
};

struct Errors {
  double orientation;      // rad
  double angular_velocity; // relative
};

template <class Integrator>
Errors errors(const FreeRotor& exact, int steps, double duration) {
  const double dt = duration / steps;
  Rotor<Integrator> rotor{exact};
  rotor.advance(steps, dt);
  const Vector w = exact.angular_velocity(duration);
  return {2.0 * (exact.orientation(duration).conjugate() * rotor.orientation).vec().norm(),
          (rotor.angular_velocity_here(dt) - w).norm() / w.norm()};
}

const FreeRotor asymmetric{{1.0, 2.0, 2.5}, 0.9, 1.0};
/// A rod whose two large moments are almost alike, as a row of spheres with a bump has them.
const FreeRotor rod{{1.0, 20.0, 20.5}, 0.4, 1.0};

} // namespace

TEST_CASE("the exact solution fulfils Euler's equations and keeps the angular momentum in space") {
  for (const FreeRotor* exact : {&asymmetric, &rod}) {
    const double h = 1e-3;
    for (const double t : {0.0, 0.7, 3.9, 12.0}) {
      CAPTURE(t);
      const auto w = [&](double at) { return exact->angular_velocity(at); };
      // Differences of fourth order, good to h^4 and to rounding over h.
      const Vector rate = (8.0 * (w(t + h) - w(t - h)) - (w(t + 2 * h) - w(t - 2 * h))) / (12.0 * h);
      const Vector euler = to_eigen(gyroscopic_moment(to_vec3(exact->inertia()), to_vec3(w(t))))
                               .cwiseQuotient(exact->inertia());
      CHECK((rate - euler).norm() < 1e-10);
      const Quaternion q = exact->orientation(t);
      CHECK((q * exact->inertia().cwiseProduct(w(t)) - exact->momentum()).norm() <
            1e-13 * exact->momentum().norm());
      const Quaternion turn = exact->orientation(t - h).conjugate() * exact->orientation(t + h);
      CHECK((turn.vec() * (turn.w() < 0.0 ? -1.0 : 1.0) / h - w(t)).norm() < 1e-5); // second order
    }
  }
}

TEST_CASE_TEMPLATE("physics: rotation is of second order for a free asymmetric body", Integrator, Leapfrog,
                   RotorSplitting) {
  for (const FreeRotor* exact : {&asymmetric, &rod}) {
    CAPTURE(exact->inertia().transpose());
    const double duration = 11.0; // about two turns of the asymmetric body
    Errors coarse = errors<Integrator>(*exact, 2000, duration);
    for (const int steps : {4000, 8000, 16000}) {
      const Errors fine = errors<Integrator>(*exact, steps, duration);
      const double turn = std::log2(coarse.orientation / fine.orientation);
      const double rate = std::log2(coarse.angular_velocity / fine.angular_velocity);
      MESSAGE("moments " << exact->inertia().transpose() << ", " << steps << " steps: orientation off by "
                         << fine.orientation << " rad, order " << turn << "; angular velocity by "
                         << fine.angular_velocity << ", order " << rate);
      CHECK(relative_error(turn, 2.0) < 0.02);
      CHECK(relative_error(rate, 2.0) < 0.02);
      coarse = fine;
    }
  }
}

TEST_CASE("physics: a free leapfrog body keeps its energy over 1e5 steps, its angular momentum to O(dt^2)") {
  for (const FreeRotor* exact : {&asymmetric, &rod}) {
    CAPTURE(exact->inertia().transpose());
    double wandering_before = 0.0;
    for (const double dt : {0.008, 0.004}) {
      Rotor<Leapfrog> rotor{*exact};
      const double energy = rotor.energy(), momentum = exact->momentum().norm();
      double energy_off = 0.0, magnitude_off = 0.0, wandering = 0.0;
      for (int k = 0; k < 100000; ++k) {
        rotor.advance(1, dt);
        const Vector l = rotor.momentum(dt);
        energy_off = std::max(energy_off, std::abs(rotor.energy() / energy - 1.0));
        magnitude_off = std::max(magnitude_off, std::abs(l.norm() / momentum - 1.0));
        wandering = std::max(wandering, (l - exact->momentum()).norm() / momentum);
      }
      MESSAGE("moments " << exact->inertia().transpose() << ", |w| dt "
                         << exact->angular_velocity(0.0).norm() * dt << ": energy off by " << energy_off
                         << ", magnitude of L by " << magnitude_off << ", direction of L by " << wandering);
      CHECK(energy_off < 1e-11); // 1e5 roundings of 1e-16, all of one sign at worst
      CHECK(magnitude_off < 1e-11);
      if (wandering_before > 0.0) {
        CHECK(wandering < 0.3 * wandering_before); // second order: a quarter
      }
      wandering_before = wandering;
    }
  }
}

TEST_CASE(
    "physics: a free body under rotor splitting keeps its angular momentum in space to rounding, its energy "
    "within bounds") {
  for (const FreeRotor* exact : {&asymmetric, &rod}) {
    for (const double dt : {0.02, 0.2}) {
      Rotor<RotorSplitting> rotor{*exact};
      const double energy = rotor.energy(), momentum = exact->momentum().norm();
      double early = 0.0, late = 0.0, momentum_off = 0.0;
      for (int k = 0; k < 100000; ++k) {
        rotor.advance(1, dt);
        (k < 10000 ? early : late) =
            std::max(k < 10000 ? early : late, std::abs(rotor.energy() / energy - 1.0));
        momentum_off = std::max(momentum_off, (rotor.momentum(dt) - exact->momentum()).norm() / momentum);
      }
      MESSAGE("moments " << exact->inertia().transpose() << ", |w| dt "
                         << exact->angular_velocity(0.0).norm() * dt << ": energy off by " << early
                         << " in 1e4 steps, " << late << " in the next 9e4; L by " << momentum_off);
      CHECK(momentum_off < 1e-11); // 1e5 roundings of 1e-16, all of one sign at worst
      CHECK(late < 1.05 * early);  // symplectic: it swings and does not grow
    }
  }
}

TEST_CASE_TEMPLATE("rotation runs back the way it came", Integrator, Leapfrog, RotorSplitting) {
  const double dt = 0.01;
  Rotor<Integrator> rotor{rod};
  rotor.advance(5000, dt);
  rotor.angular_velocity = -rotor.angular_velocity_here(dt);
  rotor.fresh = true;
  rotor.advance(5000, dt);
  const double orientation_off = 2.0 * (rod.orientation(0.0).conjugate() * rotor.orientation).vec().norm();
  const double spin_off = (rotor.angular_velocity_here(dt) + rod.angular_velocity(0.0)).norm();
  MESSAGE("off by " << orientation_off << " rad and " << spin_off << " rad/s");
  CHECK(orientation_off < 1e-10); // roundings, which the wobble of the rod enlarges
  CHECK(spin_off < 1e-10);
}

TEST_CASE_TEMPLATE("a moment about a principal axis of a resting body turns it as a lone rotor", Integrator,
                   Leapfrog, RotorSplitting) {
  // Angle M t^2 / (2 I): the leapfrog with its half kick has no error for a constant moment.
  const double dt = 1e-3;
  for (int axis = 0; axis < 3; ++axis) {
    CAPTURE(axis);
    const Vector inertia{1.0, 2.0, 2.5};
    Quaternion q = Quaternion::Identity();
    Vector w = Vector::Zero();
    for (int k = 0; k < 1000; ++k) {
      test::rotate<Integrator>(q, w, 1.5 * Vector::Unit(axis), inertia,
                               {.dt = dt, .kick = k == 0 ? 0.5 * dt : dt});
    }
    const Quaternion expected{Eigen::AngleAxisd{0.5 * 1.5 / inertia[axis], Vector::Unit(axis)}};
    CHECK(2.0 * (expected.conjugate() * q).vec().norm() < 1e-12);
  }
}

TEST_CASE_TEMPLATE("a heavy symmetric top precesses at its steady rate", Integrator, Leapfrog,
                   RotorSplitting) {
  // Steady precession at rate p, tilt a, spin s about the axis of the top: m g l = p (I3 s - (I1 - I3) p cos
  // a).
  const double i1 = 2.0, i3 = 1.0, tilt = 0.6, precession = 0.8, spin = 25.0;
  const double weight_moment = precession * (i3 * spin - (i1 - i3) * precession * std::cos(tilt));
  const Vector inertia{i1, i1, i3};
  const auto run = [&](int steps) {
    const double duration = 2.0, dt = duration / steps;
    Quaternion q{Eigen::AngleAxisd{tilt, Vector::UnitX()}};
    Vector w = q.conjugate() * Vector(precession * Vector::UnitZ()) + spin * Vector::UnitZ();
    for (int k = 0; k < steps; ++k) {
      const Vector axis = q * Vector::UnitZ();
      const Vector moment = axis.cross(Vector(-weight_moment * Vector::UnitZ()));
      test::rotate<Integrator>(q, w, q.conjugate() * moment, inertia,
                               {.dt = dt, .kick = k == 0 ? 0.5 * dt : dt});
    }
    const Vector expected = Eigen::AngleAxisd{precession * duration, Vector::UnitZ()} *
                            (Eigen::AngleAxisd{tilt, Vector::UnitX()} * Vector::UnitZ());
    return (q * Vector::UnitZ() - expected).norm();
  };
  const double coarse = run(2000), fine = run(4000);
  MESSAGE("axis off by " << fine << " with 4000 steps, order " << std::log2(coarse / fine));
  CHECK(fine < 1e-3);
  CHECK(relative_error(std::log2(coarse / fine), 2.0) < 0.02);
}
