#pragma once
/// \file
/// Where a rigid body has its members, and how they move.

#include "scree/core/quat.hpp"

namespace scree {

/// A member sphere beside the centre of mass of its body, in space.
template <class T>
struct Placed {
  Vec3<T> arm;      ///< m, from the centre of mass
  Vec3<T> velocity; ///< m/s, less that of the centre of mass
};

/// Velocities stand half a step behind positions, those of members as that of the body: they are those of the
/// arms of half a step ago.
/// \param offset m, in the principal frame
/// \param w rad/s, in space
/// \param dt s, of the step that led there; 0 for a body that was put there
template <class T>
Placed<T> placed(const Vec3<T>& offset, const Axes<T>& axes, const Vec3<T>& w, double dt) {
  const Vec3<T> arm = axes.to_space(offset);
  return {arm, cross(w, negated_multiply_add(cross(w, arm), T(0.5 * dt), arm))};
}

} // namespace scree
