#pragma once
/// \file
/// Drivers: how long to step, and who watches.

#include "scree/core/error.hpp"

#include <cmath>
#include <utility>

namespace scree {

/// Calls an observer at intervals of simulated time [s], the first time at once.
///
///     scree::run_for(simulation, 2.0, scree::Every{0.01, [&](const auto& s) { ... }});
template <class Observer>
class Every {
public:
  Every(double interval, Observer observer)
      : interval_{require_positive("observer interval", interval, "s")}, observer_{std::move(observer)} {}

  template <class Simulation>
  void operator()(Simulation& simulation) {
    if (std::isnan(next_)) {
      next_ = simulation.time();
    }
    // A hair early, so that rounding of the sum of steps does not put an output off by a whole step.
    if (simulation.time() >= next_ - 1e-9 * interval_) {
      observer_(simulation);
      while (next_ <= simulation.time() + 1e-9 * interval_) {
        next_ += interval_;
      }
    }
  }

private:
  double interval_;
  Observer observer_;
  double next_ = std::nan("");
};

/// Steps while `go(simulation)` is true; after each step calls the observers, any callables that take the
/// simulation, in their order.
template <class Simulation, class Go, class... Observers>
void run_while(Simulation& simulation, Go go, Observers&&... observers) {
  while (go(std::as_const(simulation))) {
    simulation.step();
    (observers(simulation), ...);
  }
}

/// Steps for `duration` [s, 0 or above] of simulated time.
template <class Simulation, class... Observers>
void run_for(Simulation& simulation, double duration, Observers&&... observers) {
  const double end = simulation.time() + require("duration", duration, {0.0, 1e300, "s"});
  const double half = 0.5 * simulation.time_step();
  run_while(
      simulation, [=](const auto& s) { return s.time() < end - half; }, observers...);
}

} // namespace scree
