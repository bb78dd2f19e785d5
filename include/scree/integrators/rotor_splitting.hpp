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
  static void rotate(Quaternion& orientation, Vector& angular_velocity, const Vector& moment,
                     const Vector& inertia, const TimeStep& step) {
    Vector momentum = inertia.cwiseProduct(angular_velocity) + step.kick * moment;
    for (const auto& [axis, share] : {Turn{0, 0.5}, Turn{1, 0.5}, Turn{2, 1.0}, Turn{1, 0.5}, Turn{0, 0.5}}) {
      const double angle = share * step.dt * momentum[axis] / inertia[axis];
      const Quaternion turn{Eigen::AngleAxisd{angle, Vector::Unit(axis)}};
      orientation = orientation * turn;
      momentum = turn.conjugate() * momentum;
    }
    orientation.normalize();
    angular_velocity = momentum.cwiseQuotient(inertia);
  }

private:
  struct Turn {
    int axis;
    double share;
  };
};

} // namespace scree
