#pragma once
/// \file
/// A bed of rock in the making, step by step, so that it can be kept and taken up again at any step.

#include "scree/core/error.hpp"
#include "scree/core/random.hpp"
#include "scree/laboratory/bed_container.hpp"
#include "scree/laboratory/bed_recipe.hpp"
#include "scree/laboratory/come_to_rest.hpp"
#include "scree/laboratory/stage.hpp"
#include "scree/measure/porosity.hpp"
#include "scree/packing/assembly.hpp"
#include "scree/packing/loose_pile.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>

namespace scree {

namespace detail {

/// The bed without a margin of two grains along walls, floor and surface, at its deepest third.
inline Eigen::AlignedBox3d bed_core(const BedContainer& bed, double grain) {
  double from = 0.0, to = bed.length;
  if (bed.floor.size() > 3) {
    from = bed.floor[1].x;
    to = bed.floor[bed.floor.size() - 2].x;
  }
  const double margin = std::min({2.0 * grain, 0.25 * (to - from), 0.25 * bed.width, 0.3 * bed.deepest()});
  return {Vector{from + margin, -0.5 * bed.width + margin, -bed.deepest() + margin},
          Vector{to - margin, 0.5 * bed.width - margin, -margin}};
}

/// A loose pile above the trough, as high over each place as the trough is deep there.
inline Packing poured(const BedContainer& bed, const Assembly& assembly, MaterialId rock,
                      const BedRecipe& recipe, Random& random) {
  const double expected = recipe.porosity > 0.0 ? recipe.porosity : recipe.expected_porosity;
  const double box = bed.length * bed.width * bed.deepest();
  const auto drawn = assembly.draw_volume(box * (1.0 - expected) * (1.0 + recipe.surplus), random);
  const Eigen::AlignedBox3d footprint{Vector{0.0, -0.5 * bed.width, -bed.shallowest()},
                                      Vector{bed.length, 0.5 * bed.width, 0.0}};
  Packing pile = loose_pile(assembly.clumps(), drawn, footprint, random);
  const double base = footprint.min().z();
  double top = base;
  for (const PackedBody& body : pile.bodies) {
    top = std::max(top, body.position.z());
  }
  std::erase_if(pile.bodies, [&](const PackedBody& body) {
    return body.position.z() - base > (top - base) * bed.depth_at(body.position.x()) / bed.deepest();
  });
  for (PackedBody& body : pile.bodies) {
    body.material = rock;
  }
  return pile;
}

} // namespace detail

/// Pours grains into a trough, lets them come to rest, makes them denser where a porosity is requested,
/// strikes them off at the brim and lets them rest again. The walls of the trough must be in the simulation.
/// The bed stays in the simulation with the history of its contacts.
///
/// Denser: the friction between grains is taken away while the bed is shaken gently and given back, once or
/// more, until the porosity is reached. So a requested porosity lies between what gentle pouring leaves and
/// what shaking without friction reaches.
///
///     scree::BedMaking making{trough, rock, recipe};
///     making.pour(simulation, assembly, random);
///     while (making.step(simulation)) {}
class BedMaking {
public:
  /// \throws Error for a recipe out of range.
  BedMaking(BedContainer bed, MaterialId rock, const BedRecipe& recipe)
      : bed_{std::move(bed)}, rock_{rock}, recipe_{recipe}, inside_{recipe.rest} {
    recipe.check();
    // What still rolls over the surface is struck off or shaken anyway.
    inside_.moving = 1.0;
  }

  /// Lays the grains above the trough.
  template <class Simulation>
  void pour(Simulation& simulation, const Assembly& assembly, Random& random) {
    const double gravity = require_positive("bed gravity", simulation.setup().gravity.norm(), "m/s2");
    began_ = simulation.time();
    const Packing pile = detail::poured(bed_, assembly, rock_, recipe_, random);
    for (const PackedBody& body : pile.bodies) {
      report_.drawn.push_back({body.shape, body.scale});
      grain_ += 2.0 * pile.shapes[body.shape].bounding_radius * body.scale /
                static_cast<double>(pile.bodies.size());
    }
    simulation.add(pile);
    report_.poured = pile.bodies.size();

    damping_ = simulation.setup().local_damping;
    simulation.set_local_damping(recipe_.settling_damping);
    own_ = simulation.materials().at(rock_);
    Material poured = own_;
    poured.friction *= recipe_.packing_friction;
    simulation.change_material(rock_, poured);
    phase_ = Phase::settling;
    rest_ = {inside_, std::sqrt(2.0 * 2.0 * bed_.deepest() / gravity), simulation.time()};
  }

  /// One step of the simulation, or none where the bed is done. Returns whether there was one.
  /// \throws Error for a porosity that this material does not reach, with the range that it does, and for a
  /// trough that is not filled.
  template <class Simulation>
  bool step(Simulation& simulation) {
    while (phase_ != Phase::done) {
      const bool goes_on = phase_ == Phase::shaking ? goes_on_shaking(simulation) : rest_.goes_on(simulation);
      if (goes_on) {
        simulation.step();
        return true;
      }
      next_phase(simulation);
    }
    return false;
  }

  [[nodiscard]] Stage stage() const {
    switch (phase_) {
    case Phase::settling:
      return {"settling", 0.0};
    case Phase::shaking:
    case Phase::resting:
      return {"densifying", 0.6};
    default:
      return {"striking off", 0.8};
    }
  }
  [[nodiscard]] bool done() const { return phase_ == Phase::done; }
  /// Complete when done.
  [[nodiscard]] const BedReport& report() const { return report_; }

  /// How far it is; container, rock and recipe are those that it was made with.
  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {
    archive(self.phase_, self.rest_, self.report_, self.own_, self.gravity_, self.grain_, self.began_,
            self.damping_, self.shaken_at_, self.checked_, self.porosity_, self.loosest_, self.densest_,
            self.target_, self.denser_);
  }

private:
  enum class Phase : std::uint8_t { settling, shaking, resting, struck, done };

  template <class Simulation>
  [[nodiscard]] double measured(const Simulation& simulation) const {
    return porosity(simulation.bodies(), detail::bed_core(bed_, grain_));
  }

  template <class Simulation>
  void next_phase(Simulation& simulation) {
    switch (phase_) {
    case Phase::settling:
      simulation.change_material(rock_, own_);
      report_.poured_porosity = report_.porosity = measured(simulation);
      if (recipe_.porosity > 0.0 && report_.porosity < recipe_.porosity - recipe_.porosity_tolerance) {
        throw Error(message("bed porosity = ", recipe_.porosity,
                            " is looser than this material settles: poured gently it comes to rest at ",
                            report_.porosity, " (friction ", own_.friction, ")"));
      }
      shake_or_strike(simulation);
      break;
    case Phase::shaking:
      stop_shaking(simulation);
      rest_ = {inside_, 0.02, simulation.time()};
      phase_ = Phase::resting;
      break;
    case Phase::resting: {
      const double now = measured(simulation);
      denser_ = denser_ && now < report_.porosity;
      report_.porosity = now;
      shake_or_strike(simulation);
      break;
    }
    case Phase::struck:
      finish(simulation);
      phase_ = Phase::done;
      break;
    case Phase::done:
      break;
    }
  }

  template <class Simulation>
  void shake_or_strike(Simulation& simulation) {
    if (recipe_.porosity > 0.0 && denser_ &&
        report_.porosity > recipe_.porosity + 0.5 * recipe_.porosity_tolerance) {
      begin_shaking(simulation);
      phase_ = Phase::shaking;
      return;
    }
    if (simulation.remove_bodies(
            [](const auto& bodies, std::size_t b) { return bodies.position(b).z() > 0.0; }) == 0) {
      throw Error(message("bed: what was poured does not reach the brim: surplus = ", recipe_.surplus,
                          " is too little for this material"));
    }
    rest_ = {recipe_.rest, 0.05, simulation.time()};
    phase_ = Phase::struck;
  }

  /// Without friction, until the target is reached or the patience is over.
  template <class Simulation>
  void begin_shaking(Simulation& simulation) {
    // Grains pack on while friction takes hold again: the last third of the way is left to them.
    target_ = recipe_.porosity + (report_.porosity - recipe_.porosity) / 3.0;
    gravity_ = simulation.setup().gravity;
    own_ = simulation.materials().at(rock_);
    Material slippery = own_;
    slippery.friction = 0.0;
    slippery.rolling_friction = 0.0;
    simulation.change_material(rock_, slippery);
    porosity_ = loosest_ = densest_ = measured(simulation);
    shaken_at_ = checked_ = simulation.time();
  }
  template <class Simulation>
  bool goes_on_shaking(Simulation& simulation) {
    const double t = simulation.time() - shaken_at_;
    // A tenth of gravity at 20 Hz: enough to unlock, too little to throw.
    simulation.set_gravity(gravity_ * (1.0 + 0.1 * std::sin(2.0 * std::numbers::pi * 20.0 * t)));
    if (simulation.time() - checked_ >= 0.001) {
      checked_ = simulation.time();
      porosity_ = measured(simulation);
      densest_ = std::min(densest_, porosity_);
    }
    return porosity_ > target_ && t < recipe_.rest.patience;
  }
  /// And stops all grains, as in motion they would pack on while friction takes hold.
  template <class Simulation>
  void stop_shaking(Simulation& simulation) {
    simulation.set_gravity(gravity_);
    simulation.change_material(rock_, own_);
    stop_all(simulation);
    if (porosity_ > target_ && porosity_ > recipe_.porosity + recipe_.porosity_tolerance) {
      throw Error(message("bed porosity = ", recipe_.porosity,
                          " is denser than this material packs: it allows ", densest_, " to ", loosest_));
    }
    denser_ = porosity_ <= target_;
  }

  template <class Simulation>
  void finish(Simulation& simulation) {
    report_.unbalanced = rest_.unrest().unbalanced;
    report_.moving = rest_.unrest().moving;
    report_.at_rest = rest_.unrest().within(recipe_.rest);
    simulation.set_local_damping(damping_);
    report_.porosity = measured(simulation);
    if (recipe_.porosity > 0.0 &&
        std::abs(report_.porosity - recipe_.porosity) > recipe_.porosity_tolerance) {
      throw Error(message("bed porosity = ", recipe_.porosity, " was not reached to ",
                          recipe_.porosity_tolerance, ": struck off and at rest the bed has ",
                          report_.porosity));
    }
    report_.kept = simulation.bodies().size();
    double mass = 0.0;
    for (std::size_t b = 0; b < simulation.bodies().size(); ++b) {
      mass += simulation.bodies().mass(b);
    }
    report_.bulk_density = mass / bed_.volume();
    report_.duration = simulation.time() - began_;
  }

  BedContainer bed_;
  MaterialId rock_;
  BedRecipe recipe_;
  RestCriterion inside_;

  Phase phase_ = Phase::done;
  ComingToRest rest_;
  BedReport report_;
  Material own_;
  Vector gravity_ = Vector::Zero();
  double grain_ = 0.0;                     // m, mean size
  double began_ = 0.0, damping_ = 0.0;     // s; local, of the simulation before
  double shaken_at_ = 0.0, checked_ = 0.0; // s
  double porosity_ = 0.0, loosest_ = 0.0, densest_ = 0.0, target_ = 0.0;
  bool denser_ = true;
};

} // namespace scree
