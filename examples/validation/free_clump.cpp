/// \file
/// A clump of three different moments of inertia that turns freely, in a simulation, from an orientation that
/// is along none of the axes: against the exact motion.

#include "cases.hpp"
#include "free_rotor.hpp"
#include "impact.hpp"

#include "scree/core/random.hpp"
#include "scree/integrators/leapfrog.hpp"
#include "scree/integrators/rotor_splitting.hpp"
#include "scree/state/rotation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <type_traits>
#include <vector>

namespace validation {

namespace {

constexpr double spin = 20.0, duration = 1.5; // rad/s, s: some five turns

template <class Used>
struct Turning : scree::DefaultModel {
  using Integrator = Used;
};

/// What is left of the exact motion after `steps`.
struct FreeMotion {
  double orientation = 0.0, angular_velocity = 0.0; ///< rad, and over the exact; at the end
  double momentum = 0.0, direction = 0.0;           ///< largest change of the size and of L over L
  double energy = 0.0;                              ///< largest change over that at the start
  double turn = 0.0;                                ///< rad, of the greatest spin in a step
  Series found{"scree", Origin::code, {}, {}}, exact{"exact", Origin::theory, {}, {}};
};

template <class Integrator>
FreeMotion turn_freely(int steps) {
  constexpr bool leapfrog = std::is_same_v<Integrator, scree::Leapfrog>;
  const double dt = duration / steps;
  scree::Simulation<Turning<Integrator>> sim{{.gravity = scree::Vector::Zero(), .time_step = dt}};
  // The shape is ours; so soft that it sets no limit to the step.
  const auto shape = scree::make_clump("stone", std::vector<scree::Sphere>{{{0.0, 0.0, 0.0}, 0.01},
                                                                           {{0.015, 0.002, 0.0}, 0.008},
                                                                           {{-0.004, 0.012, 0.003}, 0.007},
                                                                           {{-0.01, -0.003, -0.006}, 0.006}});
  const auto id = sim.add_material({.normal_stiffness = 1e-6, .shear_stiffness = 1e-6});
  const scree::Quaternion space = scree::Random{7, "free clump"}.orientation();
  const scree::Vector inertia = sim.materials().at(id).density * shape.inertia;
  // Half of the wobble, in energy, at which it would tip over.
  const double wobble =
      std::sqrt(0.5 * inertia[2] * (inertia[2] - inertia[1]) / (inertia[0] * (inertia[1] - inertia[0])));
  const FreeRotor exact{inertia, wobble * spin, spin};
  const auto orientation_at = [&](double t) { return space * exact.orientation(t); };
  sim.add({.clump = &shape,
           .material = id,
           .orientation = orientation_at(0.0),
           .angular_velocity = orientation_at(0.0) * exact.angular_velocity(0.0)});
  const auto& bodies = sim.bodies();
  const scree::Vector momentum = space * exact.momentum();
  // rad/s in the principal frame, at the time of the orientation: a leapfrog has it half a step behind; the
  // splitting turns the momentum with the body.
  const auto spin_here = [&] {
    const scree::Vector w = bodies.orientation(0).conjugate() * bodies.angular_velocity(0);
    return leapfrog ? scree::kicked(w, scree::Vector::Zero(), inertia, 0.5 * dt) : w;
  };
  FreeMotion out;
  out.turn = exact.angular_velocity(0.0).norm() * dt;
  double energy = bodies.kinetic_energy(0);
  const double at_first = energy;
  for (int k = 1; k <= steps; ++k) {
    sim.step();
    const scree::Vector l = bodies.orientation(0) * inertia.cwiseProduct(spin_here());
    out.momentum = std::max(out.momentum, std::abs(l.norm() / momentum.norm() - 1.0));
    out.direction = std::max(out.direction, (l - momentum).norm() / momentum.norm());
    out.energy = std::max(out.energy, std::abs(bodies.kinetic_energy(0) / at_first - 1.0));
    if (k % (steps / 200) == 0) {
      const double t = k * dt;
      out.found.x.push_back(t);
      out.found.y.push_back((bodies.orientation(0) * scree::Vector::UnitX()).x());
      out.exact.x.push_back(t);
      out.exact.y.push_back((orientation_at(t) * scree::Vector::UnitX()).x());
    }
  }
  out.orientation = 2.0 * (orientation_at(duration).conjugate() * bodies.orientation(0)).vec().norm();
  const scree::Vector w = exact.angular_velocity(duration);
  out.angular_velocity = (spin_here() - w).norm() / w.norm();
  return out;
}

template <class Integrator>
void turn_by(Outcome& out, const std::string& integrator) {
  constexpr bool leapfrog = std::is_same_v<Integrator, scree::Leapfrog>;
  const std::string name = "free clump, " + integrator;
  const FreeMotion coarse = turn_freely<Integrator>(4000), fine = turn_freely<Integrator>(8000);
  const Source jacobi{Origin::theory, "Jacobi's elliptic functions, Landau & Lifshitz, section 37"};
  const Source kept{Origin::theory, "no moment acts"};
  const Tolerance of_order{
      0.02, false,
      "the next term of the error: a share of the order of a step's turn, 1/200 rad, or smaller"};
  out.add(name, "order of the orientation's error", "1", 2.0, jacobi,
          std::log2(coarse.orientation / fine.orientation), of_order);
  out.add(name, "order of the angular velocity's error", "1", 2.0, jacobi,
          std::log2(coarse.angular_velocity / fine.angular_velocity), of_order);
  const double turn2 = fine.turn * fine.turn;
  out.add(
      name, fmt::format("orientation after {:g} s", duration), "rad", 0.0, jacobi, fine.orientation,
      {turn2 * spin * duration, false, "second order: the square of a step's turn, times the angle turned"});
  const Tolerance rounding{8000 * 2.2e-16, false, "a rounding in each step, all of one sign"};
  const Tolerance second{turn2, false, "second order: the square of a step's turn"};
  out.add(name, "largest change of the size of L over L", "1", 0.0, kept, fine.momentum, rounding);
  out.add(name, "largest change of L over L", "1", 0.0, kept, fine.direction, leapfrog ? second : rounding);
  out.add(name, "largest change of the energy over it", "1", 0.0, kept, fine.energy,
          leapfrog ? rounding : second);
  out.draw({"free_clump_" + integrator,
            name,
            "time, s",
            "first principal axis along x",
            {fine.exact},
            {fine.found}});
}

} // namespace

Outcome free_clump(const Inputs& /*inputs*/) {
  Outcome out;
  turn_by<scree::Leapfrog>(out, "Leapfrog");
  turn_by<scree::RotorSplitting>(out, "RotorSplitting");
  out.notes.emplace_back(
      "Free clump: its spheres, spin and orientation are ours, as the theory holds for any.");
  return out;
}

} // namespace validation
