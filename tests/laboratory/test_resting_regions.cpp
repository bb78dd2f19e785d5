/// \file
/// Leaving alone what rests changes neither a heap nor the stiffness of a bed.

#include "scree/laboratory/heap.hpp"
#include "scree/laboratory/oedometer.hpp"
#include "support/mean.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <vector>

using namespace scree;

namespace resting_regions_tests {

namespace {

struct Resting : DefaultModel {
  using Rest = RestingRegions;
};

// Far below what comes to rest by itself in these experiments: 0.05 m/s, forces balanced to 0.05 of a
// contact's.
constexpr RestingRegions rule{.speed = 1e-3, .force = 0.01, .window = 200, .interval = 20};

struct Outcome {
  std::vector<double> values; // one for each seed
  double resting = 0.0;       // mean share of the grains
};

/// \param make (seed, physics): the experiment
/// \param value of its result
template <class Model, class Make, class Value>
Outcome outcome(const Setup<Model>& physics, Make make, Value value) {
  Outcome out;
  double all = 0.0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    auto test = make(seed, physics);
    out.values.push_back(value(test.run([&](const auto& s, const Stage&) {
      out.resting += static_cast<double>(s.resting_count());
      all += static_cast<double>(s.bodies().size());
    })));
  }
  out.resting /= all;
  return out;
}

template <class Make, class Value>
void check_alike(Make make, Value value) {
  const Outcome stepped = outcome(Setup<>{}, make, value);
  const Outcome rested = outcome(Setup<Resting>{.rest = rule}, make, value);
  const examples::Mean a{stepped.values}, b{rested.values};
  MESSAGE(a.value, " +- ", a.error, ", ", b.value, " +- ", b.error, ", resting ", rested.resting);
  CHECK(rested.resting > 0.05);
  constexpr double student = 2.98; // t at 99 % on both sides, 14 degrees of freedom
  CHECK(std::abs(a.value - b.value) < student * std::hypot(a.error, b.error));
}

} // namespace

TEST_CASE("long: a heap with resting regions has the same angle") {
  check_alike(
      []<class Model>(std::uint64_t seed, const Setup<Model>& physics) {
        HeapSetup setup = desk_heap();
        setup.threads = 1;
        setup.seed = seed;
        return HeapTest<Model>{setup, physics};
      },
      [](const HeapResult& result) { return result.flank.angle; });
}

TEST_CASE("long: an oedometer with resting regions has the same modulus") {
  check_alike(
      []<class Model>(std::uint64_t seed, const Setup<Model>& physics) {
        OedometerSetup setup = desk_oedometer();
        setup.threads = 1;
        setup.seed = seed;
        return Oedometer<Model>{setup, physics};
      },
      [](const OedometerResult& result) { return result.modulus; });
}

} // namespace resting_regions_tests
