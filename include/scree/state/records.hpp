#pragma once
/// \file
/// The packed records that the time-step loop reads and writes.
///
/// One record for each sphere, because a pair touches all fields of two spheres that lie far apart in memory:
/// separate arrays for each field would cost a cache line each.

#include "scree/core/linear.hpp"

#include <cstdint>

namespace scree {

/// A member sphere of a rigid body, in space. Positions are always double: overlaps are some 1e-7 of the
/// bed's size and would vanish in float.
template <class Real>
struct alignas(32) SphereRecord {
  Vec3<double> position;       ///< m
  double radius = 0.0;         ///< m
  Vec3<Real> velocity;         ///< m/s, of the centre, half a step behind the position
  Real inverse_mass = 0;       ///< 1/kg, of the body; 0 for a fixed one
  Vec3<Real> angular_velocity; ///< rad/s, of the body
  std::uint32_t material = 0;
};
static_assert(sizeof(SphereRecord<double>) == 96 && sizeof(SphereRecord<float>) == 64);

/// What acts on a sphere in one step, about its own centre.
template <class Real>
struct alignas(8 * sizeof(Real)) ForceRecord {
  Vec3<Real> force;  ///< N
  Real pressed = 0;  ///< N, sum of the magnitudes of the normal forces at its contacts
  Vec3<Real> torque; ///< N m
  Real unused = 0;

  ForceRecord& operator+=(const ForceRecord& other) {
    force += other.force;
    pressed += other.pressed;
    torque += other.torque;
    return *this;
  }
};
static_assert(sizeof(ForceRecord<double>) == 64 && sizeof(ForceRecord<float>) == 32);

/// The motion of a rigid body about its centre of mass and principal axes, in rows of four numbers.
template <class Real>
struct BodyRecord {
  Vec3<double> position; ///< m, centre of mass
  double unused = 0.0;
  Quat<double> orientation;    ///< principal axes to space
  Vec3<Real> velocity;         ///< m/s, half a step behind the position
  Real mass = 0;               ///< kg
  Vec3<Real> angular_velocity; ///< rad/s, in the principal frame
  Real unused_too = 0;
  Vec3<Real> inertia; ///< kg m2, principal moments
  Real also_unused = 0;
};
static_assert(sizeof(BodyRecord<double>) == 160 && sizeof(BodyRecord<float>) == 112);

/// Where a member sphere of a body is.
struct MemberRecord {
  Vec3<double> offset; ///< m, from the centre of mass, in the principal frame
  double unused = 0.0;
};

} // namespace scree
