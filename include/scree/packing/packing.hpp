#pragma once
/// \file
/// What every packing recipe produces: shapes, and bodies that have them.

#include "scree/core/error.hpp"
#include "scree/core/linear.hpp"
#include "scree/geometry/clump.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace scree {

/// A clump in place.
struct PackedBody {
  std::uint32_t shape = 0;                         ///< index into Packing::shapes
  double scale = 1.0;                              ///< of the shape's lengths, above 0
  Vector position = Vector::Zero();                ///< m, centre of mass
  Quaternion orientation = Quaternion::Identity(); ///< principal frame to space
  Vector velocity = Vector::Zero();                ///< m/s
  Vector angular_velocity = Vector::Zero();        ///< rad/s, in space coordinates
  std::uint16_t material = 0;                      ///< index into the materials of the simulation
  bool fixed = false;                              ///< held in place
};

/// Plain data, with no meaning beyond its fields; a recipe may be as simple as filling them by hand.
struct Packing {
  std::vector<Clump> shapes; ///< at unit scale
  std::vector<PackedBody> bodies;
};

/// The spheres of a body [m] in space.
/// \throws std::out_of_range if the body has no shape in the packing.
inline std::vector<Sphere> spheres_in_space(const Packing& packing, const PackedBody& body) {
  std::vector<Sphere> spheres = packing.shapes.at(body.shape).spheres;
  for (Sphere& s : spheres) {
    s.centre = body.position + body.orientation * (body.scale * s.centre);
    s.radius *= body.scale;
  }
  return spheres;
}

/// Volume [m3] that the bodies fill, of the union of each one's spheres whatever its mass convention. One
/// minus this over the bulk volume is the porosity.
inline double solid_volume(const Packing& packing) {
  double sum = 0.0;
  for (const PackedBody& b : packing.bodies) {
    sum += packing.shapes.at(b.shape).union_volume * b.scale * b.scale * b.scale;
  }
  return sum;
}

/// Mass [kg] of all bodies under the mass convention of their shapes.
/// \param densities density of each material [kg/m3], above 0
/// \throws Error for a density not above zero or a material without one.
inline double mass(const Packing& packing, std::span<const double> densities) {
  for (const double d : densities) {
    require_positive("density", d, "kg/m3");
  }
  double sum = 0.0;
  for (const PackedBody& b : packing.bodies) {
    if (b.material >= densities.size()) {
      throw Error(message("a body has material ", b.material, ", but only ", densities.size(),
                          " densities are given"));
    }
    sum += densities[b.material] * packing.shapes.at(b.shape).volume * b.scale * b.scale * b.scale;
  }
  return sum;
}

} // namespace scree
