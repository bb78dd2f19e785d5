#pragma once
/// \file
/// Where the time of a step goes.

#include <chrono>

namespace scree {

/// Seconds spent in the parts of the time step.
struct StepTimes {
  using Clock = std::chrono::steady_clock;

  double search = 0.0;  ///< lists
  double contact = 0.0; ///< forces between grains
  double walls = 0.0;   ///< forces of walls on grains, and the motion of walls
  double motion = 0.0;  ///< of grains

  [[nodiscard]] double total() const { return search + contact + walls + motion; }
  [[nodiscard]] StepTimes scaled(double factor) const {
    return {factor * search, factor * contact, factor * walls, factor * motion};
  }
  StepTimes& operator+=(const StepTimes& other) {
    search += other.search;
    contact += other.contact;
    walls += other.walls;
    motion += other.motion;
    return *this;
  }
  [[nodiscard]] static double seconds(Clock::time_point from, Clock::time_point to) {
    return std::chrono::duration<double>(to - from).count();
  }
};

} // namespace scree
