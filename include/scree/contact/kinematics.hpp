#pragma once
/// \file
/// What a contact law is given and what it returns.

#include "scree/core/numeric.hpp"
#include "scree/core/vec3.hpp"
#include "scree/material/pair.hpp"

namespace scree {

/// A touching pair i, j at one step, over a number type that may be a pack. A wall is a partner of infinite
/// radius and mass.
template <class T>
struct Kinematics {
  Vec3<T> normal;   ///< unit vector from j to i
  T overlap;        ///< m, above 0
  Vec3<T> velocity; ///< m/s, of i relative to j at the contact point
  Vec3<T> spin_i;   ///< rad/s, angular velocity of i in space
  Vec3<T> spin_j;   ///< rad/s
  Vec3<T> turn;     ///< rad, by which the contact has turned since the history was last written
  T reduced_radius; ///< m, r_i r_j / (r_i + r_j)
  T reduced_mass;   ///< kg, m_i m_j / (m_i + m_j)
  T root_mass;      ///< sqrt(kg), its square root
  T dt;             ///< s, since the history was last written
};

/// What j does to i; i does the opposite to j.
template <class T>
struct ContactForce {
  T normal{};          ///< N, along the normal, repulsive above 0
  Vec3<T> tangential;  ///< N
  Vec3<T> couple;      ///< N m, beside the moment of the force about the centres
  T frictional_work{}; ///< J, dissipated by sliding in this step
  T viscous_work{};    ///< J, dissipated by dashpots in this step
};

/// The stiffest that a contact can become, for the stable time step.
struct ContactStiffness {
  double normal = 0.0; ///< N/m
  double shear = 0.0;  ///< N/m
};

} // namespace scree
