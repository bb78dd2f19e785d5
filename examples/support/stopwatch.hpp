#pragma once
/// \file
/// How long a part of the work takes.

#include <chrono>

namespace scree::examples {

/// Adds the seconds that it lives to a sum.
class Stopwatch {
public:
  explicit Stopwatch(double& sum) : sum_{sum} {}
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;
  ~Stopwatch() { sum_ += std::chrono::duration<double>(Clock::now() - start_).count(); }

private:
  using Clock = std::chrono::steady_clock;

  double& sum_;
  Clock::time_point start_ = Clock::now();
};

} // namespace scree::examples
