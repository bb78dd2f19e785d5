#pragma once
/// \file
/// One body turned by an integrator, in the types that tests are written in.

#include "scree/core/linear.hpp"
#include "scree/state/wall_motion.hpp"

namespace scree::test {

template <class Integrator>
void rotate(Quaternion& orientation, Vector& angular_velocity, const Vector& moment, const Vector& inertia,
            const TimeStep& step) {
  Quat<double> q = to_quat(orientation);
  Vec3<double> w = to_vec3(angular_velocity);
  Integrator::rotate(q, w, to_vec3(moment), to_vec3(inertia), step);
  orientation = to_eigen(q);
  angular_velocity = to_eigen(w);
}

} // namespace scree::test
