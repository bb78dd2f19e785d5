#pragma once
/// \file
/// Waiting until grains lie still.

#include "scree/core/error.hpp"
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

/// Steps, for `least` [s] at least, until the grains are at rest or the patience is over; calls
/// `watch(simulation)` after every step. When forces are balanced, every grain is stopped from time to time,
/// as those few that roll over a surface would roll for seconds: what is not in balance starts again by
/// itself.
template <class Simulation, class Watch>
Unrest come_to_rest(Simulation& simulation, const RestCriterion& criterion, double least, Watch& watch) {
  constexpr double interval = 0.02; // s, ours: a grain in free fall comes to 0.2 m/s
  const double start = simulation.time();
  double next = start + least;
  Unrest now;
  run_while(
      simulation,
      [&](const auto& s) {
        if (s.time() < next) {
          return true;
        }
        next = s.time() + interval;
        now = unrest(s, criterion.speed);
        if (now.within(criterion) || s.time() >= start + criterion.patience) {
          return false;
        }
        if (now.unbalanced <= criterion.unbalanced) {
          stop_all(simulation);
        }
        return true;
      },
      watch);
  return now;
}

} // namespace scree
