/// \file
/// What a collision loses is what friction and the dashpots say they took.

#include "support/models.hpp"

#include "scree/contact/hertz_mindlin.hpp"
#include "scree/simulation/simulation.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <type_traits>
#include <vector>

using namespace scree;

namespace {

Material material(double friction, double restitution) {
  return {.normal_stiffness = 2e5,
          .shear_stiffness = 1.6e5,
          .youngs_modulus = 1e8,
          .poisson_ratio = 0.3,
          .friction = friction,
          .restitution = restitution};
}

struct Balance {
  double lost;              ///< J, of kinetic energy
  double friction, viscous; ///< J, as accounted
};

/// An oblique impact of two spheres that spin; `slip` is the tangential speed at the contact, in m/s.
template <class Law>
Balance oblique(double friction, double restitution, double slip) {
  const Clump a = make_clump("a", std::vector<Sphere>{{Vector::Zero(), 0.01}});
  const Clump b = make_clump("b", std::vector<Sphere>{{Vector::Zero(), 0.013}});
  Simulation<test::ModelOf<Law>> sim{{.gravity = Vector::Zero(), .time_step = 2e-7, .sort_interval = 0}};
  const auto rock = sim.add_material(material(friction, restitution));
  sim.add({.clump = &a,
           .material = rock,
           .position = {0.0, 0.0, 0.023},
           .velocity = {0.6 * slip, 0.0, -1.0},
           .angular_velocity = {0.0, -20.0 * slip, 0.0}});
  sim.add({.clump = &b, .material = rock, .angular_velocity = {0.0, -0.2 * slip / 0.013, 30.0}});
  const auto& bodies = sim.bodies();
  const auto energy = [&] { return bodies.kinetic_energy(0) + bodies.kinetic_energy(1); };
  const double before = energy();
  for (int k = 0; k < 20000; ++k) {
    sim.step();
  }
  REQUIRE((bodies.position(0) - bodies.position(1)).norm() > 0.023);
  return {before - energy(), sim.dissipation().friction, sim.dissipation().viscous};
}

} // namespace

TEST_CASE_TEMPLATE("physics: an oblique impact loses what friction and dashpots take", Law, LinearSpring<>,
                   HertzMindlin<>) {
  const std::string name = std::is_same_v<Law, LinearSpring<>> ? "linear" : "Hertz";
  for (const double restitution : {1.0, 0.9, 0.5}) {
    for (const double friction : {0.0, 0.1, 0.6}) {
      for (const double slip : {0.0, 0.1, 1.0, 3.0}) {
        const Balance b = oblique<Law>(friction, restitution, slip);
        MESSAGE(name << ", e " << restitution << ", mu " << friction << ", slip " << slip << " m/s: lost "
                     << b.lost << " J; friction " << b.friction << " J, dashpots " << b.viscous << " J");
        CAPTURE(restitution);
        CAPTURE(friction);
        CAPTURE(slip);
        // What the time step leaves of an elastic impact is some 1e-8 of the energy.
        CHECK(std::abs(b.lost - b.friction - b.viscous) < 0.01 * b.lost + 1e-8);
        CHECK(b.friction >= 0.0);
        CHECK(b.viscous >= 0.0);
      }
    }
  }
}
