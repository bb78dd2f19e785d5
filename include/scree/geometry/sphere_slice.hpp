#pragma once
/// \file
/// Area and moments of a plane cut through overlapping spheres, in closed form.

#include "scree/geometry/sphere.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

namespace scree {

/// Area and moments of a plane figure about the origin:
/// the integrals of 1 [m2], x, y [m3], xx, xy, yy [m4].
using PlaneMoments = Eigen::Array<double, 6, 1>;

namespace detail {

/// What the arc from angle `a` to `b` of a circle about (cx, cy) adds to the moments of the figure it bounds.
/// By Green's theorem an area integral is a line integral over the boundary with outward normal n: x nx ds
/// gives the area, x^2 nx / 2 ds the first and x^3 nx / 3 ds the second moment, likewise in y, and
/// x^2 y nx / 2 ds the mixed one. On a circle these are polynomials in cosine and sine.
inline PlaneMoments arc_moments(double cx, double cy, double radius, double a, double b) {
  const double sa = std::sin(a), ca = std::cos(a), sb = std::sin(b), cb = std::cos(b);
  // Integrals of cos^m sin^n over the arc, named c<m>s<n>.
  const double c1 = sb - sa;
  const double s1 = ca - cb;
  const double c2 = 0.5 * ((b - a) + (sb * cb - sa * ca));
  const double s2 = (b - a) - c2;
  const double c1s1 = 0.5 * (sb * sb - sa * sa);
  const double c2s1 = (ca * ca * ca - cb * cb * cb) / 3.0;
  const double c3 = c1 - (sb * sb * sb - sa * sa * sa) / 3.0;
  const double s3 = s1 - c2s1;
  const double c3s1 = 0.25 * (ca * ca * ca * ca - cb * cb * cb * cb);
  const double c4 = 0.75 * c2 + 0.25 * (cb * cb * cb * sb - ca * ca * ca * sa);
  const double s4 = 0.75 * s2 - 0.25 * (sb * sb * sb * cb - sa * sa * sa * ca);

  const double r = radius;
  const double x2 = cx * cx * c1 + 2.0 * cx * r * c2 + r * r * c3; // integral of x^2 nx
  const double y2 = cy * cy * s1 + 2.0 * cy * r * s2 + r * r * s3; // integral of y^2 ny
  const double x2s = cx * cx * c1s1 + 2.0 * cx * r * c2s1 + r * r * c3s1;
  const double x3 = cx * cx * cx * c1 + 3.0 * cx * cx * r * c2 + 3.0 * cx * r * r * c3 + r * r * r * c4;
  const double y3 = cy * cy * cy * s1 + 3.0 * cy * cy * r * s2 + 3.0 * cy * r * r * s3 + r * r * r * s4;

  PlaneMoments moments;
  moments << r * (cx * c1 + r * c2), 0.5 * r * x2, 0.5 * r * y2, r * x3 / 3.0, 0.5 * r * (cy * x2 + r * x2s),
      r * y3 / 3.0;
  return moments;
}

} // namespace detail

/// Moments of the cut of the plane z = `height` [m] through the union of the spheres.
///
/// The cut is a union of discs, and its boundary consists of the arcs of each circle that no other disc
/// covers. The covered arcs are known in closed form, so the result is exact to rounding. No two discs may be
/// the same.
inline PlaneMoments slice_moments(std::span<const Sphere> spheres, double height) {
  constexpr double pi = std::numbers::pi;
  const auto squared_disc_radius = [height](const Sphere& s) {
    const double above = std::abs(height - s.centre.z());
    return (s.radius - above) * (s.radius + above);
  };

  PlaneMoments sum = PlaneMoments::Zero();
  std::vector<std::pair<double, double>> covered; // angles in [-pi, pi]
  for (const Sphere& a : spheres) {
    const double squared_radius = squared_disc_radius(a);
    if (!(squared_radius > 0.0)) {
      continue;
    }
    const double radius = std::sqrt(squared_radius);
    covered.clear();
    for (const Sphere& b : spheres) {
      if (&a == &b || !(squared_disc_radius(b) > 0.0)) {
        continue;
      }
      const double dx = b.centre.x() - a.centre.x();
      const double dy = b.centre.y() - a.centre.y();
      const double distance = std::hypot(dx, dy);
      // Disc b covers the points of circle a whose angle from the line of centres has a cosine above p / q.
      // The difference of the squared disc radii is taken from the spheres, free of cancellation: the
      // covering of a by b and of b by a must agree also when the two are almost the same.
      const double difference = (a.radius - b.radius) * (a.radius + b.radius) -
                                (b.centre.z() - a.centre.z()) * (2.0 * height - a.centre.z() - b.centre.z());
      const double p = difference + distance * distance;
      const double q = 2.0 * radius * distance;
      if (p >= q) {
        continue;
      }
      if (p <= -q) {
        covered.assign(1, {-pi, pi});
        break;
      }
      const double half_width = std::acos(p / q);
      const double middle = std::atan2(dy, dx);
      const double from = middle - half_width;
      const double to = middle + half_width;
      covered.emplace_back(std::max(from, -pi), std::min(to, pi));
      if (from < -pi) {
        covered.emplace_back(from + 2.0 * pi, pi);
      }
      if (to > pi) {
        covered.emplace_back(-pi, to - 2.0 * pi);
      }
    }
    std::sort(covered.begin(), covered.end());
    covered.emplace_back(pi, pi); // closes the last exposed arc
    double exposed_from = -pi;
    for (const auto& [from, to] : covered) {
      if (from > exposed_from) {
        sum += detail::arc_moments(a.centre.x(), a.centre.y(), radius, exposed_from, from);
      }
      exposed_from = std::max(exposed_from, to);
    }
  }
  return sum;
}

} // namespace scree
