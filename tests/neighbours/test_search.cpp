#include "scree/core/random.hpp"
#include "scree/neighbours/all_pairs.hpp"
#include "scree/neighbours/cell_grid.hpp"
#include "scree/neighbours/r_tree.hpp"
#include "scree/neighbours/verlet_list.hpp"
#include "support/relative_error.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

using namespace scree;

namespace {

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

/// From the definition, in long double, with nothing of the library: all i < k, i owned, with a gap of at
/// most `margin`.
Pairs by_definition(const std::vector<Ball>& balls, std::size_t owned, double margin) {
  Pairs pairs;
  for (std::uint32_t i = 0; i < owned; ++i) {
    for (std::uint32_t k = i + 1; k < balls.size(); ++k) {
      const long double x = static_cast<long double>(balls[i].centre.x) - balls[k].centre.x;
      const long double y = static_cast<long double>(balls[i].centre.y) - balls[k].centre.y;
      const long double z = static_cast<long double>(balls[i].centre.z) - balls[k].centre.z;
      if (std::sqrt(x * x + y * y + z * z) <=
          static_cast<long double>(balls[i].radius) + balls[k].radius + margin) {
        pairs.emplace_back(i, k);
      }
    }
  }
  return pairs;
}

template <class Search>
Pairs found_by(Search search, const std::vector<Ball>& balls, std::size_t owned, double margin,
               unsigned threads = 1) {
  Workers workers{threads};
  CandidateRows rows;
  search.find(balls, owned, margin, workers, rows);
  Pairs pairs;
  REQUIRE(rows.size() == owned);
  for (std::uint32_t i = 0; i < owned; ++i) {
    for (const std::uint32_t k : rows.row(i)) {
      pairs.emplace_back(i, k);
    }
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

Vec3<double> somewhere(Random& random, const Vec3<double>& size) {
  return {random.uniform(0.0, size.x), random.uniform(0.0, size.y), random.uniform(0.0, size.z)};
}

std::vector<Ball> spread(Random& random, std::size_t count, double least, double most,
                         const Vec3<double>& size) {
  std::vector<Ball> balls;
  for (std::size_t k = 0; k < count; ++k) {
    balls.push_back({somewhere(random, size), random.uniform(least, most)});
  }
  return balls;
}

std::vector<Ball> clustered(Random& random, std::size_t count, std::size_t clusters) {
  std::vector<Ball> balls;
  const auto centres = spread(random, clusters, 1.0, 1.0, {1000.0, 1000.0, 1000.0});
  for (std::size_t k = 0; k < count; ++k) {
    const Vec3<double> off{random.normal(), random.normal(), random.normal()};
    balls.push_back({centres[random.index(clusters)].centre + 2.0 * off, random.uniform(0.1, 0.5)});
  }
  return balls;
}

struct Scene {
  std::string name;
  std::vector<Ball> balls;
};

std::vector<Scene> scenes() {
  Random random{131};
  std::vector<Scene> all{
      {"much alike", spread(random, 600, 0.45, 0.55, {10, 10, 10})},
      {"polydisperse", spread(random, 600, 0.01, 1.5, {10, 10, 10})},
      {"flat layer", spread(random, 500, 0.1, 0.6, {20, 20, 0})},
      {"line", spread(random, 300, 0.1, 0.6, {0, 100, 0})},
      {"clusters far apart", clustered(random, 500, 5)},
      {"a few far apart", spread(random, 12, 0.1, 2500.0, {1e4, 1e4, 1e4})},
      {"in one place", spread(random, 40, 0.1, 0.6, {0, 0, 0})},
      {"one", spread(random, 1, 0.1, 0.6, {1, 1, 1})},
      {"none", {}},
  };
  all.push_back({"far from the origin", all[0].balls});
  for (Ball& ball : all.back().balls) {
    ball.centre += Vec3<double>{-12345.6, 54321.0, 1e6};
  }
  // On a lattice with the very distance at which pairs count: the boundary cells of a grid.
  all.push_back({"lattice", {}});
  for (int i = 0; i < 512; ++i) {
    all.back().balls.push_back({{1.0 * (i % 8), 1.0 * (i / 8 % 8), 1.0 * (i / 64)}, 0.5});
  }
  all.push_back({"two giants among dust", spread(random, 400, 0.01, 0.02, {10, 10, 10})});
  all.back().balls.push_back({{2, 3, 4}, 3.0});
  all.back().balls.push_back({{7, 6, 5}, 2.5});
  return all;
}

} // namespace

TEST_CASE_TEMPLATE("a search finds exactly the pairs within the margin", Search, AllPairs, CellGrid, RTree,
                   VerletList<AllPairs>, VerletList<CellGrid>, VerletList<RTree>) {
  for (const Scene& scene : scenes()) {
    CAPTURE(scene.name);
    for (const double margin : {0.0, 0.03, 1.0}) {
      CAPTURE(margin);
      const std::size_t n = scene.balls.size();
      // Those from `owned` on are images: partners, but without a row of their own.
      for (const std::size_t owned : {n, n - n / 4, n / 3}) {
        const Pairs expected = by_definition(scene.balls, owned, margin);
        CHECK(found_by(Search{}, scene.balls, owned, margin) == expected);
        CHECK(found_by(Search{}, scene.balls, owned, margin, 3) == expected);
      }
    }
  }
}

TEST_CASE("the scenes hold both pairs and gaps") {
  for (const Scene& scene : scenes()) {
    CAPTURE(scene.name);
    const std::size_t n = scene.balls.size();
    const Pairs pairs = by_definition(scene.balls, n, 0.0);
    CHECK(std::is_sorted(pairs.begin(), pairs.end()));
    if (n > 1) {
      CHECK(!pairs.empty());
      CHECK((pairs.size() < n * (n - 1) / 2 || scene.name == "in one place"));
    }
  }
}

TEST_CASE_TEMPLATE("a search can be used again, for other balls", Search, AllPairs, CellGrid, RTree,
                   VerletList<CellGrid>) {
  Search search;
  Workers workers{2};
  CandidateRows rows;
  for (const Scene& scene : scenes()) {
    CAPTURE(scene.name);
    search.find(scene.balls, scene.balls.size(), 0.1, workers, rows);
    CHECK(rows.total() == by_definition(scene.balls, scene.balls.size(), 0.1).size());
  }
}

TEST_CASE("only a Verlet list may outlive its making") {
  CHECK(AllPairs{}.skin(0.1) == 0.0);
  CHECK(CellGrid{}.skin(0.1) == 0.0);
  CHECK(RTree{}.skin(0.1) == 0.0);
  CHECK(VerletList<CellGrid>{}.skin(0.1) == test::about(0.03));
  CHECK(VerletList<CellGrid>{.share = 0.5}.skin(0.1) == test::about(0.05));
  CHECK(VerletList<CellGrid>{.thickness = 0.02, .share = 0.5}.skin(0.1) == 0.02);
}
