#include "scree/geometry/cylinder.hpp"

#include "scree/core/random.hpp"
#include "support/relative_error.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <utility>

using namespace scree;

namespace {

SurfaceContacts touch(const Cylinder& cylinder, const Vector& centre, double radius) {
  SurfaceContacts contacts;
  cylinder.touch(centre, radius, contacts);
  return contacts;
}

const Cylinder tube = checked({.base = {1, 2, 3}, .axis = {0, 0, 5}, .radius = 0.5, .length = 2.0});
const Cylinder roller = checked(
    {.base = {1, 2, 3}, .axis = {0, 0, 5}, .radius = 0.5, .length = 2.0, .side = Cylinder::Side::outside});

} // namespace

TEST_CASE("a sphere inside a tube is pushed towards the axis") {
  CHECK(touch(tube, {1.3, 2.0, 4.0}, 0.19).empty());
  const auto contacts = touch(tube, {1.3, 2.0, 4.0}, 0.21);
  REQUIRE(contacts.size() == 1);
  CHECK(contacts[0].overlap == test::about(0.01));
  CHECK((contacts[0].normal - Vector{-1, 0, 0}).norm() < 1e-15);
  CHECK((contacts[0].point - Vector{1.5, 2.0, 4.0}).norm() < 1e-15);
}

TEST_CASE("a sphere on a roller is pushed away from the axis") {
  CHECK(touch(roller, {1.0, 2.7, 3.5}, 0.19).empty());
  const auto contacts = touch(roller, {1.0, 2.7, 3.5}, 0.21);
  REQUIRE(contacts.size() == 1);
  CHECK(contacts[0].overlap == test::about(0.01));
  CHECK((contacts[0].normal - Vector{0, 1, 0}).norm() < 1e-15);
  CHECK((contacts[0].point - Vector{1.0, 2.5, 3.5}).norm() < 1e-15);
}

TEST_CASE("beyond an end a sphere touches the rim, from either side of the mantle") {
  for (const double end : {3.0, 5.0}) {
    const double beyond = end == 3.0 ? -0.03 : 0.03;
    for (const double off : {0.46, 0.54}) {
      const Vector centre{1.0 + off, 2.0, end + beyond};
      const Vector rim{1.5, 2.0, end};
      for (const Cylinder& cylinder : {tube, roller}) {
        CHECK(touch(cylinder, centre, 0.0499).empty()); // 0.05 away
        const auto contacts = touch(cylinder, centre, 0.06);
        REQUIRE(contacts.size() == 1);
        CHECK(contacts[0].overlap == test::about(0.01));
        CHECK((contacts[0].normal - (centre - rim) / 0.05).norm() < 1e-12);
        CHECK((contacts[0].point - rim).norm() < 1e-12);
      }
    }
  }
}

TEST_CASE("overlap and normal are continuous where the mantle ends") {
  for (const double end : {3.0, 5.0}) {
    for (const auto& [cylinder, off] : {std::pair{tube, 0.45}, std::pair{roller, 0.55}}) {
      const auto below = touch(cylinder, {1.0, 2.0 + off, end - 1e-9}, 0.1);
      const auto above = touch(cylinder, {1.0, 2.0 + off, end + 1e-9}, 0.1);
      REQUIRE(below.size() == 1);
      REQUIRE(above.size() == 1);
      CHECK(below[0].overlap == test::about(above[0].overlap, 1e-7));
      CHECK((below[0].normal - above[0].normal).norm() < 1e-7);
      CHECK((below[0].point - above[0].point).norm() < 1e-7);
    }
  }
}

TEST_CASE("the contact of a tilted cylinder is the nearest point of its mantle") {
  Random random{111};
  constexpr int turns = 720, heights = 200;
  for (int k = 0; k < 40; ++k) {
    const Quaternion q = random.orientation();
    const Vector base{random.uniform(), random.uniform(), random.uniform()};
    const bool within = random.index(2) == 0;
    const Cylinder c = checked({.base = base,
                                .axis = q * Vector::UnitZ(),
                                .radius = 0.4,
                                .length = 1.0,
                                .side = within ? Cylinder::Side::inside : Cylinder::Side::outside});
    const double off = within ? random.uniform(0.1, 0.4) : random.uniform(0.4, 0.8);
    const double phi = random.uniform(0.0, 6.28);
    const Vector centre =
        base + q * Vector{off * std::cos(phi), off * std::sin(phi), random.uniform(-0.3, 1.3)};
    Vector nearest = Vector::Constant(1e9);
    for (int i = 0; i < turns; ++i) {
      const double a = i * 2.0 * std::numbers::pi / turns;
      for (int j = 0; j <= heights; ++j) {
        const Vector sample = base + q * Vector{0.4 * std::cos(a), 0.4 * std::sin(a), 1.0 * j / heights};
        if ((sample - centre).norm() < (nearest - centre).norm()) {
          nearest = sample;
        }
      }
    }
    const auto contacts = touch(c, centre, 1.0);
    REQUIRE(contacts.size() == 1);
    const double distance = 1.0 - contacts[0].overlap;
    CHECK(distance <= (nearest - centre).norm() + 1e-12);
    CHECK((contacts[0].point - nearest).norm() < 0.01);
    CHECK((centre - contacts[0].point - distance * contacts[0].normal).norm() < 1e-12);
    CHECK(contacts[0].normal.norm() == test::about(1.0));
  }
}

TEST_CASE("a cylinder without ends has no rim") {
  const Cylinder endless = checked({.axis = {1, 0, 0}, .radius = 1.0});
  for (const double x : {-1e6, 0.0, 1e6}) {
    const auto contacts = touch(endless, {x, 0.95, 0.0}, 0.1);
    REQUIRE(contacts.size() == 1);
    CHECK(contacts[0].overlap == test::about(0.05));
    CHECK((contacts[0].normal - Vector{0, -1, 0}).norm() < 1e-12);
    CHECK(endless.near({x, 0.95, 0.0}, 0.1));
  }
}

TEST_CASE("whatever touches a cylinder was near it") {
  Random random{112};
  for (int k = 0; k < 20000; ++k) {
    const Vector centre =
        tube.base + Vector{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 3)};
    const double radius = random.uniform(0.01, 0.3);
    for (const Cylinder& c : {tube, roller}) {
      if (!touch(c, centre, radius).empty()) {
        REQUIRE(c.near(centre, radius));
      }
    }
  }
  CHECK_FALSE(tube.near({1.0, 2.0, 4.0}, 0.2));
  CHECK_FALSE(tube.near({1.5, 2.0, 6.0}, 0.2));
  CHECK_FALSE(roller.near({2.0, 2.0, 4.0}, 0.2));
}

TEST_CASE("a cylinder refuses what has no shape") {
  CHECK_THROWS_AS((void)checked(Cylinder{}), Error);
  CHECK_THROWS_AS((void)checked({.radius = -1.0}), Error);
  CHECK_THROWS_AS((void)checked({.axis = {0, 0, 0}, .radius = 1.0}), Error);
  CHECK_THROWS_AS((void)checked({.radius = 1.0, .length = 0.0}), Error);
  CHECK_THROWS_AS((void)checked({.base = {std::nan(""), 0, 0}, .radius = 1.0}), Error);
}

TEST_CASE("a sphere can grow by the gap, and no further, before it touches a cylinder") {
  Random random{173};
  std::size_t clear = 0;
  for (int k = 0; k < 2000; ++k) {
    const Vector centre{random.uniform(0.0, 2.0), random.uniform(1.0, 3.0), random.uniform(2.5, 5.5)};
    for (const Cylinder& cylinder : {tube, roller}) {
      SurfaceContacts contacts;
      const double gap = cylinder.touch(centre, 0.05, contacts);
      REQUIRE(contacts.empty() == (gap >= 0.0));
      // Past the mantle, where no grain gets to, it is deep in.
      if (gap >= 0.0) {
        ++clear;
        REQUIRE(touch(cylinder, centre, 0.05 + gap * (1.0 - 1e-9)).empty());
        REQUIRE(!touch(cylinder, centre, 0.05 + gap * (1.0 + 1e-9) + 1e-12).empty());
      }
    }
  }
  CHECK(clear > 1000);
}
