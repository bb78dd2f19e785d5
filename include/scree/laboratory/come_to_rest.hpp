#pragma once
/// \file
/// Waiting until grains lie still.

#include "scree/core/error.hpp"
#include "scree/material/material.hpp"
#include "scree/measure/unbalanced_force.hpp"
#include "scree/simulation/run.hpp"

#include <algorithm>
#include <cstddef>

namespace scree {

/// When grains count as at rest. All numbers are ours.
struct RestCriterion {
  double unbalanced = 0.05; ///< mean unbalanced over mean contact force at most, above 0
  double speed = 0.05;      ///< m/s, above which a grain moves
  double moving = 0.0;      ///< share of the grains that may still move, 0 to 1
  double patience = 3.0;    ///< s of simulated time, above 0

  /// \throws Error for a value out of its range.
  void check() const {
    require_positive("rest: unbalanced", unbalanced);
    require_positive("rest: speed", speed, "m/s");
    require("rest: moving", moving, {0.0, 1.0});
    require_positive("rest: patience", patience, "s");
  }
};

/// How far grains are from rest.
struct Unrest {
  double unbalanced = 1.0; ///< mean unbalanced over mean contact force
  double moving = 1.0;     ///< share of the grains

  [[nodiscard]] bool within(const RestCriterion& criterion) const {
    return unbalanced <= criterion.unbalanced && moving <= criterion.moving;
  }
};

/// \param what came to rest, for the message
/// \throws Error where it did not.
inline void require_rest(const char* what, const Unrest& unrest, const RestCriterion& criterion) {
  if (!unrest.within(criterion)) {
    throw Error(message(what, ": not at rest within patience = ", criterion.patience,
                        " s: mean unbalanced over mean contact force ", unrest.unbalanced, " (at most ",
                        criterion.unbalanced, "), share of grains faster than ", criterion.speed, " m/s ",
                        unrest.moving, " (at most ", criterion.moving, ")"));
  }
}

/// \param speed m/s, above which a grain moves
template <class Simulation>
Unrest unrest(const Simulation& simulation, double speed) {
  const auto& bodies = simulation.bodies();
  std::size_t moving = 0;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    moving += bodies.velocity(b).norm() > speed ? 1 : 0;
  }
  return {unbalanced_force(simulation).ratio(),
          static_cast<double>(moving) / static_cast<double>(std::max<std::size_t>(1, bodies.size()))};
}

/// Takes all motion away.
template <class Simulation>
void stop_all(Simulation& simulation) {
  for (std::size_t b = 0; b < simulation.bodies().size(); ++b) {
    simulation.set_motion(b, Vector::Zero(), Vector::Zero());
  }
}

/// Waits for grains to be at rest, step by step, or until the patience is over. When forces are balanced,
/// every grain is stopped from time to time, as those few that roll over a surface would roll for seconds.
/// What is not in balance then starts again by itself, and is given the time to: at the default speed, what
/// is pulled by a twentieth of its weight.
class ComingToRest {
public:
  ComingToRest() = default;
  /// \param least s, that it takes at least
  /// \param time s, now
  ComingToRest(const RestCriterion& criterion, double least, double time)
      : criterion_{criterion}, start_{time}, next_{time + least} {}

  /// Whether another step is to be taken.
  template <class Simulation>
  bool goes_on(Simulation& simulation) {
    constexpr double interval = 0.02, after_stop = 0.1; // s, ours
    if (simulation.time() < next_) {
      return true;
    }
    next_ = simulation.time() + interval;
    now_ = scree::unrest(simulation, criterion_.speed);
    if (now_.within(criterion_) || simulation.time() >= start_ + criterion_.patience) {
      return false;
    }
    if (now_.unbalanced <= criterion_.unbalanced) {
      stop_all(simulation);
      next_ = simulation.time() + after_stop;
    }
    return true;
  }
  /// As it was seen last.
  [[nodiscard]] const Unrest& unrest() const { return now_; }

private:
  RestCriterion criterion_{};
  double start_ = 0.0, next_ = 0.0; // s
  Unrest now_{};
};

/// Steps, for `least` [s] at least, until the grains are at rest or the patience is over (`ComingToRest`);
/// calls `watch(simulation)` after every step.
template <class Simulation, class Watch>
Unrest come_to_rest(Simulation& simulation, const RestCriterion& criterion, double least, Watch& watch) {
  ComingToRest waiting{criterion, least, simulation.time()};
  run_while(
      simulation, [&](const auto&) { return waiting.goes_on(simulation); }, watch);
  return waiting.unrest();
}

/// The same under another local damping.
/// \param damping local, in [0, 1)
template <class Simulation, class Watch>
Unrest settle(Simulation& simulation, double damping, const RestCriterion& criterion, double least,
              Watch& watch) {
  const double own = simulation.setup().local_damping;
  simulation.set_local_damping(damping);
  const Unrest unrest = come_to_rest(simulation, criterion, least, watch);
  simulation.set_local_damping(own);
  return unrest;
}

/// Does something while a material has another friction, and returns what came of it.
/// \param factor on its friction, above 0
template <class Simulation, class Action>
auto with_friction(Simulation& simulation, MaterialId material, double factor, Action action) {
  const Material own = simulation.materials().at(material);
  Material other = own;
  other.friction *= factor;
  simulation.change_material(material, other);
  auto outcome = action();
  simulation.change_material(material, own);
  return outcome;
}

/// The same as `settle` under another friction as well.
/// \param material of the grains
/// \param factor on its friction, above 0
template <class Simulation, class Watch>
Unrest settle_with_friction(Simulation& simulation, MaterialId material, double factor, double damping,
                            const RestCriterion& criterion, double least, Watch& watch) {
  return with_friction(simulation, material, factor,
                       [&] { return settle(simulation, damping, criterion, least, watch); });
}

} // namespace scree
