#pragma once
/// \file
/// The four particle shapes of Coetzee, Els & Dymond (2010), Sec. 4.1, and the dimensions of a clump.
///
/// The paper says how many spheres each shape has and bounds its ratios of length, width and height; radii
/// and distances are not in the paper and are ours. The spheres have a diameter of 1 m (unit scale). A shape
/// of your own is any list of spheres given to make_clump().

#include "scree/geometry/clump.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

namespace scree {

/// Shape 1, long: three spheres on a line 0.6 diameters apart. Length / width 2.2 (paper: above 2).
inline std::vector<Sphere> aligned_spheres() {
  return {{{-0.6, 0.0, 0.0}, 0.5}, {{0.0, 0.0, 0.0}, 0.5}, {{0.6, 0.0, 0.0}, 0.5}};
}

/// Shape 2, pyramid: four spheres on the corners of a regular tetrahedron with edges of 0.7 diameters.
inline std::vector<Sphere> pyramid_of_spheres() {
  const double a = 0.7 / std::sqrt(8.0); // half the edge of the cube that holds the tetrahedron
  return {{{a, a, a}, 0.5}, {{a, -a, -a}, 0.5}, {{-a, a, -a}, 0.5}, {{-a, -a, a}, 0.5}};
}

/// Shape 3, flat: four spheres on the corners of a rhombus with diagonals of 1.3 and 0.9 diameters.
/// Length / width 1.21 (paper: below 2), length / height 2.3 (paper: above 2).
inline std::vector<Sphere> flat_of_spheres() {
  return {
      {{-0.65, 0.0, 0.0}, 0.5}, {{0.65, 0.0, 0.0}, 0.5}, {{0.0, -0.45, 0.0}, 0.5}, {{0.0, 0.45, 0.0}, 0.5}};
}

/// Shape 4: one sphere.
inline std::vector<Sphere> single_sphere() {
  return {{{0.0, 0.0, 0.0}, 0.5}};
}

/// The paper's four shapes, in its order, as clumps at unit scale.
inline std::vector<Clump> paper_shapes(MassConvention convention = MassConvention::union_of_spheres) {
  return {make_clump("aligned", aligned_spheres(), convention),
          make_clump("pyramid", pyramid_of_spheres(), convention),
          make_clump("flat", flat_of_spheres(), convention),
          make_clump("sphere", single_sphere(), convention)};
}

/// Length, width and height [m]: the bounding dimensions along the principal axes of inertia, descending.
inline Vector principal_extents(const Clump& clump) {
  Vector least = Vector::Constant(std::numeric_limits<double>::infinity());
  Vector most = -least;
  for (const Sphere& s : clump.spheres) {
    least = least.cwiseMin((s.centre.array() - s.radius).matrix());
    most = most.cwiseMax((s.centre.array() + s.radius).matrix());
  }
  Vector extents = most - least;
  std::sort(extents.begin(), extents.end(), std::greater<>{});
  return extents;
}

/// The opening [m] of the smallest square sieve that the clump passes lengthways: its width, the middle one
/// of the principal extents. This definition is ours; the paper does not say how it gave a clump its size.
inline double sieve_size(const Clump& clump) {
  return principal_extents(clump).y();
}

} // namespace scree
