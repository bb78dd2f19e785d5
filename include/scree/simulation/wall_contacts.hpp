#pragma once
/// \file
/// Contacts of grains with walls, and who may have one.

#include "scree/state/blocks.hpp"
#include "scree/walls/wall.hpp"

#include <array>
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
  /// m, centre of the sphere when its contacts were last looked for; not a number before
  Vec3<double> seen{std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0};
  double gap = 0.0; ///< m, to the surface at that time, 0 where it touched; found again after a checkpoint

  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {
    archive(self.sphere, self.wall, self.surface, self.first_facet, self.facet_count, self.seen);
  }
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

  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {
    archive(self.sphere, self.wall, self.surface, self.at, self.point, self.normal, self.overlap, self.force,
            self.history);
  }
};

/// Candidates and contacts of one block, both in the order of (sphere, wall, surface).
template <class Real, int history_size>
struct WallBlock {
  std::vector<WallCandidate> candidates;
  std::vector<std::uint32_t> facets;
  std::vector<WallContact<Real, history_size>> contacts, before;
  std::vector<Vector> tilts; ///< rad, by which the normals of the contacts turned in the step

  /// What lasts from step to step.
  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {
    archive(self.candidates, self.facets, self.contacts);
  }
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

} // namespace scree
