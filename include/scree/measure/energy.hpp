#pragma once
/// \file
/// Energies of the grains.

#include "scree/core/linear.hpp"
#include "scree/state/bodies.hpp"

#include <cstddef>

namespace scree {

/// J, of all free bodies in translation and rotation, at the velocities of half a step ago.
template <class Real>
double kinetic_energy(const Bodies<Real>& bodies) {
  double sum = 0.0;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    sum += bodies.is_fixed(b) ? 0.0 : bodies.kinetic_energy(b);
  }
  return sum;
}

/// J, of all free bodies in the field of gravity, 0 at the origin.
template <class Real>
double potential_energy(const Bodies<Real>& bodies, const Vector& gravity) {
  double sum = 0.0;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    sum -= bodies.is_fixed(b) ? 0.0 : bodies.mass(b) * gravity.dot(bodies.position(b));
  }
  return sum;
}

/// J, in the springs of all contacts of a simulation.
template <class Simulation>
double elastic_energy(const Simulation& simulation) {
  double sum = 0.0;
  simulation.visit_contacts([&](const auto& contact) { sum += contact.elastic_energy; });
  return sum;
}

} // namespace scree
