#pragma once
/// \file
/// Principal moments and axes of an inertia tensor.

#include "scree/core/linear.hpp"

#include <Eigen/Eigenvalues>

#include <cmath>

namespace scree {

struct PrincipalAxes {
  Vector moments; ///< kg m2, ascending
  Matrix axes; ///< unit axes as columns, right-handed; its transpose takes a vector into the principal frame
};

/// Principal moments and axes of a symmetric inertia tensor [kg m2].
///
/// The axes are chosen so that rounding does not decide between equally good ones. Moments that differ by
/// less than 1e-10 of the largest count as equal and are replaced by their mean; among the axes of equal
/// moments those along the given coordinate axes are preferred. The first component of an axis that is not
/// negligible is positive, the sign of the last axis follows from the right hand.
inline PrincipalAxes principal_axes(const Matrix& inertia) {
  const Eigen::SelfAdjointEigenSolver<Matrix> solver{inertia};
  Vector moments = solver.eigenvalues();
  const auto axis = [&](Eigen::Index i) {
    Vector a = solver.eigenvectors().col(i);
    for (Eigen::Index k = 0; k < 3; ++k) {
      if (std::abs(a[k]) > 1e-6) {
        return Vector(a[k] > 0.0 ? a : -a);
      }
    }
    return a;
  };
  // Some coordinate axis at more than 53 degrees to the unit vector a, made perpendicular to it.
  const auto beside = [](const Vector& a) {
    Eigen::Index k = 0;
    while (std::abs(a[k]) >= 0.6) {
      ++k;
    }
    return Vector((Vector::Unit(k) - a[k] * a).normalized());
  };

  const double negligible = 1e-10 * moments[2];
  const bool lower_equal = moments[1] - moments[0] <= negligible;
  const bool upper_equal = moments[2] - moments[1] <= negligible;
  Matrix axes;
  if (lower_equal && upper_equal) {
    moments.setConstant(moments.mean());
    axes.setIdentity();
  } else if (lower_equal) {
    moments.head<2>().setConstant(moments.head<2>().mean());
    const Vector last = axis(2);
    const Vector first = beside(last);
    axes << first, last.cross(first), last;
  } else if (upper_equal) {
    moments.tail<2>().setConstant(moments.tail<2>().mean());
    const Vector first = axis(0);
    const Vector second = beside(first);
    axes << first, second, first.cross(second);
  } else {
    const Vector first = axis(0);
    const Vector second = axis(1);
    axes << first, second, first.cross(second);
  }
  return {moments, axes};
}

} // namespace scree
