#pragma once
/// \file
/// What the angle of repose is measured with, and what comes of it.

#include "scree/laboratory/round_container.hpp"
#include "scree/measure/heap_angle.hpp"

#include <cstddef>
#include <cstdint>

namespace scree {

/// A conical funnel above the plate. How far grains fall matters as much as their friction: with the desk's
/// rock at friction 0.53, heaps below a funnel 0.14 m above the plate had 23 degrees, below one at 0.17 m 16
/// degrees, and 32 degrees where it rose from 0.06 m at 0.05 m/s (two of each). So take the laboratory's own.
struct Funnel {
  double outlet = 0.13;    ///< m, radius of its lower end
  double rim = 0.28;       ///< m, radius of its upper end, above that of the outlet
  double steepness = 1.05; ///< rad, of the cone over the horizontal, in (0, pi/2)
  double clearance = 0.3;  ///< m, from the plate up to the outlet, when it is opened
  double lift_speed = 0.0; ///< m/s, at which it rises from then on; 0: it stands still
  double solid = 0.012;    ///< m3, of rock without its pores, that is poured in

  /// m, of the cone.
  [[nodiscard]] double height() const { return (rim - outlet) * std::tan(steepness); }
};

/// Angle of repose (Coetzee et al. 2010, section 4.5, which pours through a funnel). All numbers are ours.
struct HeapSetup {
  enum class Method {
    funnel,         ///< grains run out of a funnel onto the plate
    lifted_cylinder ///< a tube filled on the plate is drawn up
  };

  RockSample sample = paper_rock();
  /// Of the plate, which is else like the rock. A pair takes the smaller friction of the two: above that of
  /// the rock, grains roll on the plate but slide no easier than on each other, as on rock glued to it.
  double plate_friction = 10.0;
  Method method = Method::funnel;
  Funnel funnel{};
  RoundContainer tube{.radius = 0.13, .height = 0.3}; ///< of the lifted cylinder
  double lift_speed = 0.05;                           ///< m/s, of the tube, above 0
  FillRecipe fill{};                  ///< of the tube, and how grains come to rest in the funnel
  RestCriterion rest{.moving = 0.01}; ///< of the heap
  double patience = 2.0; ///< s of simulated time in which no grain leaves a funnel that has choked, above 0
  FlankSetup flank{};
  std::uint64_t seed = 1;
  unsigned threads = 0; ///< 0: one for each processor

  /// \throws Error for a value out of its range.
  void check() const {
    fill.check();
    rest.check();
    flank.check();
    require_positive("tube radius", tube.radius, "m");
    require_positive("tube height", tube.height, "m");
    require_positive("funnel outlet", funnel.outlet, "m");
    if (!(funnel.rim > funnel.outlet)) {
      throw Error(
          message("funnel rim = ", funnel.rim, " m must be above funnel outlet = ", funnel.outlet, " m"));
    }
    require("funnel steepness", funnel.steepness, {0.1, 1.5, "rad"});
    require_positive("funnel clearance", funnel.clearance, "m");
    require("funnel lift_speed", funnel.lift_speed, {0.0, 100.0, "m/s"});
    require_positive("funnel solid", funnel.solid, "m3");
    require("heap plate_friction", plate_friction, {0.0, 1e6});
    require_positive("heap lift_speed", lift_speed, "m/s");
    require_positive("heap patience", patience, "s");
  }
};

/// The desk version: larger and softer grains, some hundreds of them. All ours.
inline HeapSetup desk_heap() {
  HeapSetup setup;
  setup.sample = desk_rock();
  setup.funnel = {.outlet = 0.12, .rim = 0.25, .clearance = 0.17, .solid = 0.007};
  setup.tube = {.radius = 0.12, .height = 0.28};
  setup.lift_speed = 0.1; // at 0.2 m/s the heap is flatter by 5 degrees
  return setup;
}

struct HeapResult {
  HeapAngle flank{};      ///< its standard error is that of this heap; other seeds make other heaps
  std::size_t grains = 0; ///< of the heap
  double mass = 0.0;      ///< kg
  double flow_time = 0.0; ///< s, until the funnel was empty, or the tube out of the way
  Unrest unrest{};        ///< of the heap
};

} // namespace scree
