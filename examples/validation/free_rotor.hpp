#pragma once
/// \file
/// The exact motion of a free rigid body (Landau & Lifshitz, Mechanics, section 37).

#include "scree/core/error.hpp"
#include "scree/core/linear.hpp"

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/math/special_functions/jacobi_elliptic.hpp>

#include <cmath>

namespace validation {

/// A free body with principal moments I1 < I2 < I3 that starts without spin about its middle axis and turns
/// round its third, L^2 > 2 E I2: in Jacobi's elliptic functions. The z axis of space is along the angular
/// momentum.
class FreeRotor {
public:
  /// \param w1, w3 rad/s, spin about the first and the third axis at the start
  /// \throws scree::Error for a body that does not turn round its third axis.
  FreeRotor(const scree::Vector& inertia, double w1, double w3) : inertia_{inertia} {
    const double i1 = inertia[0], i2 = inertia[1], i3 = inertia[2];
    const double wobble = i1 * (i2 - i1) * w1 * w1, turn = i3 * (i3 - i2) * w3 * w3;
    if (!(turn > wobble)) {
      throw scree::Error("free rotor: the body does not turn round its third axis");
    }
    momentum_ = std::hypot(i1 * w1, i3 * w3);
    amplitude_ = {w1, w1 * std::sqrt(i1 * (i3 - i1) / (i2 * (i3 - i2))), w3};
    rate_ = w3 * std::sqrt((i3 - i2) * (i3 - i1) / (i1 * i2));
    modulus_ = std::sqrt(wobble / turn);
  }

  [[nodiscard]] const scree::Vector& inertia() const { return inertia_; }
  /// kg m2/s
  [[nodiscard]] scree::Vector momentum() const { return momentum_ * scree::Vector::UnitZ(); }

  /// rad/s, in the principal frame.
  [[nodiscard]] scree::Vector angular_velocity(double time) const {
    double cn = 0.0, dn = 0.0;
    const double sn = boost::math::jacobi_elliptic(modulus_, rate_ * time, &cn, &dn);
    return amplitude_.cwiseProduct(scree::Vector{cn, sn, dn});
  }

  /// Principal axes to space. Where L is in the body gives two of Euler's angles, an integral the third.
  [[nodiscard]] scree::Quaternion orientation(double time) const {
    const scree::Vector l = inertia_.cwiseProduct(angular_velocity(time)) / momentum_;
    return scree::Quaternion{Eigen::AngleAxisd{precession(time), scree::Vector::UnitZ()} *
                             Eigen::AngleAxisd{std::acos(l.z()), scree::Vector::UnitX()} *
                             Eigen::AngleAxisd{std::atan2(l.x(), l.y()), scree::Vector::UnitZ()}};
  }

private:
  [[nodiscard]] double precession(double time) const {
    const auto rate = [this](double t) {
      const scree::Vector w = angular_velocity(t), l = inertia_.cwiseProduct(w);
      return momentum_ * (w.x() * l.x() + w.y() * l.y()) / (l.x() * l.x() + l.y() * l.y());
    };
    // The precession of a rod is all but still, with a jerk twice in each turn of its wobble: narrow panels.
    const int parts = 1 + static_cast<int>(16.0 * rate_ * time);
    double angle = 0.0;
    for (int k = 0; k < parts; ++k) {
      angle += boost::math::quadrature::gauss_kronrod<double, 61>::integrate(rate, time * k / parts,
                                                                             time * (k + 1) / parts, 0);
    }
    return angle;
  }

  scree::Vector inertia_, amplitude_;
  double momentum_ = 0.0, rate_ = 0.0, modulus_ = 0.0;
};

} // namespace validation
