/// \file
/// An extension whose parameter is null gives the base law to the bit.

#include "support/models.hpp"

#include "scree/contact/adhesion.hpp"
#include "scree/contact/attrition.hpp"
#include "scree/contact/hertz_mindlin.hpp"
#include "scree/contact/normal_exponent.hpp"
#include "scree/contact/normal_hysteresis.hpp"
#include "scree/contact/rate_friction.hpp"
#include "scree/contact/rolling_resistance.hpp"
#include "scree/core/random.hpp"
#include "scree/simulation/simulation.hpp"

#include <doctest/doctest.h>

#include <bit>
#include <cstdint>
#include <vector>

using namespace scree;

namespace {

/// Bits of the motion of 54 spheres and rods that fall into a box and collide, at several times.
template <class Law>
std::vector<std::uint64_t> bits(double rolling_friction, const Law& law = Law{}) {
  Simulation<test::ModelOf<Law>> sim{{.contact = law, .time_step = 2e-5}};
  const auto rock = sim.add_material({.normal_stiffness = 2e4,
                                      .shear_stiffness = 2e4,
                                      .youngs_modulus = 2e7,
                                      .friction = 0.5,
                                      .restitution = 0.6,
                                      .rolling_friction = rolling_friction});
  const Clump ball = make_clump("ball", std::vector<Sphere>{{Vector::Zero(), 0.008}});
  const Clump rod =
      make_clump("rod", std::vector<Sphere>{{Vector::Zero(), 0.006}, {Vector{0.006, 0.0, 0.0}, 0.006}});
  Random random{5};
  for (int k = 0; k < 54; ++k) {
    const Vector at = 0.02 * Vector{k % 3 + 0.5, k / 3 % 3 + 0.5, k / 9 + 0.5};
    sim.add({.clump = k % 2 == 0 ? &ball : &rod,
             .material = rock,
             .position = at + 1e-3 * Vector{random.normal(), random.normal(), random.normal()},
             .orientation = random.orientation(),
             .velocity = 0.3 * Vector{random.normal(), random.normal(), random.normal()}});
  }
  sim.add_wall({.name = "box",
                .surfaces = {{Plane{}, rock},
                             {Plane{.normal = Vector::UnitX()}, rock},
                             {Plane{.normal = Vector::UnitY()}, rock},
                             {Plane{.point = {0.06, 0.06, 0.0}, .normal = -Vector::UnitX()}, rock},
                             {Plane{.point = {0.06, 0.06, 0.0}, .normal = -Vector::UnitY()}, rock}},
                .dynamics = Fixed{}});
  std::vector<std::uint64_t> out;
  for (int k = 1; k <= 6000; ++k) {
    sim.step();
    if (k % 2000 == 0) {
      for (std::size_t b = 0; b < sim.bodies().size(); ++b) {
        for (const Vector& v :
             {sim.bodies().position(b), sim.bodies().velocity(b), sim.bodies().angular_velocity(b)}) {
          for (int d = 0; d < 3; ++d) {
            out.push_back(std::bit_cast<std::uint64_t>(v[d]));
          }
        }
      }
      out.push_back(std::bit_cast<std::uint64_t>(sim.dissipation().friction));
      out.push_back(std::bit_cast<std::uint64_t>(sim.dissipation().viscous));
    }
  }
  return out;
}

} // namespace

TEST_CASE("physics: rolling resistance of zero is the base law to the bit") {
  CHECK(bits<LinearSpring<>>(0.0) == bits<LinearSpring<RollingResistance>>(0.0));
  CHECK(bits<HertzMindlin<>>(0.0) == bits<HertzMindlin<RollingResistance>>(0.0));
  // The comparison can fail.
  CHECK(bits<LinearSpring<>>(0.0) != bits<LinearSpring<RollingResistance>>(0.01));
}

TEST_CASE("physics: all extensions together are the base law to the bit where each is null") {
  using Extended =
      LinearSpring<NormalExponent, NormalHysteresis, Adhesion, RateFriction, Attrition, RollingResistance>;
  const auto base = bits<LinearSpring<>>(0.0);
  CHECK(base == bits<Extended>(0.0));
  // Each makes a difference.
  const auto with = [](const auto& exponent, const auto& hysteresis, const auto& adhesion, const auto& rate,
                       const auto& attrition) {
    return bits(0.0, Extended{exponent, hysteresis, adhesion, rate, attrition, RollingResistance{}});
  };
  CHECK(base != with(NormalExponent{1.2}, NormalHysteresis{}, Adhesion{}, RateFriction{}, Attrition{}));
  CHECK(base != with(NormalExponent{}, NormalHysteresis{1.2}, Adhesion{}, RateFriction{}, Attrition{}));
  CHECK(base != with(NormalExponent{}, NormalHysteresis{}, Adhesion{0.1}, RateFriction{}, Attrition{}));
  CHECK(base != with(NormalExponent{}, NormalHysteresis{}, Adhesion{}, RateFriction{0.1}, Attrition{}));
  CHECK(base != with(NormalExponent{}, NormalHysteresis{}, Adhesion{}, RateFriction{}, Attrition{10.0}));
}
