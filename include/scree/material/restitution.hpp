#pragma once
/// \file
/// What restitution a dashpot gives, and which dashpot a restitution needs.

#include <boost/math/tools/toms748_solve.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace scree {

namespace detail {

/// -ln of `restitution(z)`.
inline double impact_loss(double z) {
  const double q = 1.0 - z * z;
  const double arc = std::abs(q) < 1e-4 ? 1.0 + q / 6.0 + 3.0 * q * q / 40.0 // both branches, near z = 1
                     : q > 0.0          ? std::acos(z) / std::sqrt(q)
                                        : std::acosh(z) / std::sqrt(-q);
  return 2.0 * z * arc;
}

} // namespace detail

/// Restitution of a free normal impact on a spring and a dashpot of `z` times the critical damping that
/// together never pull, so that the contact ends where its force does: exp(-2 z acos(z) / sqrt(1 - z^2)), and
/// exp(-2 z acosh(z) / sqrt(z^2 - 1)) for z > 1. It is Schwager & Poeschel's (Granul. Matter 9:465, 2007) in
/// shorter form. It holds for Hertz's spring too where the dashpot follows the fourth root of the overlap:
/// with u = U^(5/4) the speed obeys v dv/du = -2 z w v - w^2 u, the linear oscillator's equation, w^2 a
/// constant.
/// \param z 0 or above
inline double restitution(double z) {
  return std::exp(-detail::impact_loss(z));
}

/// The inverse of `restitution(z)`.
/// \param e in (0, 1]; below 0.14 the dashpot is over-critical, about 1 / (2 sqrt(e))
inline double damping_ratio(double e) {
  const double wanted = -std::log(e);
  if (!(wanted > 0.0)) {
    return 0.0;
  }
  // Not below 2 ln(2 z) for z >= 1, and that is 1.39 at z = 1.
  const double most = std::max(1.0, 0.5 * std::exp(0.5 * wanted));
  std::uintmax_t evaluations = 100;
  const auto [low, high] =
      boost::math::tools::toms748_solve([wanted](double z) { return detail::impact_loss(z) - wanted; }, 0.0,
                                        most, boost::math::tools::eps_tolerance<double>(50), evaluations);
  return 0.5 * (low + high);
}

/// Damping ratio of a spring and dashpot that leave the share `e` of the speed after half an oscillation,
/// -ln e / sqrt(pi^2 + ln^2 e). So it is in shear, where contact does not end with the force.
/// \param e in (0, 1]
inline double half_oscillation_ratio(double e) {
  const double l = std::log(e);
  return -l / std::sqrt(std::numbers::pi * std::numbers::pi + l * l);
}

} // namespace scree
