/// \file
/// A wedge-shaped hopper of planes and one of the same planes as triangle meshes are filled and run out.

#include "cases.hpp"
#include "mesh_beds.hpp"
#include "mesh_shapes.hpp"

#include "scree/measure/porosity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace validation {

namespace {

using namespace beds;

constexpr double slope_angle = 60.0 * std::numbers::pi / 180.0; // of the inclined walls from the horizontal
constexpr double outlet = 5.0 * diameter, breadth = 6.0 * diameter;

/// A wedge between two inclined and two upright walls, with a gate at z = 0 where it is an outlet wide.
struct Hopper : Bed {
  static constexpr double opens = 0.6; // s

  Hopper(bool mesh, std::size_t count, std::uint64_t seed, unsigned threads)
      : Bed{{.stiffness = scree::Stiffness::of_contact,
             .gravity = {0.0, 0.0, -g},
             .threads = threads,
             // Both beds keep the order of their spheres, so that they can be told apart by rounding only.
             .sort_interval = 0}} {
    const auto id = add_material(glass);
    const Vector up = Vector::UnitZ();
    for (const double side : {-1.0, 1.0}) {
      const Vector inward{-side * std::sin(slope_angle), 0.0, std::cos(slope_angle)};
      const Vector across{0.0, -side, 0.0};
      add_flat(mesh, Vector{side * 0.5 * outlet, 0.0, 0.0}, inward, id, scree::Fixed{});
      add_flat(mesh, Vector{0.0, side * 0.5 * breadth, 0.0}, across, id, scree::Fixed{});
    }
    // The gate falls out of the way in one step.
    add_flat(mesh, Vector::Zero(), up, id, scree::Prescribed{[](double time) {
               return scree::Pose{Vector{0.0, 0.0, time < opens ? 0.0 : -1.0}, scree::Quaternion::Identity()};
             }});
    const double base = 4.0 * diameter, half = 0.5 * outlet + base / std::tan(slope_angle);
    pour(*this, count, {Vector{-half, -0.5 * breadth, base}, Vector{half, 0.5 * breadth, 1.0}}, seed);
  }

private:
  template <class Dynamics>
  void add_flat(bool mesh, const Vector& point, const Vector& normal, scree::MaterialId id,
                const Dynamics& dynamics) {
    if (!mesh) {
      add_wall({.name = "plane", .surfaces = {{scree::Plane{point, normal}, id}}, .dynamics = dynamics});
      return;
    }
    scree::TriangleMesh flat =
        plate(0.9, 60, 0.3, scree::Quaternion::FromTwoVectors(Vector::UnitZ(), normal));
    for (Vector& v : flat.vertices) {
      v += point;
    }
    add_wall({.name = "mesh", .surfaces = {{flat, id}}, .dynamics = dynamics});
  }
};

/// kg/s between the times at which 20 and 70 % of the mass have left, and those masses over time.
double discharge(Hopper& hopper, Series& curve) {
  const double all = weight(hopper) / g;
  double out = 0.0, from = 0.0, to = 0.0, at_from = 0.0;
  while (out < 0.7 * all && hopper.time() < Hopper::opens + 3.0) {
    hopper.step();
    const double before = out;
    hopper.remove_bodies([&](const auto& bodies, std::size_t b) {
      const bool gone = bodies.position(b).z() < -0.5 * diameter;
      out += gone ? bodies.mass(b) : 0.0;
      return gone;
    });
    if (out > before) {
      curve.x.push_back(hopper.time() - Hopper::opens);
      curve.y.push_back(out / all);
      if (from == 0.0 && out > 0.2 * all) {
        from = hopper.time();
        at_from = out;
      }
      to = hopper.time();
    }
  }
  return (out - at_from) / (to - from);
}

} // namespace

/// Spheres fall into a wedge-shaped hopper, settle and run out of its slot.
Outcome mesh_hopper(const Inputs& inputs) {
  constexpr double meets_gate = 0.04; // s: 4 diameters from 0.3 m/s, in free fall
  const std::size_t count = inputs.full ? 4000 : 500;
  const std::string name = "hopper of flat walls";
  Outcome out;
  Chart curves{"mesh_hopper", name, "time since the gate opened, s", "share of the mass that is out", {}, {}};
  Series parting{"planes to meshes, farthest of the spheres, seed 1", Origin::code, {}, {}};
  std::array<std::array<std::vector<double>, 3>, 2>
      found; // by kind of wall, of each quantity, over the seeds
  double early = 0.0;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    Hopper planes{false, count, seed, inputs.threads}, meshes{true, count, seed, inputs.threads};
    while (planes.time() < Hopper::opens - 1e-3) {
      planes.step();
      meshes.step();
      if (planes.time() < meets_gate) {
        early = std::max(early, apart(planes, meshes));
      }
      if (seed == 1 && planes.steps() % 100 == 0 && planes.time() < 0.2) {
        parting.x.push_back(planes.time());
        parting.y.push_back(std::log10(apart(planes, meshes) / diameter));
      }
    }
    std::size_t w = 0;
    for (Hopper* hopper : {&planes, &meshes}) {
      const Eigen::AlignedBox3d core{Vector{-0.4 * outlet, -0.5 * breadth + diameter, diameter},
                                     Vector{0.4 * outlet, 0.5 * breadth - diameter, 6.0 * diameter}};
      found[w][0].push_back(scree::porosity(hopper->bodies(), core));
      found[w][1].push_back(-hopper->wall(4).load.force.z() / weight(*hopper));
      Series curve{w == 0 ? "planes" : "meshes", Origin::code, {}, {}};
      found[w][2].push_back(discharge(*hopper, curve));
      if (seed == 1) {
        curves.simulated.push_back(std::move(curve));
      }
      ++w;
    }
  }
  out.add(
      name, "largest distance of the same sphere until the bed meets the gate", "m", 0.0,
      {Origin::theory, "the same planes, analytic"}, early,
      {1e4 * 0.5 * std::numeric_limits<double>::epsilon(), false,
       "rounding of corners 0.5 m away, 2^-53 m; 1e4 for its growth over some four impacts of each sphere "
       "(ours)"});
  add_means(out, name, "porosity over the gate", "1", found[0][0], found[1][0]);
  add_means(out, name, "force on the gate over the weight", "1", found[0][1], found[1][1]);
  add_means(out, name, "discharge", "kg/s", found[0][2], found[1][2]);
  out.draw(curves);
  out.draw({"mesh_parting",
            name + ": planes and meshes",
            "time, s",
            "log10 (distance / diameter)",
            {},
            {parting}});
  out.notes.push_back(
      "Hopper of flat walls: impacts multiply rounding until the beds are different ones, after "
      "some 0.1 s; from then on only means are compared. All inputs are ours.");
  return out;
}

} // namespace validation
