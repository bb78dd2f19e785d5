#pragma once
/// \file
/// The closed form of a sphere that bounces on a spring and a dashpot.

#include "scree/core/error.hpp"

#include <boost/math/tools/toms748_solve.hpp>

#include <cmath>
#include <cstdint>
#include <numbers>

namespace validation {

/// A sphere on a plane that holds it by a spring and a dashpot under gravity, from where it touches until
/// spring and dashpot would pull.
struct BounceInTheory {
  double g, frequency, decay, speed; ///< m/s2, rad/s and 1/s of the free oscillator, m/s down at the start

  /// m, above where the sphere touches.
  [[nodiscard]] double height(double t) const {
    const double damped = std::sqrt(frequency * frequency - decay * decay),
                 rest = g / (frequency * frequency);
    return std::exp(-decay * t) *
               (rest * std::cos(damped * t) + (decay * rest - speed) / damped * std::sin(damped * t)) -
           rest;
  }
  [[nodiscard]] double velocity(double t) const {
    const double h = 1e-5 / frequency;
    return (height(t + h) - height(t - h)) / (2.0 * h);
  }
  /// s, until the plane's force ends.
  [[nodiscard]] double duration() const {
    const auto force = [this](double t) {
      return -frequency * frequency * height(t) - 2.0 * decay * velocity(t);
    };
    // The weight makes it positive again later.
    const double start = lowest(), stride = 0.02 / frequency;
    double end = start + stride;
    while (force(end) > 0.0) {
      end += stride;
      if (end > start + 10.0 / frequency) {
        throw scree::Error("the sphere does not leave the plane");
      }
    }
    return root(force, start, end);
  }
  /// m, to which it flies up from there.
  [[nodiscard]] double top() const {
    const double t = duration(), v = velocity(t);
    return height(t) + v * v / (2.0 * g);
  }
  /// s, until it is lowest.
  [[nodiscard]] double lowest() const {
    const double half = std::numbers::pi / std::sqrt(frequency * frequency - decay * decay);
    return root([this](double t) { return velocity(t); }, 1e-3 * half, half);
  }

private:
  template <class F>
  static double root(F f, double low, double high) {
    std::uintmax_t most = 200;
    const auto [a, b] =
        boost::math::tools::toms748_solve(f, low, high, boost::math::tools::eps_tolerance<double>(50), most);
    return 0.5 * (a + b);
  }
};

} // namespace validation
