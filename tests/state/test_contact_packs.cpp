#include "scree/state/contact_packs.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cstddef>
#include <vector>

using namespace scree;

TEST_CASE("packs hold pairs with their histories, and a sphere with itself in the lanes left over") {
  constexpr std::size_t width = 4;
  std::vector<SphereRecord<double>> spheres(20);
  for (std::size_t s = 0; s < spheres.size(); ++s) {
    spheres[s].radius = 0.01 * static_cast<double>(s + 1);
    spheres[s].inverse_mass = 1.0 / static_cast<double>(s + 1);
    spheres[s].material = s < 10 ? 0 : 1;
  }
  ContactPacks<double, 2, width> packs;
  struct Given {
    std::size_t i;
    std::uint32_t j, number;
  };
  const std::vector<Given> given{{0, 1, 3}, {0, 2, 5}, {1, 2, 8}, {2, 7, 9}, {3, 12, 20}, {4, 13, 21}};
  for (int repeat = 0; repeat < 2; ++repeat) { // used again, it forgets what it held
    packs.clear();
    CHECK(packs.size() == 0);
    for (const Given& g : given) {
      packs.add(g.i, {g.j & Partner::most, Partner::here}, g.number);
    }
    packs.finish(spheres, [](std::uint32_t number) { return std::array{1.0 * number, -2.0 * number}; });
    REQUIRE(packs.size() == given.size());
    REQUIRE(packs.pack_count() == 2);
    for (std::size_t k = 0; k < given.size(); ++k) {
      const Given& g = given[k];
      CAPTURE(k);
      CHECK(packs.pair(k).i == g.i);
      CHECK(packs.pair(k).j == g.j);
      CHECK(packs.pair(k).image == Partner::here);
      CHECK(packs.pair(k).number == g.number);
      CHECK(packs.history(k) == std::array{1.0 * g.number, -2.0 * g.number});
      const auto& pack = packs.pack(k / width);
      const std::size_t lane = k % width;
      CHECK(pack.sphere_i[lane] == g.i * 96);
      CHECK(pack.sphere_j[lane] == g.j * 96);
      CHECK(pack.force_i[lane] == g.i * 64);
      CHECK(pack.force_j[lane] == g.j * 64);
      CHECK(pack.reach[lane] == spheres[g.i].radius + spheres[g.j].radius);
      CHECK(pack.root_mass[lane] == 1.0 / std::sqrt(spheres[g.i].inverse_mass + spheres[g.j].inverse_mass));
    }
    for (const std::size_t lane : {std::size_t{2}, std::size_t{3}}) {
      CHECK(packs.pack(1).sphere_i[lane] == packs.pack(1).sphere_j[lane]);
      CHECK(packs.pack(1).sphere_i[lane] == 4 * 96);
    }
    CHECK(packs.materials(0).alike);
    CHECK(packs.materials(1).alike); // 0 and 1 in both lanes that count
    CHECK(packs.materials(1).j == 1);
  }
  packs.clear();
  packs.add(0, {1, Partner::here}, 0);
  packs.add(1, {12, Partner::here}, 1);
  packs.finish(spheres, [](std::uint32_t) { return std::array{0.0, 0.0}; });
  CHECK_FALSE(packs.materials(0).alike);
}
