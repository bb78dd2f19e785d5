#pragma once
/// \file
/// Bodies and sums that the tests of whole simulations share.

#include "scree/core/linear.hpp"
#include "scree/geometry/clump.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace scree::test {

/// One sphere [m].
inline Clump ball(double radius) {
  return make_clump("ball", std::vector<Sphere>{{Vector::Zero(), radius}});
}

/// Four overlapping spheres of different size, with no symmetry; about 2.4 m across at `scale` 1.
inline Clump stone(double scale) {
  return scaled(make_clump("stone", std::vector<Sphere>{{{-0.7, 0, 0}, 0.5},
                                                        {{0, 0.2, 0}, 0.6},
                                                        {{0.7, 0, 0.1}, 0.45},
                                                        {{0.1, -0.4, 0.3}, 0.5}}),
                scale);
}

/// The number of the body with the given id; size() if it is gone.
template <class Simulation>
std::size_t number_of(const Simulation& simulation, std::uint64_t id) {
  std::size_t b = 0;
  while (b < simulation.bodies().size() && simulation.bodies().id(b) != id) {
    ++b;
  }
  return b;
}

/// J: kinetic, potential and elastic energy of the grains.
template <class Simulation>
double mechanical_energy(const Simulation& simulation) {
  double sum = 0.0;
  const auto& bodies = simulation.bodies();
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (!bodies.is_fixed(b)) {
      sum += bodies.kinetic_energy(b) - bodies.mass(b) * simulation.setup().gravity.dot(bodies.position(b));
    }
  }
  simulation.visit_contacts([&](const auto& contact) { sum += contact.elastic_energy; });
  return sum;
}

} // namespace scree::test
