#include "scree/core/random.hpp"
#include "scree/state/pair_list.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

using namespace scree;

namespace {

/// Two history numbers, of which the first turns its sign with the order of the pair.
using List = PairList<double, 2>;
constexpr std::array<int, 2> parity{-1, 1};
using Key = std::pair<std::uint32_t, std::uint32_t>; // of what a sphere is called, whatever its number
using Pairs = std::set<std::pair<std::size_t, std::size_t>>;

void renew(List& list, std::size_t spheres, const Pairs& pairs, Workers& workers) {
  list.renew(spheres, workers, [&](std::size_t i, std::vector<Partner>& row) {
    // Backwards: the order within a row is the list's own affair.
    for (auto pair = pairs.rbegin(); pair != pairs.rend(); ++pair) {
      if (pair->first == i) {
        row.push_back({static_cast<std::uint32_t>(pair->second) & Partner::most, Partner::here});
      }
    }
  });
}

Pairs some_pairs(Random& random, std::size_t spheres, double share) {
  Pairs pairs;
  for (std::size_t i = 0; i < spheres; ++i) {
    for (std::size_t j = i + 1; j < spheres; ++j) {
      if (random.uniform() < share) {
        pairs.insert({i, j});
      }
    }
  }
  return pairs;
}

} // namespace

TEST_CASE("pairs keep their history over renewals, moves to other numbers and removals") {
  Random random{141};
  Workers workers{2};
  List list;
  std::size_t spheres = 60;
  std::vector<std::uint32_t> names(spheres); // what each sphere is called
  std::iota(names.begin(), names.end(), 0U);
  std::map<Key, std::array<double, 2>> truth; // seen from the sphere with the smaller name
  std::size_t carried = 0;
  for (int round = 0; round < 60; ++round) {
    const Pairs pairs = some_pairs(random, spheres, 0.3);
    renew(list, spheres, pairs, workers);
    REQUIRE(list.size() == pairs.size());
    std::map<Key, std::array<double, 2>> next;
    auto expected = pairs.begin();
    for (std::size_t i = 0; i < spheres; ++i) {
      for (std::size_t pair = list.begin_of(i); pair < list.begin_of(i + 1); ++pair, ++expected) {
        const std::size_t j = list.partner(pair).sphere;
        REQUIRE(*expected == std::pair{i, j}); // ascending in j
        REQUIRE(list.partner(pair).image == Partner::here);
        const double sign = names[i] < names[j] ? 1.0 : -1.0;
        const Key key = std::minmax(names[i], names[j]);
        const auto before = truth.count(key) > 0 ? truth.at(key) : std::array{0.0, 0.0};
        REQUIRE(list.history(pair)[0] == sign * before[0]);
        REQUIRE(list.history(pair)[1] == before[1]);
        carried += before[0] != 0.0;
        // A contact begins, goes on, or ends.
        if (random.index(3) == 0) {
          next[key] = {0.0, 0.0};
        } else {
          next[key] = {random.normal(), random.normal()};
        }
        list.history(pair) = {sign * next[key][0], next[key][1]};
      }
    }
    truth = next; // pairs that left the list have ended

    // Some spheres go, the rest is put into another order.
    std::vector<std::uint32_t> order(spheres);
    std::iota(order.begin(), order.end(), 0U);
    random.shuffle(std::span<std::uint32_t>{order});
    if (round % 10 == 5) {
      order.resize(order.size() - 5);
    }
    std::vector<std::uint32_t> moved_to(spheres, Bodies<double>::gone), renamed;
    for (const std::uint32_t old : order) {
      moved_to[old] = static_cast<std::uint32_t>(renamed.size());
      renamed.push_back(names[old]);
    }
    list.rearrange(moved_to, order.size(), parity, workers);
    names = renamed;
    spheres = order.size();
  }
  CHECK(carried > 1000);
}

TEST_CASE("a list may be renewed for more spheres than before") {
  Workers workers{1};
  List list;
  renew(list, 3, {{0, 1}, {1, 2}}, workers);
  list.history(0) = {1.0, 2.0};
  list.history(1) = {3.0, 4.0};
  renew(list, 5, {{0, 1}, {0, 4}, {1, 2}, {3, 4}}, workers);
  CHECK(list.row_count() == 5);
  CHECK(list.history(0) == std::array{1.0, 2.0});
  CHECK(list.history(1) == std::array{0.0, 0.0});
  CHECK(list.history(2) == std::array{3.0, 4.0});
  CHECK(list.history(3) == std::array{0.0, 0.0});
}
