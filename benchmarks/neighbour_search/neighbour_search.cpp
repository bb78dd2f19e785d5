// How long do a search for neighbours and the renewal of the pair list take?

#include "scree/core/random.hpp"
#include "scree/neighbours/all_pairs.hpp"
#include "scree/neighbours/cell_grid.hpp"
#include "scree/neighbours/r_tree.hpp"
#include "scree/state/pair_list.hpp"

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace {

using namespace scree;

constexpr double margin = 0.3 * 0.005; // m, of VerletList for these spheres

/// Spheres of 5 to 9.5 mm on a jittered lattice as dense as a settled bed, layer upon layer.
std::vector<Ball> made_balls(std::int64_t count) {
  Random random{11};
  constexpr double pitch = 0.0143; // m: 0.6 of the space is filled
  const auto across = static_cast<std::int64_t>(std::cbrt(static_cast<double>(count)));
  const auto at = [&](std::int64_t cell) {
    return (static_cast<double>(cell) + random.uniform(-0.4, 0.4)) * pitch;
  };
  std::vector<Ball> balls;
  for (std::int64_t k = 0; k < count; ++k) {
    const double x = at(k % across), y = at(k / across % across), z = at(k / across / across);
    balls.push_back({{x, y, z}, random.uniform(0.005, 0.0095)});
  }
  return balls;
}

void count_spheres(benchmark::State& state) {
  state.counters["sphere"] =
      benchmark::Counter(static_cast<double>(state.range(0)),
                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

template <class Search>
void search(benchmark::State& state) {
  const std::vector<Ball> balls = made_balls(state.range(0));
  Workers workers{static_cast<unsigned>(state.range(1))};
  Search search;
  CandidateRows rows;
  for (auto _ : state) {
    search.find(balls, balls.size(), margin, workers, rows);
    benchmark::ClobberMemory();
  }
  count_spheres(state);
  state.counters["pairs_per_sphere"] = static_cast<double>(rows.total()) / static_cast<double>(balls.size());
}

/// From candidates to the list that the time step reads, histories carried over: what follows every search.
void renew_pair_list(benchmark::State& state) {
  const std::vector<Ball> balls = made_balls(state.range(0));
  Workers workers{static_cast<unsigned>(state.range(1))};
  CandidateRows rows;
  CellGrid{}.find(balls, balls.size(), margin, workers, rows);
  PairList<double, 3> pairs;
  for (auto _ : state) {
    pairs.renew(balls.size(), workers, [&rows](std::size_t i, std::vector<Partner>& row) {
      for (const std::uint32_t j : rows.row(i)) {
        row.push_back({j & Partner::most, Partner::here});
      }
    });
    benchmark::ClobberMemory();
  }
  count_spheres(state);
}

void sizes(benchmark::internal::Benchmark* b) {
  b->ArgNames({"spheres", "threads"})->UseRealTime()->Unit(benchmark::kMillisecond);
  for (const std::int64_t n : {5'000, 20'000, 100'000}) {
    for (const std::int64_t threads : {1, 2}) {
      b->Args({n, threads});
    }
  }
}

} // namespace

BENCHMARK_TEMPLATE(search, CellGrid)->Apply(sizes);
BENCHMARK_TEMPLATE(search, RTree)->Apply(sizes);
BENCHMARK_TEMPLATE(search, AllPairs)
    ->ArgNames({"spheres", "threads"})
    ->Args({5'000, 1})
    ->Unit(benchmark::kMillisecond);
BENCHMARK(renew_pair_list)->Apply(sizes);
