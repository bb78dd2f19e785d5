#pragma once
/// \file
/// A symplectic integrator for bodies that are far from a sphere.

#include "scree/integrators/leapfrog.hpp"

namespace scree {

/// Rotation by the symmetric splitting of the free rotor into five turns about principal axes (Dullweber,
/// Leimkuhler & McLachlan, J. Chem. Phys. 107:5840, 1997), kicked by the moment in the middle of the
/// leapfrog. Each turn is exact, so the angular momentum in space is kept to rounding at any step and ratio
/// of the moments, the map is symplectic and reversible, and the energy error stays bounded. Second order.
/// Translation as in Leapfrog.
struct RotorSplitting : Leapfrog {
  template <class T>
  static void rotate(Quat<T>& orientation, Vec3<T>& angular_velocity, const Vec3<T>& moment,
                     const Vec3<T>& inertia, const TimeStep& step) {
    const T kick(step.kick);
    Vec3<T> l{multiply_add(kick, moment.x, inertia.x * angular_velocity.x),
              multiply_add(kick, moment.y, inertia.y * angular_velocity.y),
              multiply_add(kick, moment.z, inertia.z * angular_velocity.z)};
    Quat<T> turns;
    // About one axis at the rate of the momentum there, which takes the other two round.
    const auto turn = [&](T Quat<T>::*axis, const T& along, const T& moment_there, T& second, T& third,
                          double share) {
      const T half = T(0.5 * share * step.dt) * along / moment_there;
      const T c = cosine(half), s = sine(half), cos_full = negated_multiply_add(s, s, c * c),
              sin_full = T(2) * c * s;
      Quat<T> by{T(0), T(0), T(0), c};
      by.*axis = s;
      turns = turns * by;
      const T before = second;
      second = multiply_add(sin_full, third, cos_full * second);
      third = negated_multiply_add(sin_full, before, cos_full * third);
    };
    turn(&Quat<T>::x, l.x, inertia.x, l.y, l.z, 0.5);
    turn(&Quat<T>::y, l.y, inertia.y, l.z, l.x, 0.5);
    turn(&Quat<T>::z, l.z, inertia.z, l.x, l.y, 1.0);
    turn(&Quat<T>::y, l.y, inertia.y, l.z, l.x, 0.5);
    turn(&Quat<T>::x, l.x, inertia.x, l.y, l.z, 0.5);
    const Quat<T> next = orientation * turns;
    orientation = next * (T(1) / square_root(squared_norm(next)));
    angular_velocity = {l.x / inertia.x, l.y / inertia.y, l.z / inertia.z};
  }
};

} // namespace scree
