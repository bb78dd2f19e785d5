/// \file
/// How a law is extended, by the smallest extension there is: a constant adhesion.

#include "support/relative_error.hpp"

#include "scree/contact/hertz_mindlin.hpp"
#include "scree/simulation/simulation.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <span>
#include <vector>

using namespace scree;

namespace own_extension_tests {
using test::relative_error;

namespace {

/// Touching bodies pull on each other with a constant force.
struct WaterFilm {
  static constexpr int history_size = 0;
  static constexpr std::array<int, 0> history_parity{};

  double pull = 0.0; ///< N

  template <class T>
  T normal(const PairMaterial<T>&, const Kinematics<T>&, T normal_force, std::span<T, 0>, T&) const {
    return normal_force - static_cast<T>(pull);
  }
};

struct Sticky : DefaultModel {
  using Contact = LinearSpring<WaterFilm>;
};

constexpr double radius = 0.01, gravity = 9.81, stiffness = 1e5;

Material material() {
  return {.normal_stiffness = 2 * stiffness, .shear_stiffness = 2 * stiffness, .restitution = 0.2};
}

/// m, below a ceiling after half a second, of a sphere that was pressed against it by `overlap`.
double depth_below_ceiling(double pull) {
  const Clump ball = make_clump("ball", std::vector<Sphere>{{Vector::Zero(), radius}});
  Simulation<Sticky> sim{{.contact = LinearSpring<WaterFilm>{WaterFilm{pull}}, .time_step = 1e-5}};
  const auto rock = sim.add_material(material());
  sim.add_wall(
      {.name = "ceiling", .surfaces = {{Plane{.normal = -Vector::UnitZ()}, rock}}, .dynamics = Fixed{}});
  sim.add({.clump = &ball, .material = rock, .position = {0, 0, -radius + pull / stiffness}});
  for (int k = 0; k < 25000; ++k) {
    sim.step();
  }
  return -sim.bodies().position(0).z() - radius;
}

} // namespace

static_assert(LawExtension<WaterFilm> && ContactLaw<LinearSpring<WaterFilm>> &&
              ContactLaw<HertzMindlin<WaterFilm>, float>);

TEST_CASE("physics: a sphere hangs from a ceiling whose adhesion exceeds its weight") {
  const double weight = 2650.0 * 4.0 / 3.0 * std::acos(-1.0) * radius * radius * radius * gravity;
  // Where the spring pushes as much as the adhesion exceeds the weight.
  const double depth = depth_below_ceiling(2.0 * weight);
  CHECK(relative_error(-depth, weight / stiffness) < 1e-6);
  CHECK(depth_below_ceiling(0.9 * weight) > 0.1); // falls
}

TEST_CASE("an extension changes the normal force before the friction limit is taken from it") {
  const double pull = 0.5;
  const LinearSpring<WaterFilm> law{WaterFilm{pull}};
  CHECK(law.extension<WaterFilm>().pull == pull);
  const auto pair = mix(material(), material(), Stiffness::of_particle);
  Kinematics<double> k{};
  k.normal = {0, 0, 1};
  k.overlap = 2e-5;
  k.velocity = {1.0, 0, 0};
  k.reduced_radius = radius;
  k.reduced_mass = 0.01;
  k.root_mass = 0.1;
  k.dt = 1e-4;
  std::array<double, 3> history{};
  const auto f = law.evaluate(pair, k, history);
  CHECK(relative_error(f.normal, stiffness * 2e-5 - pull) < 1e-14);
  CHECK(relative_error(norm(f.tangential), 0.5 * (stiffness * 2e-5 - pull)) < 1e-14);
  // A contact that pulls has no friction in this law.
  k.overlap = 1e-6;
  const auto pulled = law.evaluate(pair, k, history);
  CHECK(pulled.normal < 0.0);
  CHECK(norm(pulled.tangential) == 0.0);
}

TEST_CASE("an extension of null strength leaves the force as it is, to the bit") {
  const auto pair = mix(material(), material(), Stiffness::of_particle);
  std::array<double, 3> a{}, b{};
  for (int step = 0; step < 100; ++step) {
    Kinematics<double> k{};
    k.normal = {0, 0, 1};
    k.overlap = 1e-5 * (1.0 + std::sin(0.1 * step));
    k.velocity = {0.3 * std::cos(0.2 * step), 0.1, 0.01};
    k.reduced_radius = radius;
    k.reduced_mass = 0.01;
    k.root_mass = 0.1;
    k.dt = 1e-5;
    const auto f = LinearSpring<>{}.evaluate(pair, k, a);
    const auto g = LinearSpring<WaterFilm>{}.evaluate(pair, k, b);
    REQUIRE(f.normal == g.normal);
    REQUIRE(f.tangential == g.tangential);
    REQUIRE(a == b);
  }
}

} // namespace own_extension_tests
