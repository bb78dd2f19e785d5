// The contact law evaluated over packs against the same law over plain numbers, in whole simulations.

#include "scree/contact/hertz_mindlin.hpp"
#include "scree/contact/rolling_resistance.hpp"
#include "scree/core/random.hpp"
#include "scree/simulation/simulation.hpp"
#include "support/models.hpp"
#include "support/relative_error.hpp"
#include "support/scenes.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <type_traits>

using namespace scree;

namespace packs_tests {

namespace {

/// A law that knows no packs, as a user's may be: the loop falls back to plain numbers.
template <class Law>
struct WithoutPacks : Law {
  template <std::floating_point T>
  ContactForce<T> evaluate(const PairMaterial<T>& pair, const Kinematics<T>& k,
                           std::array<T, static_cast<std::size_t>(Law::history_size)>& history) const {
    return Law::evaluate(pair, k, history);
  }
};

/// Some 1,000 spheres of two materials that are pressed into each other and fly about in a periodic space:
/// several blocks, rows of all lengths, packs of unlike materials, contacts that begin, slide and end.
template <class Model>
void fill(Simulation<Model>& simulation) {
  const Material stiff{.normal_stiffness = 2e5,
                       .shear_stiffness = 1e5,
                       .youngs_modulus = 2e8,
                       .friction = 0.5,
                       .restitution = 0.6,
                       .rolling_friction = 0.1};
  Material soft = stiff;
  soft.normal_stiffness = soft.shear_stiffness = 5e4;
  soft.youngs_modulus = 5e7;
  soft.friction = 0.1;
  simulation.add_material(stiff);
  simulation.add_material(soft);
  const Clump unit = test::ball(1.0);
  Random random{23};
  for (int k = 0; k < 1000; ++k) {
    const auto at = [&](int cell) { return 0.01 * (cell + 0.5 + random.uniform(-0.1, 0.1)); };
    const double x = at(k % 10), y = at(k / 10 % 10), z = at(k / 100);
    const Vector v = random.orientation() * Vector::UnitX(), w = random.orientation() * Vector::UnitX();
    simulation.add({.clump = &unit,
                    .material = static_cast<MaterialId>(k % 2),
                    .position = {x, y, z},
                    .velocity = 0.2 * v,
                    .angular_velocity = 30.0 * w,
                    .scale = random.uniform(0.004, 0.0055)});
  }
}

template <class Law, class Real>
void compare(double tolerance) {
  const auto setup = [](auto& s) {
    s.gravity = Vector::Zero();
    s.period = {0.1, 0.1, 0.1};
    s.time_step = 5e-6;
    s.top_speed = 2.0;
  };
  static_assert(EvaluatesForce<Law, Pack<Real>> && EvaluatesForce<Law, Real>);
  static_assert(!EvaluatesForce<WithoutPacks<Law>, Pack<Real>> && EvaluatesForce<WithoutPacks<Law>, Real>);
  using Packed = test::ModelOf<Law, Real>;
  using Plain = test::ModelOf<WithoutPacks<Law>, Real>;
  Setup<Packed> with;
  Setup<Plain> without;
  setup(with);
  setup(without);
  Simulation<Packed> packed{with};
  Simulation<Plain> plain{without};
  fill(packed);
  fill(plain);
  for (int k = 0; k < 40; ++k) {
    packed.step();
    plain.step();
  }
  double moved = 0.0, apart = 0.0, spins = 0.0, spins_apart = 0.0;
  for (std::size_t b = 0; b < plain.bodies().size(); ++b) {
    REQUIRE(packed.bodies().id(b) == plain.bodies().id(b));
    const Vector v = plain.bodies().velocity(b), w = plain.bodies().angular_velocity(b);
    moved = std::max(moved, v.norm());
    apart = std::max(apart, (packed.bodies().velocity(b) - v).norm());
    spins = std::max(spins, w.norm());
    spins_apart = std::max(spins_apart, (packed.bodies().angular_velocity(b) - w).norm());
  }
  MESSAGE("packs of " << Pack<Real>::width << ": velocities differ by " << apart / moved << ", spins by "
                      << spins_apart / spins << " of the largest");
  CHECK(apart < tolerance * moved);
  CHECK(spins_apart < tolerance * spins);
  CHECK(plain.dissipation().friction > 0.0);
  CHECK(packed.dissipation().friction == test::about(plain.dissipation().friction, tolerance));
  CHECK(packed.dissipation().viscous == test::about(plain.dissipation().viscous, tolerance));
}

} // namespace

TEST_CASE("physics: packs and plain numbers give the same motion, Hertz-Mindlin with rolling resistance") {
  compare<HertzMindlin<RollingResistance>, double>(1e-12);
}

TEST_CASE("physics: packs and plain numbers give the same motion, linear spring in float") {
  compare<LinearSpring<>, float>(1e-4);
}

} // namespace packs_tests
