#pragma once
/// \file
/// Everything that a dragline experiment is given, with the paper's values where it states them.

#include "scree/geometry/clump.hpp"
#include "scree/geometry/mass_properties.hpp"
#include "scree/laboratory/bed_container.hpp"
#include "scree/laboratory/bed_recipe.hpp"
#include "scree/laboratory/rock_sample.hpp"
#include "scree/material/pair.hpp"
#include "scree/simulation/resting.hpp"

#include <array>
#include <cmath>
#include <cstdint>

namespace scree {

/// The experiment of Coetzee, Els & Dymond (2010), sections 3, 6 and 7. Values marked [paper] are stated
/// there; all others are ours.
struct DragSetup {
  std::uint64_t seed = 1;
  unsigned threads = 0; ///< 0: one for each processor

  // The rock.
  Material rock = paper_material();
  Stiffness stiffness = Stiffness::of_particle;
  MassConvention mass_convention = MassConvention::sum_of_spheres;
  double size_factor = 1.0; ///< on the sieve sizes
  double local_damping = 0.0;

  // What the rock touches.
  Material steel{.name = "steel",
                 .density = 7850.0,
                 .normal_stiffness = 1.75e7,
                 .shear_stiffness = 1.75e7,
                 .friction = 0.3,
                 .restitution = 0.6};
  Material floor{.name = "trough",
                 .density = 1000.0,
                 .normal_stiffness = 1.75e7,
                 .shear_stiffness = 1.75e7,
                 .friction = 0.53,
                 .restitution = 0.6};

  // The bed: three buckets wide, ten long, three high [paper, section 3].
  double bed_length = 3.0;  ///< m [paper]
  double bed_width = 0.9;   ///< m [paper]
  double bed_depth = 0.525; ///< m [paper]
  bool shaped_bed = true;   ///< floor shaped along the path [paper, Fig. 11], its dimensions ours
  double drag_angle = 0.0;  ///< rad, by which the bed rises towards the winch
  BedRecipe bed{};

  // The bucket and its ropes.
  double bucket_start = 0.2;   ///< m, of the rear of the bucket from the rear wall
  double drag_speed = 0.15;    ///< m/s, of the ropes; 0.1 to 0.2 [paper, section 7]
  double ramp = 0.2;           ///< s, in which the winch comes up to speed
  double rope_stiffness = 5e5; ///< N/m, each: 6 mm steel wire rope of 3 m
  double rope_damping = 0.0;   ///< N s/m, each
  double winch_distance = 3.0; ///< m, ahead of the hitch points at the start
  double winch_height = 0.1;   ///< m, above the surface of the bed
  double drag_distance = 1.0;  ///< m [paper]
  double placing_time = 0.1;   ///< s, for the bucket to come to rest on the bed before it is pulled

  // Grains that no longer matter [paper, section 6.3].
  bool remove_behind = true;
  double removal_distance = 1.0; ///< bucket lengths behind the bucket [paper]
  double removal_interval = 0.1; ///< m of drag between two removals

  RestingRegions resting{}; ///< once the bucket is pulled, in a model with that policy

  [[nodiscard]] BedContainer container() const {
    return shaped_bed ? BedContainer::shaped(bed_length, bed_width, bed_depth)
                      : BedContainer::box(bed_length, bed_width, bed_depth);
  }
  /// m/s2; x along the drag, z normal to the bed.
  [[nodiscard]] Vector gravity() const {
    return 9.81 * Vector{-std::sin(drag_angle), 0.0, -std::cos(drag_angle)};
  }
  /// m of rope wound in at `time` [s] after the start of the winch: speed rises evenly over the ramp.
  [[nodiscard]] double wound(double time) const {
    if (time <= 0.0) {
      return 0.0;
    }
    return time < ramp ? 0.5 * drag_speed * time * time / ramp : drag_speed * (time - 0.5 * ramp);
  }
};

/// The desk version: fewer, larger grains, softer, a faster rope and a smaller trough, but the whole metre.
/// All ours.
inline DragSetup desk_drag() {
  DragSetup s;
  s.size_factor = 1.2;
  s.rock.normal_stiffness = s.rock.shear_stiffness = 1e5;
  s.steel.normal_stiffness = s.steel.shear_stiffness = 1e5;
  s.floor.normal_stiffness = s.floor.shear_stiffness = 1e5;
  s.bed_length = 1.8;
  s.bed_width = 0.42;
  s.bed_depth = 0.3;
  s.bucket_start = 0.05;
  s.bed.rest.moving = 0.01; // the last rattlers take as long to come to rest as all others
  s.drag_speed = 0.75;
  s.ramp = 0.1;
  s.rope_stiffness = 5e4;
  s.rope_damping = 50.0;
  return s;
}

/// The bucket as a rigid body: surface, interior, hitch points and mass, in one frame (x ahead, y left, z
/// up).
struct BucketBody {
  TriangleMesh surface;
  TriangleMesh interior;           ///< closed, struck off level
  std::array<Vector, 2> hitches{}; ///< m, left and right
  MassProperties body;
};

} // namespace scree
