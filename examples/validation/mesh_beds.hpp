#pragma once
/// \file
/// What the beds between meshes and between analytic walls share.

#include "ball_bed.hpp"
#include "impact.hpp"
#include "scatter.hpp"

#include "scree/contact/linear_spring.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace validation::beds {

using scree::Vector;
using Bed = scree::Simulation<With<scree::LinearSpring<>>>;

// All numbers of these cases are ours.
constexpr double diameter = 5e-3, density = 2500.0, g = 9.81; // m, kg/m3, m/s2
constexpr std::size_t seeds = 6;

inline const scree::Material glass{.density = density,
                                   .normal_stiffness = 2e3,
                                   .shear_stiffness = 1.6e3,
                                   .friction = 0.4,
                                   .restitution = 0.7};

/// Adds the means of one quantity over the seeds, on a mesh beside the analytic wall.
inline void add_means(Outcome& out, const std::string& name, const std::string& quantity,
                      const std::string& unit, const std::vector<double>& analytic,
                      const std::vector<double>& mesh) {
  const Mean a{analytic}, m{mesh};
  out.add(name, quantity, unit, a.value, {Origin::code, "the same with analytic walls, mean of 6 seeds"},
          m.value,
          {margin_of_difference(a, m, 0.999), false,
           "standard error of the difference of two means of 6 seeds, times Student's t at 99.9 %"});
}

/// Adds spheres of 0.8 to 1.2 diameters on a loose lattice over `footprint`.
inline void pour(Bed& bed, std::size_t count, const Eigen::AlignedBox3d& footprint, std::uint64_t seed) {
  scree::Random random{seed, "bed between meshes"};
  scree::Packing packing = loose_balls({.diameter = diameter, .spread = 0.2}, count, footprint, random);
  for (auto& body : packing.bodies) {
    body.velocity = {random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), -0.3};
  }
  bed.add(packing);
}

inline double weight(const Bed& bed) {
  double sum = 0.0;
  for (std::size_t b = 0; b < bed.bodies().size(); ++b) {
    sum += g * bed.bodies().mass(b);
  }
  return sum;
}

/// m, between the same spheres of two beds: the most over all.
inline double apart(const Bed& a, const Bed& b) {
  std::vector<Vector> at(a.bodies().size());
  for (std::size_t k = 0; k < at.size(); ++k) {
    at.at(a.bodies().id(k)) = a.bodies().position(k);
  }
  double most = 0.0;
  for (std::size_t k = 0; k < at.size(); ++k) {
    most = std::max(most, (at.at(b.bodies().id(k)) - b.bodies().position(k)).norm());
  }
  return most;
}

} // namespace validation::beds
