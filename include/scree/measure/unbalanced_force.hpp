#pragma once
/// \file
/// How far a bed is from rest.

#include "scree/core/linear.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace scree {

struct UnbalancedForce {
  double mean = 0.0;         ///< N, resultant of contacts and gravity on a free body that touches something
  double most = 0.0;         ///< N
  double mean_contact = 0.0; ///< N, magnitude of a contact force
  std::size_t contacts = 0;

  /// Mean resultant over mean contact force; 0 where nothing touches.
  [[nodiscard]] double ratio() const { return mean_contact > 0.0 ? mean / mean_contact : 0.0; }
};

template <class Simulation>
UnbalancedForce unbalanced_force(const Simulation& simulation) {
  const auto& bodies = simulation.bodies();
  std::vector<Vector> resultant(bodies.size(), Vector::Zero());
  std::vector<bool> touches(bodies.size(), false);
  UnbalancedForce out;
  simulation.visit_contacts([&](const auto& contact) {
    resultant[contact.first] += contact.force;
    touches[contact.first] = true;
    if (!contact.with_wall) {
      resultant[contact.second] -= contact.force;
      touches[contact.second] = true;
    }
    out.mean_contact += contact.force.norm();
    ++out.contacts;
  });
  std::size_t counted = 0;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (touches[b] && !bodies.is_fixed(b)) {
      const double size = (resultant[b] + bodies.mass(b) * simulation.setup().gravity).norm();
      out.mean += size;
      out.most = std::max(out.most, size);
      ++counted;
    }
  }
  out.mean /= static_cast<double>(std::max<std::size_t>(1, counted));
  out.mean_contact /= static_cast<double>(std::max<std::size_t>(1, out.contacts));
  return out;
}

} // namespace scree
