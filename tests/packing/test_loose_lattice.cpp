#include "scree/packing/loose_lattice.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

using namespace scree;

namespace {

const Eigen::AlignedBox3d footprint{Vector{-0.2, 0.1, 0.5}, Vector{0.3, 0.4, 0.6}};

struct LooseRock {
  std::vector<Clump> shapes;
  std::vector<DrawnClump> drawn;
  Packing packing;

  LooseRock(std::size_t count, std::uint64_t seed, double gap = 0.02) {
    const Assembly assembly{default_rock()};
    Random random{seed};
    shapes = assembly.clumps();
    drawn = assembly.draw(count, random);
    packing = loose_lattice(shapes, drawn, footprint, random, gap);
  }
};

double bounding_radius(const Packing& packing, const PackedBody& b) {
  return b.scale * packing.shapes[b.shape].bounding_radius;
}

} // namespace

TEST_CASE("no two bounding spheres of a loose lattice touch, whatever the gap") {
  for (const double gap : {0.0, 0.02, 0.5}) {
    const LooseRock rock{700, 31, gap};
    const auto& bodies = rock.packing.bodies;
    double least = std::numeric_limits<double>::infinity(); // distance over the sum of radii
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      for (std::size_t j = i + 1; j < bodies.size(); ++j) {
        const double radii =
            bounding_radius(rock.packing, bodies[i]) + bounding_radius(rock.packing, bodies[j]);
        least = std::min(least, (bodies[i].position - bodies[j].position).norm() / radii);
      }
    }
    CHECK(least > 1.0 + gap - 1e-9);
    CHECK(least < 2.0 + gap); // neighbours exist
  }
}

TEST_CASE("member spheres stay inside the sides and above the bottom") {
  const LooseRock rock{1500, 32};
  for (const PackedBody& b : rock.packing.bodies) {
    for (const Sphere& s : spheres_in_space(rock.packing, b)) {
      CHECK(((s.centre - footprint.min()).array() > s.radius).all());
      CHECK(((footprint.max() - s.centre).head<2>().array() > s.radius).all());
    }
  }
}

TEST_CASE("a loose lattice holds what was drawn, at rest, turned every way") {
  const LooseRock rock{4000, 33};
  REQUIRE(rock.packing.bodies.size() == rock.drawn.size());
  Vector mean_axis = Vector::Zero();
  for (std::size_t i = 0; i < rock.drawn.size(); ++i) {
    const PackedBody& b = rock.packing.bodies[i];
    CHECK(b.shape == rock.drawn[i].shape);
    CHECK(b.scale == rock.drawn[i].scale);
    CHECK(b.velocity == Vector::Zero());
    CHECK(b.angular_velocity == Vector::Zero());
    CHECK(!b.fixed);
    mean_axis += b.orientation * Vector::UnitX() / 4000.0;
  }
  // The mean of n random unit vectors has components of standard deviation 1 / sqrt(3 n).
  CHECK(mean_axis.cwiseAbs().maxCoeff() < 5.0 / std::sqrt(3.0 * 4000.0));
}

TEST_CASE("a loose lattice fills from the bottom and is not wasteful with small grains") {
  const LooseRock rock{4000, 34};
  double top = footprint.min().z();
  std::size_t low = 0;
  for (const PackedBody& b : rock.packing.bodies) {
    top = std::max(top, b.position.z() + bounding_radius(rock.packing, b));
  }
  for (const PackedBody& b : rock.packing.bodies) {
    low += b.position.z() < 0.5 * (footprint.min().z() + top);
  }
  CHECK(low > 1800);
  CHECK(low < 2200);
  const double bulk = (top - footprint.min().z()) * footprint.sizes().x() * footprint.sizes().y();
  CHECK(solid_volume(rock.packing) / bulk > 0.03);
}

TEST_CASE("the same seed gives the same lattice") {
  const LooseRock a{300, 35}, b{300, 35}, c{300, 36};
  for (std::size_t i = 0; i < 300; ++i) {
    CHECK(a.packing.bodies[i].position == b.packing.bodies[i].position);
    CHECK(a.packing.bodies[i].orientation.coeffs() == b.packing.bodies[i].orientation.coeffs());
    CHECK(a.packing.bodies[i].position != c.packing.bodies[i].position);
  }
}

TEST_CASE("a loose lattice refuses what it cannot place") {
  const std::vector<Clump> shapes{make_clump("ball", single_sphere())};
  Random random{37};
  const auto place = [&](const DrawnClump& d) {
    (void)loose_lattice(shapes, std::vector<DrawnClump>{d}, footprint, random);
  };
  CHECK_NOTHROW(place({0, 0.1}));
  CHECK_THROWS_AS(place({1, 0.1}), Error);
  CHECK_THROWS_AS(place({0, 0.0}), Error);
  CHECK_THROWS_AS(place({0, 0.4}), Error); // wider than the footprint
  CHECK_THROWS_AS((void)loose_lattice(shapes, {}, footprint, random, -0.1), Error);
  CHECK(loose_lattice(shapes, {}, footprint, random).bodies.empty());
}
