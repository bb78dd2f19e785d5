#include "scree/core/random.hpp"
#include "scree/packing/templates.hpp"
#include "scree/state/blocks.hpp"
#include "scree/state/bodies.hpp"
#include "support/relative_error.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

using namespace scree;

namespace {

const Clump ball = make_clump("ball", std::vector<Sphere>{{Vector::Zero(), 0.5}});
const Clump off_ball = make_clump("off", std::vector<Sphere>{{Vector{3, 4, 5}, 0.5}}); // moved to its centre
const Clump rod = make_clump("rod", aligned_spheres());

NewBody some_body(const Clump& clump, Random& random) {
  return {.clump = &clump,
          .scale = random.uniform(0.1, 2.0),
          .density = 2500.0,
          .position = {random.normal(), random.normal(), random.normal()},
          .orientation = random.orientation(),
          .velocity = {random.normal(), random.normal(), random.normal()},
          .angular_velocity = {random.normal(), random.normal(), random.normal()}};
}

/// Where the member spheres are and how they move, from the rigid body's own motion.
void check_members(const Bodies<double>& bodies, std::size_t b, const Clump& clump, double scale) {
  REQUIRE(bodies.first_sphere(b + 1) - bodies.first_sphere(b) == clump.spheres.size());
  for (std::size_t k = 0; k < clump.spheres.size(); ++k) {
    const auto& sphere = bodies.spheres()[bodies.first_sphere(b) + k];
    const Vector arm = bodies.orientation(b) * (scale * clump.spheres[k].centre);
    CHECK((to_eigen(sphere.position) - bodies.position(b) - arm).norm() < 1e-14);
    CHECK((to_eigen(sphere.velocity) - bodies.velocity(b) - bodies.angular_velocity(b).cross(arm)).norm() <
          1e-13);
    CHECK((to_eigen(sphere.angular_velocity) - bodies.angular_velocity(b)).norm() < 1e-13);
    CHECK(sphere.radius == test::about(scale * clump.spheres[k].radius));
    CHECK(bodies.body_of(bodies.first_sphere(b) + k) == b);
  }
}

} // namespace

TEST_CASE("a body is what was asked for") {
  Random random{151};
  Bodies<double> bodies;
  for (const Clump* clump : {&ball, &rod, &off_ball}) {
    const NewBody given = some_body(*clump, random);
    const std::uint64_t id = bodies.add(given);
    const std::size_t b = bodies.size() - 1;
    CHECK(bodies.id(b) == id);
    CHECK(id == b);
    CHECK(bodies.kind(b) == (clump == &rod ? BodyKind::clump : BodyKind::lone));
    CHECK(bodies.position(b) == given.position);
    CHECK(bodies.velocity(b) == given.velocity);
    CHECK((bodies.angular_velocity(b) - given.angular_velocity).norm() < 1e-14);
    CHECK(bodies.mass(b) == test::about(2500.0 * clump->volume * std::pow(given.scale, 3)));
    CHECK((bodies.inertia(b) - 2500.0 * std::pow(given.scale, 5) * clump->inertia).norm() <
          1e-12 * bodies.inertia(b).norm());
    check_members(bodies, b, *clump, given.scale);
  }
  const double r = 0.5 * bodies.bounding_radius(0) / 0.5;
  CHECK(bodies.solid_volume(0) == test::about(4.0 / 3.0 * std::numbers::pi * r * r * r));
}

TEST_CASE("kinetic energy is that of the rigid motion") {
  Random random{152};
  Bodies<double> bodies;
  bodies.add(some_body(ball, random));
  bodies.add(some_body(rod, random));
  for (std::size_t b = 0; b < 2; ++b) {
    const Matrix turn = bodies.orientation(b).toRotationMatrix();
    const Matrix inertia = turn * bodies.inertia(b).asDiagonal() * turn.transpose();
    const Vector v = bodies.velocity(b), w = bodies.angular_velocity(b);
    CHECK(bodies.kinetic_energy(b) ==
          test::about(0.5 * bodies.mass(b) * v.squaredNorm() + 0.5 * w.dot(inertia * w), 1e-12));
  }
}

TEST_CASE("a motion that is set, a shift and a halt reach the members") {
  Random random{153};
  Bodies<double> bodies;
  for (const Clump* clump : {&ball, &rod}) {
    NewBody given = some_body(*clump, random);
    given.scale = 1.5;
    const std::size_t b = bodies.size();
    bodies.add(given);
    bodies.set_motion(b, {1, 2, 3}, {-4, 5, 6});
    CHECK(bodies.velocity(b) == Vector{1, 2, 3});
    CHECK((bodies.angular_velocity(b) - Vector{-4, 5, 6}).norm() < 1e-14);
    check_members(bodies, b, *clump, 1.5);

    bodies.shift(b, {10, 0, -1});
    CHECK((bodies.position(b) - given.position - Vector{10, 0, -1}).norm() < 1e-14);
    check_members(bodies, b, *clump, 1.5);

    const Vector at = bodies.position(b);
    CHECK_FALSE(bodies.is_fixed(b));
    bodies.fix(b);
    CHECK(bodies.is_fixed(b));
    CHECK(bodies.position(b) == at);
    CHECK(bodies.velocity(b).isZero(0.0));
    CHECK(bodies.angular_velocity(b).isZero(0.0));
    CHECK(bodies.kinetic_energy(b) == 0.0);
    CHECK(bodies.spheres()[bodies.first_sphere(b)].inverse_mass == 0.0);
    check_members(bodies, b, *clump, 1.5);
  }
}

TEST_CASE("bodies in another order stay what they are, and keep their ids") {
  Random random{154};
  Bodies<double> bodies;
  for (int k = 0; k < 20; ++k) {
    bodies.add(some_body(k % 3 == 0 ? rod : ball, random));
  }
  const Bodies<double> before = bodies;
  const std::vector<std::uint32_t> order{19, 3, 4, 0, 7, 12};
  const auto moved_to = bodies.rearrange(order);
  REQUIRE(bodies.size() == order.size());
  REQUIRE(moved_to.size() == before.sphere_count());
  for (std::size_t b = 0; b < order.size(); ++b) {
    const std::size_t old = order[b];
    CHECK(bodies.id(b) == before.id(old));
    CHECK(bodies.position(b) == before.position(old));
    CHECK(bodies.angular_velocity(b) == before.angular_velocity(old));
    CHECK(bodies.mass(b) == before.mass(old));
    CHECK(bodies.kind(b) == before.kind(old));
    for (std::size_t s = before.first_sphere(old); s < before.first_sphere(old + 1); ++s) {
      CHECK(moved_to[s] == bodies.first_sphere(b) + s - before.first_sphere(old));
      CHECK(bodies.spheres()[moved_to[s]].position == before.spheres()[s].position);
      CHECK(bodies.body_of(moved_to[s]) == b);
    }
  }
  CHECK(std::count(moved_to.begin(), moved_to.end(), Bodies<double>::gone) ==
        static_cast<std::ptrdiff_t>(before.sphere_count() - bodies.sphere_count()));
  CHECK(bodies.add(some_body(ball, random)) == 20); // an id is never given twice
}

TEST_CASE("a body refuses what is not a number or has no mass") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Bodies<double> bodies;
  const NewBody good{.clump = &ball, .density = 1.0};
  CHECK_NOTHROW(bodies.add(good));
  const auto refused = [&](auto change) {
    NewBody body = good;
    change(body);
    CHECK_THROWS_AS(bodies.add(body), Error);
  };
  refused([&](NewBody& b) { b.position.y() = nan; });
  refused([&](NewBody& b) { b.velocity.x() = std::numeric_limits<double>::infinity(); });
  refused([&](NewBody& b) { b.angular_velocity.z() = nan; });
  refused([&](NewBody& b) { b.orientation.w() = nan; });
  refused([&](NewBody& b) { b.scale = 0.0; });
  refused([&](NewBody& b) { b.scale = nan; });
  refused([&](NewBody& b) { b.density = -1.0; });
  CHECK(bodies.size() == 1);
  CHECK(bodies.sphere_count() == 1);
}

TEST_CASE("blocks divide the bodies without gaps, and every sphere has one") {
  Random random{155};
  Bodies<double> bodies;
  for (int k = 0; k < 4000; ++k) {
    bodies.add(some_body(k % 2 == 0 ? rod : ball, random));
  }
  const auto blocks = divided(bodies);
  REQUIRE(blocks.size() > 3);
  CHECK(blocks.front().first_body == 0);
  CHECK(blocks.back().end_body == bodies.size());
  for (std::size_t n = 0; n < blocks.size(); ++n) {
    const Block& block = blocks[n];
    CHECK(block.first_sphere == bodies.first_sphere(block.first_body));
    CHECK(block.end_sphere == bodies.first_sphere(block.end_body));
    if (n > 0) {
      CHECK(block.first_body == blocks[n - 1].end_body);
    }
    CHECK(block_of(blocks, block.first_sphere) == n);
    CHECK(block_of(blocks, block.end_sphere - 1) == n);
  }
}
