#pragma once
/// \file
/// What an integrator must offer.
///
/// Positions and orientations stand at a step, velocities half a step behind. An integrator is an empty,
/// copyable type with two operations, both templates over the number type of the velocities:
///
///     template <class Real>
///     static void translate(Vec3<double>& position, Vec3<Real>& velocity, const Vec3<Real>& acceleration,
///                           const TimeStep& step);
///     static void rotate(Quaternion& orientation, Vector& angular_velocity, const Vector& moment,
///                        const Vector& inertia, const TimeStep& step);
///
/// `translate` advances velocity by `step.kick` and position by `step.dt`. `rotate` does the same for a rigid
/// body: angular velocity and moment in the principal frame [rad/s, N m], inertia the principal moments [kg
/// m2]. Given by the library: Leapfrog (the paper's), RotorSplitting (for strongly non-spherical bodies).

#include "scree/state/wall_motion.hpp"

namespace scree {

template <class I, class Real>
concept Translates = requires(Vec3<double>& x, Vec3<Real>& v, const Vec3<Real>& a, const TimeStep& step) {
  I::translate(x, v, a, step);
};

template <class I>
concept Rotates = requires(Quaternion& q, Vector& w, const Vector& moment, const Vector& inertia,
                           const TimeStep& step) {
  I::rotate(q, w, moment, inertia, step);
};

template <class I, class Real = double>
concept Integrator = Translates<I, Real> && Rotates<I>;

} // namespace scree
