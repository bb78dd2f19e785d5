#pragma once
/// \file
/// Looks whether a run is still sane, and ends it with the reason where it is not.

#include "scree/core/error.hpp"
#include "scree/core/linear.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <variant>

namespace scree {

/// What a sane run keeps to. All numbers are ours.
struct SaneBounds {
  double overlap = 0.3;         ///< of a contact, over the radius of the smallest sphere in it, above 0
  double speed = 100.0;         ///< m/s, of a grain's centre of mass, above 0
  double kinetic_energy = 1e12; ///< J, of all grains, above 0
  /// m, that holds the centres of mass of all grains, and the origins of walls that move.
  Eigen::AlignedBox3d domain{Vector::Constant(-1e9), Vector::Constant(1e9)};
  double rope_strain = 0.1;   ///< stretch of a rope over its length, above 0
  double rope_slack = 1e9;    ///< m, by which a rope hangs through, above 0
  std::size_t interval = 200; ///< steps between two looks, 1 or more: trouble is found within so many

  /// \throws Error for a bound out of its range.
  void check() const {
    require_positive("watch overlap", overlap);
    require_positive("watch speed", speed, "m/s");
    require_positive("watch kinetic_energy", kinetic_energy, "J");
    require_positive("watch rope_strain", rope_strain);
    require_positive("watch rope_slack", rope_slack, "m");
    require("watch interval", static_cast<double>(interval), {1.0, 1e12, "steps"});
    if (domain.isEmpty()) {
      throw Error("watch domain: its corners are in the wrong order");
    }
  }
};

/// An observer of a simulation: `run_for(simulation, 1.0, Watchdog{bounds})`.
class Watchdog {
public:
  /// \throws Error for a bound out of its range.
  explicit Watchdog(SaneBounds bounds = {}) : bounds_{std::move(bounds)} { bounds_.check(); }

  /// Looks where a look is due.
  /// \throws Trouble as `look` does.
  template <class Simulation>
  void operator()(const Simulation& simulation) {
    if (simulation.steps() % bounds_.interval == 0) {
      look(simulation);
    }
  }

  /// \throws Trouble that names what is wrong with which body, wall or rope, when, and what may have caused it.
  template <class Simulation>
  void look(const Simulation& simulation) {
    look_at_grains(simulation);
    look_at_contacts(simulation);
    for (const auto& wall : simulation.walls()) {
      look_at_wall(simulation, wall);
    }
  }

  /// The largest seen so far, over the radius of the smallest sphere in the contact.
  [[nodiscard]] double largest_overlap() const { return largest_overlap_; }

  /// What it has seen (core/archive.hpp).
  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {
    archive(self.largest_overlap_);
  }

private:
  template <class Simulation, class... What>
  [[noreturn]] static void report(const Simulation& simulation, const char* cause, const What&... what) {
    // What goes wrong at once was wrong from the start.
    constexpr std::size_t at_once = 1000; // steps, ours
    throw Trouble(
        message(what..., " at t = ", simulation.time(), " s (step ", simulation.steps(), "). Likely ",
                simulation.steps() <= at_once ? "grains that overlap at the start, or " : "", cause));
  }

  template <class Simulation>
  void look_at_grains(const Simulation& simulation) const {
    const auto& bodies = simulation.bodies();
    double energy = 0.0;
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      const Vector x = bodies.position(b);
      // Written so that what is not a number is out of bounds.
      if (const double speed = bodies.velocity(b).norm(); !(speed <= bounds_.speed)) {
        report(simulation, "a time step too long for the stiffness.", "body ", bodies.id(b),
               " has a speed of ", speed, " m/s, above watch.speed = ", bounds_.speed, " m/s,");
      }
      if (!bounds_.domain.contains(x)) {
        report(simulation, "a gap between walls, a wall faster than the time step allows, or an explosion.",
               "body ", bodies.id(b), " is outside the domain, at (", x.x(), ", ", x.y(), ", ", x.z(),
               ") m,");
      }
      energy += bodies.is_fixed(b) ? 0.0 : bodies.kinetic_energy(b);
    }
    if (!(energy <= bounds_.kinetic_energy)) {
      report(simulation, "a time step too long for the stiffness.", "the grains have a kinetic energy of ",
             energy, " J, above watch.kinetic_energy = ", bounds_.kinetic_energy, " J,");
    }
  }

  template <class Simulation>
  static double smallest_radius(const Simulation& simulation, std::size_t b) {
    const auto& bodies = simulation.bodies();
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t s = bodies.first_sphere(b); s < bodies.first_sphere(b + 1); ++s) {
      least = std::min(least, bodies.spheres()[s].radius);
    }
    return least;
  }

  template <class Simulation>
  void look_at_contacts(const Simulation& simulation) {
    const auto& bodies = simulation.bodies();
    simulation.visit_contacts([&](const auto& contact) {
      double radius = smallest_radius(simulation, contact.first);
      if (!contact.with_wall) {
        radius = std::min(radius, smallest_radius(simulation, contact.second));
      }
      const double share = contact.overlap / radius;
      largest_overlap_ = std::max(largest_overlap_, share);
      if (!(share <= bounds_.overlap)) {
        const std::string other = contact.with_wall
                                      ? message("wall '", simulation.wall(contact.second).name, "'")
                                      : message("body ", bodies.id(contact.second));
        report(simulation, "a stiffness too low for these loads.", "body ", bodies.id(contact.first), " and ",
               other, " overlap by ", share,
               " of the smaller radius, above watch.overlap = ", bounds_.overlap, ",");
      }
    });
  }

  template <class Simulation, class Wall>
  void look_at_wall(const Simulation& simulation, const Wall& wall) const {
    const Vector& x = wall.motion.position;
    const bool moves = !wall.motion.velocity.isZero(0.0);
    if (moves && !bounds_.domain.contains(x)) {
      report(simulation, "a force that nothing holds up: too few grains below it, or the wrong sign.",
             "wall '", wall.name, "' has left the domain, at (", x.x(), ", ", x.y(), ", ", x.z(), ") m,");
    }
    std::visit(
        [&](const auto& dynamics) {
          if constexpr (requires { dynamics.ropes(); }) {
            for (const auto& rope : dynamics.ropes()) {
              look_at_rope(simulation, wall.name, rope);
            }
          }
        },
        wall.dynamics);
  }

  template <class Simulation, class Rope>
  void look_at_rope(const Simulation& simulation, const std::string& wall, const Rope& rope) const {
    if (rope.stretch > bounds_.rope_strain * rope.unstretched) {
      report(simulation, "something that holds the wall fast.", "rope '", rope.name, "' of '", wall,
             "' is stretched by ", rope.stretch, " m, above watch.rope_strain = ", bounds_.rope_strain,
             " of its length,");
    }
    if (-rope.stretch > bounds_.rope_slack) {
      report(simulation, "a wall that runs ahead of its winch.", "rope '", rope.name, "' of '", wall,
             "' hangs through by ", -rope.stretch, " m, above watch.rope_slack = ", bounds_.rope_slack,
             " m,");
    }
  }

  SaneBounds bounds_;
  double largest_overlap_ = 0.0;
};

} // namespace scree
