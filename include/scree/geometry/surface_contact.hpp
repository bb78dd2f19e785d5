#pragma once
/// \file
/// Where a sphere touches a surface.

#include "scree/core/linear.hpp"

#include <boost/container/small_vector.hpp>

namespace scree {

struct SurfaceContact {
  Vector normal;  ///< unit vector from the surface to the centre of the sphere
  double overlap; ///< m, above 0
  Vector point;   ///< m, of the surface, nearest to the centre
};

using SurfaceContacts = boost::container::small_vector<SurfaceContact, 8>;

} // namespace scree
