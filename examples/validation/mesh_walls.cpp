/// \file
/// A wall of triangles does as the analytic wall: grains dropped on a plane, and a sphere that slides and
/// rolls over it.

#include "cases.hpp"
#include "impact.hpp"
#include "mesh_shapes.hpp"

#include "scree/contact/linear_spring.hpp"

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

using scree::Vector;

constexpr double radius = 0.01; // m, of the spheres; ours, as all inputs of these cases

scree::Material stone(double stiffness, double friction, double restitution) {
  return {.density = 2500.0,
          .normal_stiffness = stiffness,
          .shear_stiffness = 0.8 * stiffness,
          .friction = friction,
          .restitution = restitution};
}

/// By 20 degrees, so that no coordinate of a facet is a round number.
scree::Quaternion incline() {
  return scree::Quaternion{Eigen::AngleAxisd{0.35, Vector{0.6, 0.8, 0.0}}};
}

struct Tessellation {
  const char* name;
  int cells;
  double jitter;
};

constexpr double side = 0.8; // m, of the plate

/// Two facets, and facets wider and narrower than a sphere.
constexpr std::array<Tessellation, 3> tessellations{
    {{"2 facets", 1, 0.0}, {"facets of 5 r", 17, 0.3}, {"facets of 0.8 r", 101, 0.3}}};

scree::TriangleMesh plate_of(const Tessellation& t) {
  return plate(side, t.cells, t.jitter, incline());
}

/// One body over an inclined plane.
struct Start {
  const scree::Clump* clump;
  Vector position, velocity, spin; ///< m, m/s, rad/s
};

/// That body on the plane, or on `mesh` in its place.
struct Track : scree::Simulation<With<scree::LinearSpring<>>> {
  Track(const Start& start, const scree::Material& material, const scree::TriangleMesh* mesh)
      : Simulation{{.stiffness = scree::Stiffness::of_contact, .time_step = 1e-5}} {
    const auto id = add_material(material);
    add({.clump = start.clump,
         .material = id,
         .position = start.position,
         .orientation = scree::Quaternion{Eigen::AngleAxisd{0.7, Vector{1.0, 2.0, 2.0} / 3.0}},
         .velocity = start.velocity,
         .angular_velocity = start.spin});
    const scree::Plane plane{Vector::Zero(), incline() * Vector::UnitZ()};
    const auto surface = mesh != nullptr ? scree::WallSurface{*mesh, id} : scree::WallSurface{plane, id};
    add_wall({.name = "wall", .surfaces = {surface}, .dynamics = scree::Fixed{}});
  }
};

/// N, of all contacts of the body.
struct Felt {
  std::size_t contacts = 0;
  double normal = 0.0;
  Vector tangential = Vector::Zero();
};

Felt felt(const Track& sim) {
  Felt sum;
  sim.visit_contacts([&](const scree::ContactView& c) {
    ++sum.contacts;
    sum.normal += c.force.dot(c.normal);
    sum.tangential += c.force - c.force.dot(c.normal) * c.normal;
  });
  return sum;
}

/// The largest differences between two runs, each over the greatest value so far.
struct Difference {
  double path = 0.0, velocity = 0.0, spin = 0.0, normal = 0.0, tangential = 0.0;
  std::size_t other_contacts = 0; ///< steps in which the numbers of contacts differ

  void widen(const Difference& other) {
    path = std::max(path, other.path);
    velocity = std::max(velocity, other.velocity);
    spin = std::max(spin, other.spin);
    normal = std::max(normal, other.normal);
    tangential = std::max(tangential, other.tangential);
    other_contacts += other.other_contacts;
  }
};

/// Steps both for `duration` [s].
Difference compare(Track& a, Track& b, double duration) {
  Difference worst;
  const Vector from = a.bodies().position(0);
  double way = radius, speed = 0.0, spin = 0.0, normal = 0.0, tangential = 0.0;
  while (a.time() < duration) {
    a.step();
    b.step();
    const auto &p = a.bodies(), &q = b.bodies();
    way = std::max(way, (p.position(0) - from).norm());
    speed = std::max(speed, p.velocity(0).norm());
    spin = std::max({spin, p.angular_velocity(0).norm(), speed / radius});
    worst.path = std::max(worst.path, (p.position(0) - q.position(0)).norm() / way);
    worst.velocity = std::max(worst.velocity, (p.velocity(0) - q.velocity(0)).norm() / speed);
    worst.spin = std::max(worst.spin, (p.angular_velocity(0) - q.angular_velocity(0)).norm() / spin);
    const Felt fa = felt(a), fb = felt(b);
    normal = std::max(normal, fa.normal);
    tangential = std::max(tangential, fa.tangential.norm());
    if (normal > 0.0) {
      worst.normal = std::max(worst.normal, std::abs(fa.normal - fb.normal) / normal);
    }
    if (tangential > 0.0) {
      worst.tangential = std::max(worst.tangential, (fa.tangential - fb.tangential).norm() / tangential);
    }
    worst.other_contacts += fa.contacts != fb.contacts ? 1 : 0;
  }
  return worst;
}

/// Of forces that push up to `overlap` [m] deep, after `bounces` with some `flight` [m] between them.
Tolerance of_rounding(double overlap, double flight = 0.0, int bounces = 0) {
  const double growth = bounces > 0 ? std::pow(flight / overlap, bounces) : 100.0;
  return {growth * std::numeric_limits<double>::epsilon() * side / overlap, false,
          bounces > 0
              ? "rounding of the corners, 2^-52 of the plate's side, over the overlap, times flight over "
                "overlap for each of two bounces"
              : "rounding of the corners, 2^-52 of the plate's side, over the overlap; 100 for its "
                "growth over the steps (ours)"};
}

void report(Outcome& out, const std::string& name, const Difference& d, const Tolerance& tolerance) {
  const Source exact{Origin::theory, "the same plane, analytic"};
  out.add(name, "largest difference in path, over its length", "1", 0.0, exact, d.path, tolerance);
  out.add(name, "in velocity, over the greatest", "1", 0.0, exact, d.velocity, tolerance);
  out.add(name, "in spin, over the greatest", "1", 0.0, exact, d.spin, tolerance);
  out.add(name, "in normal force, over the greatest", "1", 0.0, exact, d.normal, tolerance);
  out.add(name, "in tangential force, over the greatest", "1", 0.0, exact, d.tangential, tolerance);
  out.add(name, "steps with another number of contacts", "1", 0.0, exact,
          static_cast<double>(d.other_contacts), {0.5, false, "none"});
}

} // namespace

/// Spheres and clumps fall on a plane and on the same plane as a mesh, over faces, edges and vertices, and
/// bounce down the slope.
Outcome mesh_drop(const Inputs& /*inputs*/) {
  constexpr double speed = 1.0, stiffness = 2e4, flight = 0.1; // m/s, N/m, m
  const auto ball = scree::make_clump("sphere", std::vector<scree::Sphere>{{Vector::Zero(), radius}});
  const auto trio =
      scree::make_clump("clump of 3", std::vector<scree::Sphere>{{{-0.8 * radius, 0.0, 0.0}, radius},
                                                                 {{0.8 * radius, 0.0, 0.0}, radius},
                                                                 {{0.0, 0.9 * radius, 0.0}, 0.8 * radius}});
  Outcome out;
  for (const scree::Clump* clump : {&ball, &trio}) {
    const scree::Material material = stone(stiffness, 0.4, 0.8);
    const double overlap = speed * std::sqrt(material.density * clump->volume / stiffness);
    for (const Tessellation& t : tessellations) {
      const auto mesh = plate_of(t);
      const auto middle = static_cast<std::size_t>(t.cells / 2);
      const auto c = mesh.corners(2 * middle * (static_cast<std::size_t>(t.cells) + 1));
      // A face and an edge, and a vertex where there is one within the plate.
      std::vector<Vector> feet{(c[0] + c[1] + c[2]) / 3.0, 0.5 * (c[1] + c[2])};
      if (t.cells > 1) {
        feet.push_back(c[0]);
      }
      Difference worst;
      for (const Vector& foot : feet) {
        // Along the normal, so that what is aimed at is hit.
        const Start start{clump,
                          foot + incline() * Vector{0.0, 0.0, 2.5 * radius},
                          incline() * Vector{0.0, 0.0, -speed},
                          {3.0, -8.0, 5.0}};
        Track on_plane{start, material, nullptr}, on_mesh{start, material, &mesh};
        worst.widen(compare(on_plane, on_mesh, 0.3));
      }
      report(out, fmt::format("drop on a mesh, {}, {}", clump->name, t.name), worst,
             of_rounding(overlap, flight, 2));
    }
  }
  out.notes.push_back(
      "Drop on a mesh: the inputs are ours, as mesh and plane agree for any; 0.3 s with two to "
      "four bounces at 1 m/s on a slope of 20 degrees.");
  return out;
}

/// A sphere is set down sliding and spinning on the slope and comes to roll, over many seams.
Outcome mesh_roll(const Inputs& /*inputs*/) {
  constexpr double stiffness = 1e4, g = 9.81;
  const auto ball = scree::make_clump("sphere", std::vector<scree::Sphere>{{Vector::Zero(), radius}});
  const scree::Material material = stone(stiffness, 0.4, 0.5);
  const Vector up = incline() * Vector::UnitZ();
  const double overlap = material.density * ball.volume * g * up.z() / stiffness;
  Outcome out;
  for (const Tessellation& t : tessellations) {
    const auto mesh = plate_of(t);
    // Across the slope and a little uphill, with a spin about the normal too.
    const Start start{&ball, incline() * Vector{-0.13, 0.07, radius - overlap},
                      incline() * Vector{0.5, -0.2, 0.0}, incline() * Vector{-10.0, 20.0, 30.0}};
    Track on_plane{start, material, nullptr}, on_mesh{start, material, &mesh};
    const Difference d = compare(on_plane, on_mesh, 0.4);
    report(out, fmt::format("roll on a mesh, {}", t.name), d, of_rounding(overlap));
  }
  out.notes.push_back("Roll on a mesh: all inputs are ours; 0.36 m in 0.4 s, first sliding and spinning.");
  return out;
}

} // namespace validation
