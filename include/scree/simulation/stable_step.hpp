#pragma once
/// \file
/// The largest time step that the explicit integration stands.

#include "scree/contact/kinematics.hpp"
#include "scree/core/error.hpp"
#include "scree/state/bodies.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace scree {

/// A critical time step [s] and what sets it.
struct StepLimit {
  double critical = std::numeric_limits<double>::infinity();
  std::string cause = "nothing";

  void lower_to(double step, const auto& describe) {
    if (step < critical) {
      critical = step;
      cause = describe();
    }
  }
};

/// Leapfrog is stable below 2 / w; a dashpot of damping ratio z lowers that by sqrt(1 + z^2) - z.
inline double critical_step(double squared_frequency, double damping_ratio) {
  return 2.0 / std::sqrt(squared_frequency) *
         (std::sqrt(1.0 + damping_ratio * damping_ratio) - damping_ratio);
}

/// By how much a dense bed is stiffer than one contact. In the fastest motion of a dense packing (fcc, hcp)
/// of equal spheres with k_s = k_n all of them spin alike: squared frequency 40 k/m, where one pair has 7
/// k/m, so 40/7; rounded up to 6. The damping ratio of a contact in shear acts in that motion as the ratio
/// times sqrt(6 mobility m*).
inline constexpr double crowding = 6.0;

/// The same of a motion along the normals: 8 k/m in the fastest of fcc, where the layers of spheres swing
/// against each other, and one pair has 2 k/m.
inline constexpr double crowding_along_normals = 4.0;

/// What the softest body of one material looks like to a contact.
struct Softest {
  double mobility = 0.0;        ///< 1/kg, see Bodies::mobility
  double normal_mobility = 0.0; ///< 1/kg, under a force along a normal, which does not turn a lone sphere
  double mass = 0.0;            ///< kg
  double radius = 0.0;          ///< m, of its smallest sphere
  std::uint64_t body = 0;
};

/// Finds the free body of a material that gives way most; a mobility of 0 if there is none.
template <class Real>
Softest softest(const Bodies<Real>& bodies, std::uint16_t material) {
  Softest found;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (bodies.is_fixed(b) || bodies.material(b) != material) {
      continue;
    }
    if (const double mobility = bodies.mobility(b); mobility > found.mobility) {
      double radius = bodies.bounding_radius(b);
      for (std::size_t s = bodies.first_sphere(b); s < bodies.first_sphere(b + 1); ++s) {
        radius = std::min(radius, bodies.spheres()[s].radius);
      }
      found = {mobility, bodies.kind(b) == BodyKind::lone ? 1.0 / bodies.mass(b) : mobility, bodies.mass(b),
               radius, bodies.id(b)};
    }
  }
  return found;
}

} // namespace scree
