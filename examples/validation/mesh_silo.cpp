/// \file
/// A bed of spheres in a cylindrical silo, and in prisms of triangles in its place.

#include "cases.hpp"
#include "mesh_beds.hpp"
#include "mesh_shapes.hpp"

#include "scree/measure/porosity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace validation {

namespace {

using namespace beds;

constexpr double silo_radius = 3.0 * diameter;

/// A tube with a flat bottom that is lowered; `sides` of a prism of the same cross-section in place of the
/// cylinder, or 0.
struct Silo : Bed {
  static constexpr double settled = 0.6, lowered = 0.12, speed = 0.025; // s, s, m/s

  Silo(int sides, std::size_t count, std::uint64_t seed, unsigned threads)
      : Bed{{.stiffness = scree::Stiffness::of_contact, .gravity = {0.0, 0.0, -g}, .threads = threads}} {
    const auto id = add_material(glass);
    const double height = 80.0 * diameter;
    const scree::Prescribed down{[](double time) {
      return scree::Pose{Vector{0.0, 0.0, -speed * std::max(0.0, time - settled)},
                         scree::Quaternion::Identity()};
    }};
    if (sides > 0) {
      const double angle = 2.0 * std::numbers::pi / sides;
      const double corner = silo_radius * std::sqrt(angle / std::sin(angle));
      add_wall({.name = "mantle",
                .surfaces = {{prism(corner, sides, -0.1 * height, height), id}},
                .dynamics = scree::Fixed{}});
      const auto bottom = plate(3.0 * silo_radius, 20, 0.3, scree::Quaternion::Identity());
      add_wall({.name = "bottom", .surfaces = {{bottom, id}}, .dynamics = down});
    } else {
      add_wall({.name = "mantle",
                .surfaces = {{scree::Cylinder{.radius = silo_radius}, id}},
                .dynamics = scree::Fixed{}});
      add_wall({.name = "bottom", .surfaces = {{scree::Plane{}, id}}, .dynamics = down});
    }
    const double half = 0.7 * silo_radius;
    pour(*this, count, {Vector{-half, -half, 0.1 * diameter}, Vector{half, half, height}}, seed);
  }

  void run_to(double time) {
    while (this->time() < time) {
      step();
    }
  }
};

} // namespace

/// Spheres settle in a tube, and its bottom is lowered so that they slide along the mantle: porosity, and how
/// much of the weight the mantle carries.
Outcome mesh_silo(const Inputs& inputs) {
  const std::size_t count = inputs.full ? 4000 : 500;
  Outcome out;
  std::array<std::array<std::vector<double>, 4>, 3> found; // by wall, of each quantity, over the seeds
  const std::array<int, 3> sides{0, 24, 96};
  double imbalance = 0.0; // the worst, of the walls' forces and the weight
  for (std::size_t w = 0; w < sides.size(); ++w) {
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      Silo silo{sides[w], count, seed, inputs.threads};
      const double total = weight(silo);
      silo.run_to(Silo::settled);
      double top = 0.0;
      for (std::size_t b = 0; b < silo.bodies().size(); ++b) {
        top = std::max(top, silo.bodies().position(b).z());
      }
      const double half = silo_radius / std::sqrt(2.0) - 0.5 * diameter;
      const Eigen::AlignedBox3d core{Vector{-half, -half, diameter}, Vector{half, half, 0.8 * top}};
      found[w][0].push_back(scree::porosity(silo.bodies(), core));
      found[w][1].push_back(top / diameter);
      // Means over the second half of the way of the bottom.
      silo.run_to(Silo::settled + 0.5 * Silo::lowered);
      const double since = silo.time(), on_mantle = silo.wall(0).load.impulse.z(),
                   on_bottom = silo.wall(1).load.impulse.z();
      silo.run_to(Silo::settled + Silo::lowered);
      const double whole = total * (silo.time() - since);
      const double mantle = (on_mantle - silo.wall(0).load.impulse.z()) / whole;
      const double bottom = (on_bottom - silo.wall(1).load.impulse.z()) / whole;
      found[w][2].push_back(bottom);
      found[w][3].push_back(mantle);
      imbalance = std::max(imbalance, std::abs(mantle + bottom - 1.0));
    }
  }
  for (std::size_t w = 1; w < sides.size(); ++w) {
    const std::string name = fmt::format("silo, prism of {} sides", sides[w]);
    add_means(out, name, "porosity of the core", "1", found[0][0], found[w][0]);
    add_means(out, name, "height of the highest centre over the diameter", "1", found[0][1], found[w][1]);
    add_means(out, name, "force on the lowered bottom over the weight", "1", found[0][2], found[w][2]);
    add_means(out, name, "friction on the mantle over the weight", "1", found[0][3], found[w][3]);
  }
  out.add("silo, all walls", "largest imbalance of wall forces and weight", "1", 0.0,
          {Origin::theory, "momentum of the bed"}, imbalance,
          {Silo::speed / (g * 0.5 * Silo::lowered), false,
           "the bed changes its momentum by at most that of the bottom's speed"});
  out.notes.push_back(
      "Silo: the prisms have the cross-section of the cylinder. No discharge, as a plane with a "
      "hole has no analytic counterpart here; the hopper has one. All inputs are ours.");
  return out;
}

} // namespace validation
