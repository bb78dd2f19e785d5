#include "paper_gap/design.hpp"
#include "paper_gap/findings.hpp"
#include "support/relative_error.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <set>
#include <vector>

using namespace paper_gap;
namespace test = scree::test;

namespace {

/// Replicates that lie evenly about what the factors make of a response.
std::vector<Response> responses(const std::array<double, factor_count>& effects, double of_two,
                                double spread) {
  std::vector<Response> out;
  const std::vector<Levels> runs = design();
  for (std::size_t r = 0; r < runs.size(); ++r) {
    double value = 5.0 + 0.5 * of_two * runs[r][0] * runs[r][1];
    for (std::size_t f = 0; f < factor_count; ++f) {
      value += 0.5 * effects[f] * runs[r][f];
    }
    for (const double off : {-spread, 0.0, spread}) {
      out.push_back({r, value + off});
    }
  }
  return out;
}

/// The same force and pitch all the way.
Outcome even_outcome(double force, double pitch) {
  return {.force = std::vector<double>(pieces, force),
          .pitch = std::vector<double>(pieces, pitch),
          .depth = std::vector<double>(pieces, 0.0),
          .mass = std::vector<double>(pieces, 0.0),
          .lift = std::vector<double>(pieces, 0.0),
          .porosity = 0.4,
          .bulk_density = 900.0,
          .grains = 1.0};
}

} // namespace

TEST_CASE("the design is balanced, and mixes no main effect with another or with one of two factors") {
  const std::vector<Levels> runs = design();
  CHECK(std::set<Levels>(runs.begin(), runs.end()).size() == 16);
  const auto sum = [&](const auto& product) {
    return std::accumulate(runs.begin(), runs.end(), 0,
                           [&](int s, const Levels& l) { return s + product(l); });
  };
  for (std::size_t i = 0; i < factor_count; ++i) {
    CHECK(sum([&](const Levels& l) { return l[i]; }) == 0);
    for (std::size_t j = i + 1; j < factor_count; ++j) {
      CHECK(sum([&](const Levels& l) { return l[i] * l[j]; }) == 0);
      for (std::size_t k = 0; k < factor_count; ++k) {
        if (k != i && k != j) {
          CHECK(sum([&](const Levels& l) { return l[i] * l[j] * l[k]; }) == 0);
        }
      }
    }
  }
}

TEST_CASE("every effect of two factors is in one group with those that share its column") {
  const std::vector<AliasGroup> groups = alias_groups();
  CHECK(groups.size() == 7);
  CHECK(groups.front().name == "bed x packing, wall friction x clump mass");
}

TEST_CASE("effects that were put in are found, with the errors that the scatter gives") {
  const std::array<double, factor_count> effects{0.5, 0.0, -0.2, 0.1, 0.0, 0.9};
  const Analysis found = analysed(responses(effects, 0.3, 0.1));
  CHECK(found.mean == test::about(5.0));
  CHECK(found.replicated);
  CHECK(found.freedom == 32.0);
  CHECK(found.scatter == test::about(0.1));
  REQUIRE(found.main.size() == factor_count);
  for (std::size_t f = 0; f < factor_count; ++f) {
    CHECK(std::abs(found.main[f].value - effects[f]) < 1e-12);
    CHECK(found.main[f].error == test::about(2.0 * 0.1 / std::sqrt(48.0)));
  }
  REQUIRE(found.interactions.size() == 7);
  CHECK(found.interactions[0].value == test::about(0.3));
  CHECK(std::abs(found.interactions[1].value) < 1e-12);
}

TEST_CASE("where runs failed in every replicate, effects have wider errors, and in the end there are none") {
  std::vector<Response> all = responses({0.5, 0.0, 0.0, 0.0, 0.0, 0.0}, 0.0, 0.1), most;
  for (Response& r : all) {
    if (r.run == 7) {
      r.value = std::nan("");
    }
  }
  const Analysis found = analysed(all);
  REQUIRE(found.main.size() == factor_count);
  CHECK(found.main[0].value == test::about(0.5));
  CHECK(found.main[0].error > 2.0 * 0.1 / std::sqrt(48.0));
  for (const Response& r : all) {
    if (r.run < 12) {
      most.push_back(r);
    }
  }
  CHECK(analysed(most).main.size() == factor_count);
  CHECK(analysed(most).interactions.empty());
  most.resize(3 * 6);
  CHECK(analysed(most).main.empty());
}

TEST_CASE("without replicates, errors are from what main effects leave") {
  std::vector<Response> one;
  for (const Response& r : responses({0.5, 0, 0, 0, 0, 0}, 0.4, 0.0)) {
    if (one.empty() || one.back().run != r.run) {
      one.push_back(r);
    }
  }
  const Analysis found = analysed(one);
  CHECK_FALSE(found.replicated);
  CHECK(found.freedom == 9.0);
  // The effect of two factors is a fifth of a unit up and down over all runs.
  CHECK(found.scatter == test::about(0.2 * std::sqrt(16.0 / 9.0)));
  CHECK(found.main.at(0).value == test::about(0.5));
  CHECK(found.main.at(0).error == test::about(2.0 * found.scatter / 4.0));
}

TEST_CASE("a bucket that fell over is left out where depths are compared with those that follow from pitch") {
  const Base base{true};
  std::vector<Done> runs;
  for (const double last : {-6.5, -86.3}) {
    Outcome outcome = even_outcome(150.0, -6.5);
    outcome.pitch[pieces - 2] = last;
    const Case one{design().front(), Motion::free, 1};
    runs.push_back({.of = one, .run = 0, .in_design = true, .outcome = outcome, .failure = ""});
  }
  const Findings all = found(base, runs);
  CHECK(all.depth.runs == 1);
  CHECK(std::isfinite(all.depth.by_pitch_end.value));
}

TEST_CASE("a run agrees with what the paper states only where forces and pitch do") {
  const Base base{true};
  const auto agreement = [&](double near, double end, double pitch) {
    Outcome outcome = even_outcome(near, pitch);
    outcome.force[pieces - 1] = outcome.force[pieces - 2] = end;
    std::vector<Done> runs;
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
      const Case one{design().front(), Motion::free, seed};
      runs.push_back({.of = one, .run = 0, .in_design = true, .outcome = outcome, .failure = ""});
    }
    return found(base, runs).agreements.at(0);
  };
  CHECK(agreement(150, 500, -6.5).with_measured);
  CHECK(agreement(120, 600, -5.0).with_measured);
  CHECK_FALSE(agreement(150, 1500, -6.5).with_measured);
  CHECK_FALSE(agreement(150, 500, -9.0).with_measured);
  CHECK_FALSE(agreement(100, 500, -6.5).with_measured);
  CHECK(agreement(150, 1500, -10.0).with_simulated);
  CHECK_FALSE(agreement(150, 500, -10.0).with_simulated);
}
