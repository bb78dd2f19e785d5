#pragma once
/// \file
/// What an integrator must offer.
///
/// Positions and orientations stand at a step, velocities half a step behind. An integrator is an empty,
/// copyable type with two operations:
///
///     template <class T>
///     static void translate(Vec3<T>& position, Vec3<T>& velocity, const Vec3<T>& acceleration,
///                           const TimeStep& step);
///     template <class T>
///     static void rotate(Quat<T>& orientation, Vec3<T>& angular_velocity, const Vec3<T>& moment,
///                        const Vec3<T>& inertia, const TimeStep& step);
///
/// `translate` advances velocity by `step.kick` and position by `step.dt`. `rotate` does the same for a rigid
/// body: angular velocity and moment in the principal frame [rad/s, N m], inertia the principal moments [kg
/// m2]. T is `double` or a pack of them (core/pack.hpp); with the operations of core/numeric.hpp one source
/// serves both. An integrator whose operations take `double` alone is computed on body after body. Given by
/// the library: Leapfrog (the paper's), RotorSplitting (for strongly non-spherical bodies).

#include "scree/core/pack.hpp"
#include "scree/state/wall_motion.hpp"

#include <type_traits>

namespace scree {

template <class I, class T = double>
concept Translates = requires(Vec3<T>& x, Vec3<T>& v, const Vec3<T>& a, const TimeStep& step) {
  I::translate(x, v, a, step);
};

template <class I, class T = double>
concept Rotates = requires(Quat<T>& q, Vec3<T>& w, const Vec3<T>& moment, const Vec3<T>& inertia,
                           const TimeStep& step) {
  I::rotate(q, w, moment, inertia, step);
};

template <class I, class T = double>
concept Integrator = Translates<I, T> && Rotates<I, T>;

/// What the motion of bodies is computed on: packs, for an integrator that takes them.
template <class I>
using MotionNumber = std::conditional_t<Integrator<I, Pack<double>>, Pack<double>, double>;

} // namespace scree
