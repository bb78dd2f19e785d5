#include "scree/packing/loose_pile.hpp"

#include <doctest/doctest.h>

#include <cstddef>

using namespace scree;

TEST_CASE("a pile on a circle lies within it, stands on its floor and overlaps nowhere") {
  Random random{5};
  const Assembly assembly{default_rock(), 1.0};
  const auto drawn = assembly.draw(300, random);
  const RoundFootprint circle{.radius = 0.12, .floor = -0.3};
  const Packing pile = loose_pile(assembly.clumps(), drawn, circle, random);
  REQUIRE(pile.bodies.size() == drawn.size());
  std::vector<std::vector<Sphere>> spheres;
  for (const PackedBody& body : pile.bodies) {
    spheres.push_back(spheres_in_space(pile, body));
  }
  double lowest = 1.0;
  for (std::size_t a = 0; a < spheres.size(); ++a) {
    for (const Sphere& s : spheres[a]) {
      CHECK(s.centre.head<2>().norm() + s.radius <= circle.radius);
      lowest = std::min(lowest, s.centre.z() - s.radius);
      for (std::size_t b = a + 1; b < spheres.size(); ++b) {
        for (const Sphere& t : spheres[b]) {
          REQUIRE((s.centre - t.centre).norm() >= s.radius + t.radius);
        }
      }
    }
  }
  CHECK(lowest >= circle.floor);
  CHECK(lowest < circle.floor + 1e-3);
  CHECK_THROWS_WITH_AS(loose_pile(assembly.clumps(), drawn, RoundFootprint{0.0, 0.0}, random),
                       doctest::Contains("radius of the footprint"), Error);
  CHECK_THROWS_WITH_AS(loose_pile(assembly.clumps(), drawn, RoundFootprint{0.01, 0.0}, random),
                       doctest::Contains("does not hold the largest body"), Error);
}
