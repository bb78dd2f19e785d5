#pragma once
/// \file
/// Contacts of grains with walls.

#include "scree/contact/concept.hpp"
#include "scree/simulation/tally.hpp"
#include "scree/state/blocks.hpp"
#include "scree/walls/wall.hpp"

#include <boost/container/small_vector.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <tuple>
#include <vector>

namespace scree {

/// A sphere that touches or may touch soon a surface of a wall.
struct WallCandidate {
  std::uint32_t sphere;
  std::uint16_t wall, surface;
  std::uint32_t first_facet, facet_count; ///< in the facet list, for a mesh
};

/// A sphere that touches a surface. The contact is known again in the next step by where it is on the wall,
/// so its spring is kept when the sphere goes from one facet to the next.
template <class Real, int history_size>
struct WallContact {
  std::uint32_t sphere;
  std::uint16_t wall, surface;
  Vector at;      ///< m, in the wall's frame
  Vector point;   ///< m, in space
  Vector normal;  ///< unit vector from the wall to the sphere
  double overlap; ///< m
  Vector force;   ///< N, on the sphere
  std::array<Real, static_cast<std::size_t>(history_size)> history;

  [[nodiscard]] auto key() const { return std::tuple{sphere, wall, surface}; }
};

/// Candidates and contacts of one block, both in the order of (sphere, wall, surface).
template <class Real, int history_size>
struct WallBlock {
  std::vector<WallCandidate> candidates;
  std::vector<std::uint32_t> facets;
  std::vector<WallContact<Real, history_size>> contacts, before;
};

/// Lists the spheres of `block` that are within `margin` [m] of a surface. Fixed bodies feel no walls.
template <class Real, int history_size, class AnyWall>
void find_wall_candidates(const Block& block, const Bodies<Real>& bodies, std::span<const AnyWall> walls,
                          double margin, WallBlock<Real, history_size>& out) {
  out.candidates.clear();
  out.facets.clear();
  for (std::size_t s = block.first_sphere; s < block.end_sphere; ++s) {
    const SphereRecord<Real>& sphere = bodies.spheres()[s];
    if (!(sphere.inverse_mass > 0)) {
      continue;
    }
    for (std::size_t w = 0; w < walls.size(); ++w) {
      const Vector centre = walls[w].motion.to_wall(to_eigen(sphere.position));
      for (std::size_t k = 0; k < walls[w].surfaces.size(); ++k) {
        const std::size_t first = out.facets.size();
        if (walls[w].surfaces[k].near(centre, sphere.radius + margin, out.facets)) {
          out.candidates.push_back({static_cast<std::uint32_t>(s), static_cast<std::uint16_t>(w),
                                    static_cast<std::uint16_t>(k), static_cast<std::uint32_t>(first),
                                    static_cast<std::uint32_t>(out.facets.size() - first)});
        }
      }
    }
  }
}

/// m/s, of a sphere relative to a wall at their contact, whose normal tilted by `tilt` [rad] in a step of
/// `dt` [s]. Velocities stand half a step behind, so slip is the mean of that at the place where the contact
/// is and at the one that it came from. (Not that at a place halfway: from facet to facet there is none.)
/// \param arm m, from the centre of the sphere to the contact point
template <class Real>
Vector slip_velocity(const SphereRecord<Real>& sphere, const WallMotion& wall, const Vector& normal,
                     const Vector& tilt, double arm, double dt) {
  const Vector between = to_eigen(sphere.velocity) - wall.velocity; // of centre and wall
  const Vector spin = to_eigen(sphere.angular_velocity);
  const auto at = [&](const Vector& n, const Vector& lever) {
    return Vector(between - arm * spin.cross(n) - wall.angular_velocity.cross(lever - arm * n));
  };
  const Vector lever = to_eigen(sphere.position) - wall.position;
  Vector now = at(normal, lever);
  if (tilt.isZero(0.0) && wall.angular_velocity.isZero(0.0)) {
    return now;
  }
  const auto along = [](const Vector& velocity, const Vector& n) {
    return Vector(velocity - n.dot(velocity) * n);
  };
  const Vector before_normal = normal - tilt.cross(normal);
  const Vector before = along(at(before_normal, lever - dt * between), before_normal);
  return now + 0.5 * (before + tilt.cross(before) - along(now, normal));
}

/// What the contacts of a step ask of a wall again and again.
struct WallInStep {
  Matrix axes; ///< of the wall's frame, in space
  Vector position;
  double inverse_mass; ///< 1/kg, as a contact sees it

  template <class AnyWall>
  explicit WallInStep(const AnyWall& wall)
      : axes{wall.motion.orientation.toRotationMatrix()},
        position{wall.motion.position},
        inverse_mass{wall.inverse_mass()} {}
  [[nodiscard]] Vector to_wall(const Vector& in_space) const {
    return axes.transpose() * (in_space - position);
  }
};

/// Adds the forces of the walls to the spheres of a block, and what the walls feel to `sums` (one for each
/// wall).
template <bool audit, ContactLaw Law, class Real, class AnyWall, class PairMaterials>
void add_wall_forces(const Law& law, const PairMaterials& pair_material, std::span<const AnyWall> walls,
                     Real dt, Bodies<Real>& bodies, WallBlock<Real, Law::history_size>& block,
                     std::span<WallSum> sums, Dissipation& lost) {
  using Contact = WallContact<Real, Law::history_size>;
  std::swap(block.contacts, block.before);
  block.contacts.clear();
  const auto spheres = std::as_const(bodies).spheres();
  const auto forces = bodies.forces();
  auto old = block.before.begin();
  SurfaceContacts found;
  boost::container::small_vector<WallInStep, 4> in_step;
  for (const AnyWall& wall : walls) {
    in_step.emplace_back(wall);
  }
  for (const WallCandidate& candidate : block.candidates) {
    const AnyWall& wall = walls[candidate.wall];
    const WallInStep& here = in_step[candidate.wall];
    const WallSurface& surface = wall.surfaces[candidate.surface];
    const SphereRecord<Real>& sphere = spheres[candidate.sphere];
    const Vector centre = to_eigen(sphere.position);
    found.clear();
    surface.touch({block.facets.data() + candidate.first_facet, candidate.facet_count}, here.to_wall(centre),
                  sphere.radius, found);
    if (found.empty()) {
      continue;
    }
    const auto key = std::tuple{candidate.sphere, candidate.wall, candidate.surface};
    while (old != block.before.end() && old->key() < key) {
      ++old;
    }
    auto old_end = old;
    while (old_end != block.before.end() && old_end->key() == key) {
      ++old_end;
    }
    for (const SurfaceContact& contact : found) {
      const Vector normal = here.axes * contact.normal;
      Vector tilt = Vector::Zero();
      Contact now{candidate.sphere,
                  candidate.wall,
                  candidate.surface,
                  contact.point,
                  {},
                  {},
                  contact.overlap,
                  {},
                  {}};
      // A contact moves by far less than this in one step, and two contacts of a sphere lie further apart.
      const double reach = 0.2 * sphere.radius;
      auto match = old_end;
      double nearest = reach * reach;
      for (auto candidate_before = old; candidate_before != old_end; ++candidate_before) {
        if (const double d2 = (candidate_before->at - contact.point).squaredNorm(); d2 < nearest) {
          nearest = d2;
          match = candidate_before;
        }
      }
      if (match != old_end) {
        now.history = match->history;
        if (match->normal != normal) { // on one facet it stays the same to the bit
          tilt = match->normal.cross(normal);
        }
        match->at.setConstant(std::numeric_limits<double>::infinity()); // taken
      }
      now.normal = normal;
      const double arm = sphere.radius - 0.5 * contact.overlap;
      now.point = centre - arm * now.normal;

      Kinematics<Real> k;
      k.normal = to_vec3<Real>(now.normal);
      k.overlap = static_cast<Real>(contact.overlap);
      k.spin_i = sphere.angular_velocity;
      k.spin_j = to_vec3<Real>(wall.motion.angular_velocity);
      k.velocity = to_vec3<Real>(slip_velocity(sphere, wall.motion, now.normal, tilt, arm, dt));
      k.reduced_radius = static_cast<Real>(sphere.radius);
      k.reduced_mass = Real{1} / (sphere.inverse_mass + static_cast<Real>(here.inverse_mass));
      k.root_mass = std::sqrt(k.reduced_mass);
      k.turn = to_vec3<Real>(tilt) + k.normal * (Real(0.5) * dot(k.spin_i + k.spin_j, k.normal) * dt);
      k.dt = dt;
      const ContactForce<Real> f =
          law.evaluate(pair_material(sphere.material, surface.material()), k, now.history);
      const Vec3<Real> force = k.normal * f.normal + f.tangential;
      forces[candidate.sphere].force += force;
      forces[candidate.sphere].torque += f.couple - cross(k.normal, f.tangential) * static_cast<Real>(arm);
      now.force = to_eigen(force);
      WallSum& sum = sums[candidate.wall];
      sum.force -= now.force;
      sum.moment -= (now.point - here.position).cross(now.force) + to_eigen(f.couple);
      ++sum.contacts;
      if constexpr (audit) {
        lost.friction += static_cast<double>(f.frictional_work);
        lost.viscous += static_cast<double>(f.viscous_work);
      }
      block.contacts.push_back(now);
    }
  }
}

} // namespace scree
