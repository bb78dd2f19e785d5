#include "scree/packing/loose_pile.hpp"
#include "support/relative_error.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

using namespace scree;

namespace loose_pile_tests {

namespace {

const Eigen::AlignedBox3d footprint{Vector{-0.2, 0.1, 0.5}, Vector{0.0, 0.25, 0.6}};

Packing pile(std::size_t count, std::uint64_t seed, double gap = 0.01, std::size_t trials = 10) {
  const Assembly assembly{default_rock()};
  Random random{seed};
  const auto drawn = assembly.draw(count, random);
  return loose_pile(assembly.clumps(), drawn, footprint, random, gap, trials);
}

double solid_fraction(const Packing& packing) {
  double top = footprint.min().z();
  for (const PackedBody& b : packing.bodies) {
    for (const Sphere& s : spheres_in_space(packing, b)) {
      top = std::max(top, s.centre.z() + s.radius);
    }
  }
  const double bulk = (top - footprint.min().z()) * footprint.sizes().x() * footprint.sizes().y();
  return solid_volume(packing) / bulk;
}

} // namespace

TEST_CASE("bodies of a loose pile do not overlap, and each has come to something that stops it") {
  const double gap = 0.03;
  const Packing packing = pile(250, 41, gap);
  std::vector<std::vector<Sphere>> spheres;
  for (const PackedBody& b : packing.bodies) {
    spheres.push_back(spheres_in_space(packing, b));
  }
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    // Distance to earlier bodies over the sum of radii, and to the bottom over the radius.
    double nearest = std::numeric_limits<double>::infinity();
    for (const Sphere& s : spheres[i]) {
      nearest = std::min(nearest, (s.centre.z() - footprint.min().z()) / s.radius);
      for (std::size_t j = 0; j < i; ++j) {
        for (const Sphere& other : spheres[j]) {
          nearest = std::min(nearest, (s.centre - other.centre).norm() / (s.radius + other.radius));
        }
      }
    }
    CHECK(nearest == test::about(1.0 + gap, 1e-9));
  }
}

TEST_CASE("a loose pile stays inside the sides and above the bottom") {
  const Packing packing = pile(400, 42);
  for (const PackedBody& b : packing.bodies) {
    CHECK(b.velocity == Vector::Zero());
    for (const Sphere& s : spheres_in_space(packing, b)) {
      CHECK(((s.centre - footprint.min()).array() > s.radius).all());
      CHECK(((footprint.max() - s.centre).head<2>().array() > s.radius).all());
    }
  }
}

TEST_CASE("more trials give a denser pile") {
  const double once = solid_fraction(pile(600, 43, 0.01, 1));
  const double often = solid_fraction(pile(600, 43, 0.01, 10));
  CHECK(once > 0.05);
  CHECK(often > 2.0 * once);
}

TEST_CASE("the same seed gives the same pile of what was drawn") {
  const Packing a = pile(100, 44), b = pile(100, 44), c = pile(100, 45);
  for (std::size_t i = 0; i < 100; ++i) {
    CHECK(a.bodies[i].position == b.bodies[i].position);
    CHECK(a.bodies[i].orientation.coeffs() == b.bodies[i].orientation.coeffs());
    CHECK(a.bodies[i].position != c.bodies[i].position);
  }
  const Assembly assembly{default_rock()};
  Random random{44};
  const auto drawn = assembly.draw(100, random);
  for (std::size_t i = 0; i < 100; ++i) {
    CHECK(a.bodies[i].shape == drawn[i].shape);
    CHECK(a.bodies[i].scale == drawn[i].scale);
  }
}

TEST_CASE("a loose pile refuses what it cannot place") {
  const std::vector<Clump> shapes{make_clump("ball", single_sphere())};
  Random random{46};
  const auto place = [&](const DrawnClump& d, double gap, std::size_t trials) {
    (void)loose_pile(shapes, std::vector<DrawnClump>{d}, footprint, random, gap, trials);
  };
  CHECK_NOTHROW(place({0, 0.1}, 0.0, 1));
  CHECK_THROWS_AS(place({1, 0.1}, 0.0, 1), Error);
  CHECK_THROWS_AS(place({0, -0.1}, 0.0, 1), Error);
  CHECK_THROWS_AS(place({0, 0.2}, 0.0, 1), Error); // wider than the footprint
  CHECK_THROWS_AS(place({0, 0.1}, -0.1, 1), Error);
  CHECK_THROWS_AS(place({0, 0.1}, 0.0, 0), Error);
  CHECK(loose_pile(shapes, {}, footprint, random).bodies.empty());
}

} // namespace loose_pile_tests
