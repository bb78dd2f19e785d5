// Bodies moved in packs against the same bodies moved one after the other.

#include "scree/core/random.hpp"
#include "scree/integrators/rotor_splitting.hpp"
#include "scree/packing/templates.hpp"
#include "scree/simulation/motion_loop.hpp"
#include "support/scenes.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <vector>

namespace {

using namespace scree;

/// An integrator that knows no packs, as a user's may be.
template <class Base>
struct WithoutPacks {
  static void translate(Vec3<double>& x, Vec3<double>& v, const Vec3<double>& a, const TimeStep& step) {
    Base::translate(x, v, a, step);
  }
  static void rotate(Quat<double>& q, Vec3<double>& w, const Vec3<double>& moment,
                     const Vec3<double>& inertia, const TimeStep& step) {
    Base::rotate(q, w, moment, inertia, step);
  }
};

/// Lone spheres, clumps of two to four members and fixed ones in turn, all with forces on them.
template <class Real>
Bodies<Real> some_bodies(std::size_t count) {
  const std::vector<Clump> shapes{
      make_clump("twin", std::vector<Sphere>{{{-0.4, 0, 0}, 0.5}, {{0.4, 0, 0}, 0.45}}), test::ball(0.5),
      make_clump("row", aligned_spheres()),
      make_clump("four", std::vector<Sphere>{{{0.5, 0, 0}, 0.4},
                                             {{-0.3, 0.4, 0}, 0.5},
                                             {{-0.3, -0.4, 0}, 0.45},
                                             {{0, 0, 0.5}, 0.4}})};
  Random random{77};
  const auto normal = [&] { return Vector{random.normal(), random.normal(), random.normal()}; };
  Bodies<Real> bodies;
  for (std::size_t k = 0; k < count; ++k) {
    bodies.add({.clump = &shapes[k % shapes.size()],
                .scale = 0.01 * random.uniform(0.5, 1.5),
                .density = 2500.0,
                .material = static_cast<std::uint16_t>(k % 3),
                .position = normal(),
                .orientation = random.orientation(),
                .velocity = normal(),
                .angular_velocity = 30.0 * normal(),
                .fixed = k % 7 == 6});
  }
  for (ForceRecord<Real>& on : bodies.forces()) {
    on.force = to_vec3<Real>(Vector(0.1 * normal()));
    on.torque = to_vec3<Real>(Vector(1e-3 * normal()));
  }
  return bodies;
}

template <class Real>
Block all_of(const Bodies<Real>& bodies) {
  Block block;
  block.end_body = bodies.size();
  block.end_sphere = bodies.sphere_count();
  return block;
}

const TimeStep now{0.0, 1e-3, 1e-3, Vector{0.3, 0.0, -9.81}};

/// Largest difference of all numbers that a step changes, over the largest of their kind.
template <class Real>
double difference(const Bodies<Real>& a, const Bodies<Real>& b) {
  double worst = 0.0;
  const auto compare = [&](auto value) {
    double apart = 0.0, size = 0.0;
    for (std::size_t k = 0; k < a.size(); ++k) {
      apart = std::max(apart, (value(a, k) - value(b, k)).norm());
      size = std::max(size, value(b, k).norm());
    }
    worst = std::max(worst, apart / size);
  };
  using B = const Bodies<Real>&;
  compare([](B of, std::size_t k) { return of.position(k); });
  compare([](B of, std::size_t k) { return of.velocity(k); });
  compare([](B of, std::size_t k) { return of.angular_velocity(k); });
  compare([](B of, std::size_t k) { return of.orientation(k).coeffs(); });
  const auto last = [](B of, std::size_t k) -> const auto& {
    return of.spheres()[of.first_sphere(k + 1) - 1];
  };
  compare([&](B of, std::size_t k) { return to_eigen(last(of, k).position); });
  compare([&](B of, std::size_t k) { return to_eigen(last(of, k).velocity); });
  compare([&](B of, std::size_t k) { return to_eigen(last(of, k).angular_velocity); });
  return worst;
}

} // namespace

TEST_CASE_TEMPLATE("bodies in packs move as they do one by one, whatever their kinds and number", Integrator,
                   Leapfrog, RotorSplitting) {
  using Plain = WithoutPacks<Integrator>;
  static_assert(std::is_same_v<MotionNumber<Integrator>, Pack<double>>);
  static_assert(std::is_same_v<MotionNumber<Plain>, double>);
  const auto check = [](auto real, double tolerance) {
    using Real = decltype(real);
    for (const std::size_t count : {std::size_t{1}, std::size_t{2}, std::size_t{11}, std::size_t{85}}) {
      for (const double damping : {0.0, 0.3}) {
        CAPTURE(count);
        CAPTURE(damping);
        Bodies<Real> packed = some_bodies<Real>(count), plain = some_bodies<Real>(count);
        const Bodies<Real> before = plain;
        for (int step = 0; step < 3; ++step) {
          Dissipation by_packs, by_one;
          const double a = move_bodies<Integrator, true>(all_of(packed), now, damping, packed, by_packs);
          const double b = move_bodies<Plain, true>(all_of(plain), now, damping, plain, by_one);
          CHECK(std::abs(a - b) <= tolerance * b);
          CHECK(std::abs(by_packs.local_damping - by_one.local_damping) <= tolerance * by_one.local_damping);
          CHECK((by_one.local_damping > 0.0) == (damping > 0.0));
        }
        CHECK(difference(packed, plain) < tolerance);
        CHECK(difference(before, plain) > 1e-6);
        for (std::size_t s = 0; s < plain.sphere_count(); ++s) {
          CHECK(packed.spheres()[s].material == before.spheres()[s].material);
          CHECK(packed.spheres()[s].radius == before.spheres()[s].radius);
          CHECK(packed.spheres()[s].inverse_mass == before.spheres()[s].inverse_mass);
        }
      }
    }
  };
  check(double{}, 1e-13);
  check(float{}, 1e-6);
}

TEST_CASE("the largest speed is that of any sphere, and a body that is lost shows") {
  for (const std::size_t count : {std::size_t{3}, std::size_t{30}}) {
    Bodies<double> bodies = some_bodies<double>(count);
    Dissipation lost;
    const double fastest = move_bodies<Leapfrog, false>(all_of(bodies), now, 0.0, bodies, lost);
    double expected = 0.0;
    for (const auto& sphere : bodies.spheres()) {
      expected = std::max(expected, norm(sphere.velocity));
    }
    CHECK(std::abs(fastest - expected) < 1e-14 * expected);
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      if (!bodies.is_fixed(b)) {
        CAPTURE(b);
        Bodies<double> spoilt = bodies;
        spoilt.forces()[spoilt.first_sphere(b)].force.y = std::numeric_limits<double>::quiet_NaN();
        CHECK(std::isnan(move_bodies<Leapfrog, false>(all_of(spoilt), now, 0.0, spoilt, lost)));
      }
    }
  }
}

TEST_CASE("velocities in float move positions in double") {
  // A step that float could not resolve at this distance from the origin is not lost.
  const Clump ball = test::ball(0.5), rod = make_clump("rod", aligned_spheres());
  Bodies<float> bodies;
  for (const Clump* shape : {&ball, &rod}) {
    bodies.add(
        {.clump = shape, .density = 2500.0, .position = {1e3, 0.0, 0.0}, .velocity = {1e-3, 0.0, 0.0}});
  }
  Dissipation lost;
  for (int k = 0; k < 1000; ++k) {
    move_bodies<Leapfrog, false>(all_of(bodies), TimeStep{0.0, 1e-3, 1e-3, Vector::Zero()}, 0.0, bodies,
                                 lost);
  }
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    CHECK(std::abs(bodies.position(b).x() - 1e3 - 1e-3) < 1e-9);
  }
}
