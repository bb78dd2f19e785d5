#include "scree/material/restitution.hpp"
#include "support/relative_error.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace scree;
using test::relative_error;

namespace {

/// Speed after an impact on the spring x^(power) with the dashpot 2 z x^((power - 1) / 2) c, in units in
/// which mass, stiffness and speed are 1: Runge-Kutta of fourth order until the force would pull.
double integrated(double z, double power, double c) {
  const auto pull = [&](double x, double v) {
    const double at = std::max(x, 0.0);
    return -std::pow(at, power) - 2.0 * z * c * std::pow(at, 0.5 * (power - 1.0)) * v;
  };
  const double h = 1e-4 / (1.0 + z);
  double x = 0.0, v = 1.0;
  for (int k = 0; k < 2 || pull(x, v) < 0.0; ++k) {
    const double a1 = pull(x, v), v2 = v + 0.5 * h * a1, a2 = pull(x + 0.5 * h * v, v2);
    const double v3 = v + 0.5 * h * a2, a3 = pull(x + 0.5 * h * v2, v3);
    const double v4 = v + h * a3, a4 = pull(x + h * v3, v4);
    x += h / 6.0 * (v + 2.0 * v2 + 2.0 * v3 + v4);
    v += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
  }
  return -v;
}

} // namespace

TEST_CASE("the restitution of a dashpot that never pulls is that of the equation of motion") {
  for (const double z : {0.0, 0.1, 0.4, 1.0 / std::numbers::sqrt2, 0.99, 1.0, 1.5, 3.0}) {
    CAPTURE(z);
    CHECK(relative_error(integrated(z, 1.0, 1.0), restitution(z)) < 1e-5);
    // Hertz: with S = 3/2 sqrt(x), c = 2 sqrt(5/6) z sqrt(S).
    CHECK(relative_error(integrated(z, 1.5, std::sqrt(5.0 / 6.0 * 1.5)), restitution(z)) < 1e-4);
  }
}

TEST_CASE("the restitution is that of Schwager & Poeschel") {
  // Granul. Matter 9:465 (2007), for damping below 1 / sqrt(2) of critical.
  for (const double z : {0.05, 0.3, 0.6}) {
    const double damped = std::sqrt(1.0 - z * z);
    const double e =
        std::exp(-z / damped * (std::numbers::pi - std::atan(2.0 * z * damped / (damped * damped - z * z))));
    CHECK(relative_error(restitution(z), e) < 1e-14);
  }
  CHECK(relative_error(restitution(1.0), std::exp(-2.0)) < 1e-14);
  CHECK(relative_error(restitution(1.0 - 1e-4), restitution(1.0)) < 1e-3);
}

TEST_CASE("the damping ratio gives back the restitution, over-critical where it must be") {
  CHECK(damping_ratio(1.0) == 0.0);
  double before = 0.0;
  for (const double e : {1.0 - 1e-9, 0.99, 0.9, 0.5, 0.2, 0.136, std::exp(-2.0), 0.135, 0.1, 0.01, 1e-6}) {
    CAPTURE(e);
    const double z = damping_ratio(e);
    CHECK(z > before);
    CHECK(relative_error(restitution(z), e) < 1e-12);
    before = z;
  }
  CHECK(relative_error(damping_ratio(1e-6), 500.0) < 0.01);
}

TEST_CASE("the series at critical damping joins both branches") {
  for (const double q : {9.99e-5, 1.001e-4, -9.99e-5, -1.001e-4}) {
    const double z = std::sqrt(1.0 - q), nearby = std::sqrt(1.0 - 0.999 * q);
    CHECK(std::abs(restitution(z) - restitution(nearby)) < 1e-7);
  }
}

TEST_CASE("the ratio in shear leaves the share of the speed after half an oscillation") {
  for (const double e : {1.0, 0.9, 0.5, 0.1, 1e-6}) {
    CAPTURE(e);
    const double z = half_oscillation_ratio(e);
    CHECK(z >= 0.0);
    CHECK(z < 1.0);
    CHECK(relative_error(std::exp(-std::numbers::pi * z / std::sqrt(1.0 - z * z)), e) < 1e-12);
  }
}
