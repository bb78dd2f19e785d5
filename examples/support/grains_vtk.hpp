#pragma once
/// \file
/// Grains for ParaView.

#include "scree/core/linear.hpp"
#include "scree/io/vtk.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace scree::examples {

/// All member spheres.
template <class Bodies>
void write_grains(const std::filesystem::path& file, const Bodies& bodies) {
  std::vector<Vector> points, velocity;
  std::vector<double> radius;
  std::vector<std::uint32_t> body;
  for (std::size_t s = 0; s < bodies.sphere_count(); ++s) {
    const auto& sphere = bodies.spheres()[s];
    points.push_back(to_eigen(sphere.position));
    velocity.push_back(to_eigen(sphere.velocity));
    radius.push_back(sphere.radius);
    body.push_back(static_cast<std::uint32_t>(bodies.id(bodies.body_of(s))));
  }
  const std::vector<VtkArray> arrays{{"radius", std::span<const double>{radius}},
                                     {"velocity", std::span<const Vector>{velocity}},
                                     {"body", std::span<const std::uint32_t>{body}}};
  write_vtp_points(file, points, arrays);
}

} // namespace scree::examples
