#pragma once
/// \file
/// A clump: overlapping spheres that move as one rigid body.

#include "scree/core/error.hpp"
#include "scree/geometry/mass_properties.hpp"
#include "scree/geometry/principal_axes.hpp"
#include "scree/geometry/sphere_union.hpp"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace scree {

/// What counts as the material of a clump. It decides mass, centre of mass and inertia, and with them the
/// bulk density: of crushed rock modelled by strongly overlapping spheres the two differ by tens of per cent.
enum class MassConvention {
  union_of_spheres, ///< the solid that the spheres fill together
  sum_of_spheres,   ///< every sphere whole, overlaps counted as often as they occur; older clump codes
};

inline std::string_view to_string(MassConvention convention) {
  return convention == MassConvention::union_of_spheres ? "union_of_spheres" : "sum_of_spheres";
}

/// The convention of that name, as to_string() writes it.
/// \throws Error for any other name.
inline MassConvention parse_mass_convention(std::string_view name) {
  for (const auto convention : {MassConvention::union_of_spheres, MassConvention::sum_of_spheres}) {
    if (name == to_string(convention)) {
      return convention;
    }
  }
  throw Error(message("mass convention \"", name, "\" is neither union_of_spheres nor sum_of_spheres"));
}

/// The shape of a clump, in its principal frame: origin at the centre of mass, axes along the principal axes
/// with ascending moments, so that x is the axis of an elongated clump.
struct Clump {
  std::string name;
  std::vector<Sphere> spheres;     ///< m, in the principal frame
  double volume = 0.0;             ///< m3 under `convention`; mass = density * volume
  Vector inertia = Vector::Zero(); ///< m5, principal moments for unit density
  MassConvention convention = MassConvention::union_of_spheres;
  double union_volume = 0.0;    ///< m3 that the clump fills whatever the convention; for porosity
  double bounding_radius = 0.0; ///< m, of the sphere about the centre of mass that holds the clump
  /// How much more easily the softest point of the surface gives way to a force than the centre of mass: the
  /// largest 1 + m (p x u)^T I^-1 (p x u) over points p and directions u; 3.5 for a sphere. For the stable
  /// time step.
  double mobility = 1.0;
};

namespace detail {

/// The largest of `Clump::mobility` over a fixed set of points on each sphere, with a margin for those
/// between.
inline double surface_mobility(const Clump& clump) {
  const Matrix resistance = (clump.volume * clump.inertia.cwiseInverse()).asDiagonal();
  const auto rotational = [&](const Vector& p) {
    Matrix lever;
    lever << 0.0, -p.z(), p.y(), p.z(), 0.0, -p.x(), -p.y(), p.x(), 0.0;
    const Matrix along = lever.transpose() * resistance * lever;
    return Eigen::SelfAdjointEigenSolver<Matrix>{along, Eigen::EigenvaluesOnly}.eigenvalues().maxCoeff();
  };
  const bool lone = clump.spheres.size() == 1 && clump.spheres[0].centre.isZero(0.0);
  double most = 0.0;
  for (const Sphere& sphere : clump.spheres) {
    constexpr int points = 64; // a Fibonacci spiral
    for (int k = 0; k < points; ++k) {
      const double z = 1.0 - (2.0 * k + 1.0) / points;
      const double angle = k * std::numbers::pi * (3.0 - std::sqrt(5.0));
      const double rho = std::sqrt(1.0 - z * z);
      const Vector n{rho * std::cos(angle), rho * std::sin(angle), z};
      most = std::max(most, rotational(sphere.centre + sphere.radius * n));
    }
  }
  return 1.0 + most * (lone ? 1.0 : 1.05);
}

} // namespace detail

/// The clump of the given spheres [m], whose frame is free. Mass and frame follow from `convention`.
/// \throws Error for an empty list, a radius that is not above zero, or a number that is not finite.
inline Clump make_clump(std::string name, std::span<const Sphere> spheres,
                        MassConvention convention = MassConvention::union_of_spheres) {
  const MassProperties united = union_properties(spheres);
  const MassProperties properties =
      convention == MassConvention::union_of_spheres ? united : sum_of_spheres_properties(spheres);
  const PrincipalAxes principal = principal_axes(properties.inertia);

  Clump clump;
  clump.name = std::move(name);
  clump.volume = properties.mass;
  clump.inertia = principal.moments;
  clump.convention = convention;
  clump.union_volume = united.mass;
  for (const Sphere& s : spheres) {
    const Vector centre = principal.axes.transpose() * (s.centre - properties.centre);
    clump.spheres.push_back({centre, s.radius});
    clump.bounding_radius = std::max(clump.bounding_radius, centre.norm() + s.radius);
  }
  clump.mobility = detail::surface_mobility(clump);
  return clump;
}

/// The clump with all lengths multiplied by `factor`.
/// \throws Error unless `factor` is finite and above zero.
inline Clump scaled(const Clump& clump, double factor) {
  require_positive("scale of a clump", factor);
  const double cube = factor * factor * factor;
  Clump result = clump;
  for (Sphere& s : result.spheres) {
    s.centre *= factor;
    s.radius *= factor;
  }
  result.volume *= cube;
  result.inertia *= cube * factor * factor;
  result.union_volume *= cube;
  result.bounding_radius *= factor;
  return result;
}

} // namespace scree
