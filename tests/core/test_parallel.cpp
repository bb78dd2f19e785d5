#include "scree/core/parallel.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

using namespace scree;

namespace {

std::string thrown_by(Workers& workers, std::size_t count, const std::vector<std::size_t>& failing) {
  try {
    workers.for_each(count, [&](std::size_t k) {
      if (std::find(failing.begin(), failing.end(), k) != failing.end()) {
        throw std::runtime_error("task " + std::to_string(k));
      }
    });
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  return "nothing";
}

} // namespace

TEST_CASE("a parallel loop calls every task once, whatever the size of the team") {
  for (const unsigned threads : {1U, 2U, 5U}) {
    CAPTURE(threads);
    Workers workers{threads};
    CHECK(workers.size() == threads);
    for (const std::size_t count : {0U, 1U, 2U, 7U, 1000U}) {
      CAPTURE(count);
      std::vector<std::atomic<int>> calls(count);
      workers.for_each(count, [&](std::size_t k) { ++calls[k]; });
      CHECK(std::all_of(calls.begin(), calls.end(), [](const auto& c) { return c.load() == 1; }));
    }
  }
}

TEST_CASE("a team of no given size has one thread for each processor") {
  CHECK(Workers{}.size() == std::max(1U, std::thread::hardware_concurrency()));
}

TEST_CASE("what the tasks of one loop wrote is seen by those of the next") {
  // Short loops right behind each other are where a thread that wakes late would do harm.
  Workers workers{4};
  std::vector<std::size_t> a(64, 0), b(64, 0);
  for (std::size_t loop = 1; loop <= 300; ++loop) {
    workers.for_each(a.size(), [&](std::size_t k) { a[k] = b[a.size() - 1 - k] + 1; });
    workers.for_each(a.size(), [&](std::size_t k) { b[k] = a[a.size() - 1 - k]; });
  }
  CHECK(b == std::vector<std::size_t>(64, 300));
}

TEST_CASE("a parallel loop throws what its smallest failing task threw, and can be used again") {
  for (const unsigned threads : {1U, 4U}) {
    CAPTURE(threads);
    Workers workers{threads};
    for (int attempt = 0; attempt < 50; ++attempt) {
      REQUIRE(thrown_by(workers, 200, {180, 17, 18, 99}) == "task 17");
      REQUIRE(thrown_by(workers, 200, {199}) == "task 199");
      REQUIRE(thrown_by(workers, 200, {}) == "nothing");
    }
    std::atomic<int> calls = 0;
    workers.for_each(100, [&](std::size_t) { ++calls; });
    CHECK(calls.load() == 100);
  }
}

TEST_CASE("a failing task of a team does not keep the others from running") {
  Workers workers{3};
  std::vector<std::atomic<int>> calls(50);
  CHECK_THROWS_AS(workers.for_each(calls.size(),
                                   [&](std::size_t k) {
                                     ++calls[k];
                                     if (k % 2 == 0) {
                                       throw std::runtime_error("even");
                                     }
                                   }),
                  std::runtime_error);
  CHECK(std::all_of(calls.begin(), calls.end(), [](const auto& c) { return c.load() == 1; }));
}
