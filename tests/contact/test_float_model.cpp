/// \file
/// A model in float follows one in double to what float resolves.

#include "support/models.hpp"
#include "support/relative_error.hpp"

#include "scree/contact/hertz_mindlin.hpp"
#include "scree/simulation/simulation.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace scree;
using test::LinearInFloat;
using test::ModelOf;
using test::relative_error;

namespace {

Material material(double restitution) {
  return {.normal_stiffness = 1e5,
          .shear_stiffness = 1e5,
          .youngs_modulus = 2e8,
          .friction = 0.5,
          .restitution = restitution};
}

struct Impact {
  Vector velocity, spin;
};

template <class Model>
Impact oblique_impact() {
  const Clump ball = make_clump("ball", std::vector<Sphere>{{Vector::Zero(), 0.01}});
  Simulation<Model> sim{{.gravity = Vector::Zero(), .time_step = 5e-7}};
  const auto rock = sim.add_material(material(0.7));
  // Ten metres from the origin: positions are in double whatever the model.
  const Vector away{10.0, -7.0, 3.0};
  sim.add_wall({.name = "floor", .surfaces = {{Plane{.point = away}, rock}}, .dynamics = Fixed{}});
  sim.add({.clump = &ball,
           .material = rock,
           .position = away + Vector{0, 0, 0.0101},
           .velocity = {0.4, 0.1, -1.0}});
  for (int k = 0; k < 8000; ++k) {
    sim.step();
  }
  return {sim.bodies().velocity(0), sim.bodies().angular_velocity(0)};
}

struct Rest {
  double support, centre_height, overlap; ///< N, m, m
};

template <class Model>
Rest settled() {
  const Clump ball = make_clump("ball", std::vector<Sphere>{{Vector::Zero(), 0.01}});
  Simulation<Model> sim{{.time_step = 1e-5, .local_damping = 0.3}};
  const auto rock = sim.add_material(material(0.3));
  sim.add_wall({.name = "floor", .surfaces = {{Plane{}, rock}}, .dynamics = Fixed{}});
  sim.add_wall({.name = "sides",
                .surfaces = {{Plane{.normal = Vector::UnitX()}, rock},
                             {Plane{.normal = Vector::UnitY()}, rock},
                             {Plane{.point = {0.0405, 0.0405, 0}, .normal = -Vector::UnitX()}, rock},
                             {Plane{.point = {0.0405, 0.0405, 0}, .normal = -Vector::UnitY()}, rock}},
                .dynamics = Fixed{}});
  for (int k = 0; k < 12; ++k) {
    sim.add({.clump = &ball,
             .material = rock,
             .position = {0.01 + 0.0205 * (k % 2) + 1e-4 * (k / 4), 0.01 + 0.0205 * (k / 2 % 2),
                          0.0102 + 0.0203 * (k / 4)}});
  }
  for (int k = 0; k < 60000; ++k) {
    sim.step();
  }
  Rest rest{-sim.wall(0).load.force.z() - sim.wall(1).load.force.z(), 0.0, 0.0};
  for (std::size_t b = 0; b < sim.bodies().size(); ++b) {
    rest.centre_height += sim.bodies().position(b).z() / 12.0;
  }
  sim.visit_contacts([&](const ContactView& c) { rest.overlap = std::max(rest.overlap, c.overlap); });
  return rest;
}

} // namespace

TEST_CASE_TEMPLATE("physics: an oblique impact in float differs from that in double by what float resolves",
                   Law, LinearSpring<>, HertzMindlin<>) {
  const Impact exact = oblique_impact<ModelOf<Law>>(), coarse = oblique_impact<ModelOf<Law, float>>();
  const double velocity_off = (coarse.velocity - exact.velocity).norm() / exact.velocity.norm();
  const double spin_off = (coarse.spin - exact.spin).norm() / exact.spin.norm();
  MESSAGE("relative difference of velocity " << velocity_off << ", of spin " << spin_off);
  // Some 1e3 steps of contact, each off by half a unit in the last place, 6e-8; all of one sign at worst.
  CHECK(velocity_off < 6e-5);
  CHECK(spin_off < 6e-5);
  CHECK(velocity_off > 0.0); // two different programs ran
}

TEST_CASE("physics: a stack settles in float to the place and weight that it has in double") {
  const Rest exact = settled<DefaultModel>(), coarse = settled<LinearInFloat>();
  const double weight = 12 * 2650.0 * 4.0 / 3.0 * std::acos(-1.0) * 1e-6 * 9.81;
  MESSAGE("support " << exact.support << " and " << coarse.support << " N of " << weight << " N; mean height "
                     << exact.centre_height << " and " << coarse.centre_height << " m; largest overlap "
                     << exact.overlap << " and " << coarse.overlap << " m");
  CHECK(relative_error(exact.support, weight) < 1e-4);
  CHECK(relative_error(coarse.support, weight) < 1e-4);
  CHECK(relative_error(coarse.centre_height, exact.centre_height) < 1e-4);
}
