#pragma once
/// \file
/// From two spheres to the contact that a law sees.

#include "scree/contact/kinematics.hpp"
#include "scree/state/records.hpp"

#include <cmath>

namespace scree {

/// Two spheres, over a number type that may be a pack. Differences of positions are taken in double before
/// they become a T: the overlap is some 1e-4 of a radius.
template <class T>
struct SpherePair {
  Vec3<T> apart;          ///< m, from the centre of j to that of i
  T squared_distance;     ///< m2, of the centres
  T closeness;            ///< m2, squared sum of the radii less the squared distance; above 0: they touch
  T reach;                ///< m, sum of the radii
  T difference;           ///< m, radius of i less that of j
  Vec3<T> velocity;       ///< m/s, of the centre of i relative to that of j
  Vec3<T> spin_i, spin_j; ///< rad/s
  T root_mass;            ///< sqrt(kg), of the reduced mass
};

/// A touching pair as its law sees it, and the levers of the contact point.
template <class T>
struct Touch {
  Kinematics<T> kinematics;
  T arm_i, arm_j; ///< m, from the centres to the contact point, in the middle of the overlap
};

/// The kinematics of two spheres that touch, after a step of `dt` [s].
///
/// A contact fills much of the window in which a processor looks ahead, so it takes as long as its longest
/// chain of dependent operations, and divisions and roots block the others: there is one of each kind.
template <class T>
[[gnu::always_inline]] inline Touch<T> touch_of(const SpherePair<T>& s, const T& dt) {
  const T inverse = reciprocal_square_root(s.squared_distance), inverse_square = inverse * inverse;
  const T distance = s.squared_distance * inverse;
  Touch<T> out;
  Kinematics<T>& k = out.kinematics;
  k.normal = s.apart * inverse;
  k.overlap = s.closeness * reciprocal(s.reach + distance);
  out.arm_i = T(0.5) * (distance + s.difference);
  out.arm_j = T(0.5) * (distance - s.difference);
  k.spin_i = s.spin_i;
  k.spin_j = s.spin_j;
  const Vec3<T> spins = s.spin_i + s.spin_j;
  // spin_i arm_i + spin_j arm_j
  const Vec3<T> rim = multiply_add(spins, T(0.5) * distance, (s.spin_i - s.spin_j) * (T(0.5) * s.difference));
  // Velocities stand half a step behind, so the arms are those of half a step ago: with the present ones, a
  // pair that turns as one body would seem to slip.
  const Vec3<T> past_normal = negated_multiply_add(s.velocity, T(0.5) * dt, s.apart) * inverse;
  k.velocity = s.velocity - cross(rim, past_normal);
  // The normal tilts as the centres pass each other; about it the contact turns with the mean spin.
  k.turn =
      multiply_add(s.apart, T(0.5) * dot(spins, s.apart), cross(s.apart, s.velocity)) * (inverse_square * dt);
  k.reduced_radius = T(0.25) * (s.reach - s.difference * s.difference / s.reach);
  k.root_mass = s.root_mass;
  k.reduced_mass = k.root_mass * k.root_mass;
  k.dt = dt;
  return out;
}

/// The same of two records, whose centres are `apart` at a distance below the sum of the radii.
template <class Real>
Touch<Real> touch_of(const SphereRecord<Real>& i, const SphereRecord<Real>& j, const Vec3<double>& apart,
                     double squared_distance, Real dt) {
  const auto real = [](double value) { return static_cast<Real>(value); };
  const double reach = i.radius + j.radius;
  const SpherePair<Real> pair{apart.template as<Real>(),
                              real(squared_distance),
                              real(reach * reach - squared_distance),
                              real(reach),
                              real(i.radius - j.radius),
                              i.velocity - j.velocity,
                              i.angular_velocity,
                              j.angular_velocity,
                              Real{1} / std::sqrt(i.inverse_mass + j.inverse_mass)};
  return touch_of(pair, dt);
}

} // namespace scree
