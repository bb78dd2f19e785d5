#pragma once
/// \file
/// Beds of nearly equal balls that the cases of silos and columns share.

#include "scree/measure/unbalanced_force.hpp"
#include "scree/packing/loose_lattice.hpp"
#include "scree/simulation/run.hpp"
#include "scree/simulation/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace validation {

/// The default model without the sums of dissipated work, which these cases do not read.
struct Quiet : scree::DefaultModel {
  static constexpr bool energy_audit = false;
};

/// Balls of glass about 2 mm across by the linear law. All numbers are ours: what is compared with them is a
/// law of statics, or made dimensionless with the diameter and gravity.
struct Balls {
  double diameter = 0.002; ///< m, mean
  double spread = 0.1;     ///< half of the range of diameters over their mean: equal balls would crystallise
  double density = 2500.0; ///< kg/m3
  double g = 9.81;         ///< m/s2
  double friction = 0.5;   ///< as Landry, Grest, Silbert & Plimpton, Phys. Rev. E 67:041303 (2003) have it
  double restitution = 0.9;
  double stiffness = 5e3; ///< of a contact, in weights of a ball per diameter

  /// kg
  [[nodiscard]] double mass() const { return density * std::numbers::pi / 6.0 * std::pow(diameter, 3); }
  /// s, in which a ball falls half of its diameter.
  [[nodiscard]] double time() const { return std::sqrt(diameter / g); }

  /// The shear stiffness is 2/7 of the normal one, as for both to swing in step (Silbert et al. 2001).
  [[nodiscard]] scree::Material material() const {
    const double normal = stiffness * mass() * g / diameter;
    return {.density = density,
            .normal_stiffness = normal,
            .shear_stiffness = 2.0 / 7.0 * normal,
            .friction = friction,
            .restitution = restitution};
  }
};

/// Balls above the bottom of `footprint`, apart from each other.
inline scree::Packing loose_balls(const Balls& balls, std::size_t count, const Eigen::AlignedBox3d& footprint,
                                  scree::Random& random, scree::MaterialId material = 0) {
  std::vector<scree::DrawnClump> drawn;
  for (std::size_t k = 0; k < count; ++k) {
    drawn.push_back({0, balls.diameter * random.uniform(1.0 - balls.spread, 1.0 + balls.spread)});
  }
  const auto ball = scree::make_clump("ball", std::vector<scree::Sphere>{{scree::Vector::Zero(), 0.5}});
  scree::Packing packing = scree::loose_lattice({ball}, drawn, footprint, random);
  for (scree::PackedBody& body : packing.bodies) {
    body.material = material;
  }
  return packing;
}

/// Balls above z = 0 within a tube about the z axis, apart from each other.
/// \param radius m, of the tube
inline scree::Packing balls_in_tube(const Balls& balls, std::size_t count, double radius,
                                    scree::Random& random, scree::MaterialId material = 0) {
  const scree::Vector corner{radius, radius, 0.0};
  // A square around the tube needs 4 / pi as many; the rest makes up for those that the mantle would cut.
  scree::Packing packing = loose_balls(balls, 2 * count, {-corner, corner}, random, material);
  std::erase_if(packing.bodies, [&](const scree::PackedBody& body) {
    return body.position.head<2>().norm() + 0.5 * body.scale > radius;
  });
  packing.bodies.resize(std::min(count, packing.bodies.size()));
  return packing;
}

/// kg, of all free bodies for which `counts(position)`.
template <class Simulation, class Counts>
[[nodiscard]] double mass_where(const Simulation& sim, Counts counts) {
  double sum = 0.0;
  for (std::size_t b = 0; b < sim.bodies().size(); ++b) {
    if (!sim.bodies().is_fixed(b) && counts(sim.bodies().position(b))) {
      sum += sim.bodies().mass(b);
    }
  }
  return sum;
}

/// Steps until the mean unbalanced over the mean contact force is at most `ratio`, for at most `patience`
/// [s]. Returns the ratio in the end.
template <class Simulation>
double come_to_rest(Simulation& sim, double ratio, double patience, double interval) {
  const double start = sim.time();
  double now = 1.0;
  while (now > ratio && sim.time() - start < patience) {
    scree::run_for(sim, interval);
    now = scree::unbalanced_force(sim).ratio();
  }
  return now;
}

} // namespace validation
