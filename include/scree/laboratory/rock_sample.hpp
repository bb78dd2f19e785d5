#pragma once
/// \file
/// The rock that an experiment is done with, and what its rig is made of.

#include "scree/core/error.hpp"
#include "scree/material/pair.hpp"
#include "scree/packing/assembly.hpp"
#include "scree/packing/sieve_curve.hpp"
#include "scree/simulation/model.hpp"

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace scree {

/// Shapes, sizes and material of a rock, and the material of walls, lid, plate and funnel.
struct RockSample {
  Assembly assembly;
  Material rock;
  Material rig;
  Stiffness stiffness = Stiffness::of_particle; ///< what the stiffness of both materials stands for
};

/// `physics` for an experiment on `sample`, which takes the place of its stiffness convention, as `threads`
/// does of its threads. \param threads 0: one for each processor
/// \throws Error for gravity that is not straight down, as experiments have it
template <class Model>
Setup<Model> with_sample(Setup<Model> physics, const RockSample& sample, unsigned threads) {
  const Vector& pull = physics.gravity;
  if (pull.x() != 0.0 || pull.y() != 0.0 || !(pull.z() < 0.0)) {
    throw Error(message("experiment: gravity = (", pull.x(), ", ", pull.y(), ", ", pull.z(),
                        ") m/s2 must be straight down, (0, 0, z) with z below 0"));
  }
  physics.stiffness = sample.stiffness;
  physics.threads = threads;
  return physics;
}

/// Table 1 of Coetzee, Els & Dymond (2010); the restitution is ours.
inline Material paper_material() {
  return {.name = "rock",
          .density = 1518.0,          // kg/m3
          .normal_stiffness = 1.75e7, // N/m, of a particle
          .shear_stiffness = 1.75e7,  // N/m
          .friction = 0.53,
          .restitution = 0.6};
}

namespace detail {

/// Steel as the rock feels it; ours, but as stiff as the rock.
inline Material rig_like(const Material& rock) {
  Material rig = rock;
  rig.name = "rig";
  rig.friction = 0.3;
  return rig;
}

} // namespace detail

/// The paper's rock: its four shapes and sieves, Table 1. Shares of the shapes and of the sieve classes are
/// in the figures of the paper only; they are ours.
inline RockSample paper_rock(MassConvention convention = MassConvention::sum_of_spheres) {
  const Material rock = paper_material();
  return {Assembly{default_rock(convention)}, rock, detail::rig_like(rock)};
}

/// The desk version: a fifth larger, of the two middle classes alone, as the finest would be most of the
/// grains and set the time step, and softer. All ours.
inline RockSample desk_rock(MassConvention convention = MassConvention::sum_of_spheres) {
  const SieveCurve curve{
      {0.0095, 0.0132, 0.019, 0.0265, 0.0375}, {0.0, 0.0, 0.2, 1.0, 1.0}, SieveBasis::mass};
  std::vector<ShapeFraction> parts = default_rock(convention);
  for (ShapeFraction& part : parts) {
    part.sizes = curve;
  }
  Material rock = paper_material();
  rock.normal_stiffness = rock.shear_stiffness = 1e5;
  return {Assembly{std::move(parts), 1.2}, rock, detail::rig_like(rock)};
}

} // namespace scree
