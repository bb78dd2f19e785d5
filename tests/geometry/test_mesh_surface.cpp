#include "scree/geometry/mesh_surface.hpp"

#include "scree/core/random.hpp"
#include "scree/geometry/plane.hpp"
#include "support/meshes.hpp"
#include "support/relative_error.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <vector>

using namespace scree;

namespace {

constexpr double degree = std::numbers::pi / 180.0;

SurfaceContacts touch(const MeshSurface& surface, const Vector& centre, double radius) {
  std::vector<std::uint32_t> facets;
  surface.facets_near(centre, radius, facets);
  SurfaceContacts contacts;
  surface.touch(facets, centre, radius, contacts);
  return contacts;
}

/// Two unit wide strips that meet in the y axis; the right one rises by `angle` above the continuation of the
/// left one.
TriangleMesh fold(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {{{-1, -1, 0}, {-1, 1, 0}, {0, -1, 0}, {0, 1, 0}, {c, -1, s}, {c, 1, s}},
          {{0, 2, 1}, {1, 2, 3}, {2, 4, 3}, {3, 4, 5}}};
}

/// A square of n x n cells of width 1, each of two facets, with random heights.
TriangleMesh rough_ground(int n, double roughness, Random& random) {
  TriangleMesh mesh;
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j) {
      mesh.vertices.push_back({i + random.uniform(-0.3, 0.3), j + random.uniform(-0.3, 0.3),
                               random.uniform(-roughness, roughness)});
    }
  }
  const auto at = [n](int i, int j) { return static_cast<std::uint32_t>(i * (n + 1) + j); };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      mesh.facets.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
      mesh.facets.push_back({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

/// The points of a surface where the distance to `centre` has a local minimum below `radius`, from first
/// principles: the foot on a facet, edge or vertex, from which no facet that holds it leads closer.
std::vector<Vector> local_minima(const TriangleMesh& mesh, const Vector& centre, double radius) {
  std::vector<Vector> found;
  const auto nothing_closer = [&](const Vector& foot, auto holds) {
    for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
      if (!holds(mesh.facets[f])) {
        continue;
      }
      for (const Vector& corner : mesh.corners(f)) {
        if ((corner - foot).dot(centre - foot) > 1e-12) {
          return false;
        }
      }
    }
    return true;
  };
  const auto has = [](const TriangleMesh::Facet& f, std::uint32_t v) {
    return std::count(f.begin(), f.end(), v) > 0;
  };
  const auto note = [&](const Vector& foot) {
    if ((foot - centre).norm() < radius) {
      found.push_back(foot);
    }
  };
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
    if (nothing_closer(mesh.vertices[v], [&](const auto& f) { return has(f, v); })) {
      note(mesh.vertices[v]);
    }
  }
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
    for (std::uint32_t w = v + 1; w < mesh.vertices.size(); ++w) {
      const auto is_edge = [&](const auto& f) { return has(f, v) && has(f, w); };
      if (std::none_of(mesh.facets.begin(), mesh.facets.end(), is_edge)) {
        continue;
      }
      const Vector a = mesh.vertices[v], ab = mesh.vertices[w] - a;
      const double along = (centre - a).dot(ab) / ab.squaredNorm();
      if (along > 0.0 && along < 1.0 && nothing_closer(a + along * ab, is_edge)) {
        note(a + along * ab);
      }
    }
  }
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
    const auto t = mesh.corners(f);
    const Vector normal = (t[1] - t[0]).cross(t[2] - t[0]).normalized();
    const Vector foot = centre - (centre - t[0]).dot(normal) * normal;
    bool inside = true;
    for (std::size_t k = 0; k < 3; ++k) {
      inside = inside && (t[(k + 1) % 3] - t[k]).cross(foot - t[k]).dot(normal) > 0.0;
    }
    if (inside) {
      note(foot);
    }
  }
  return found;
}

/// Of minima in nearly one direction only the nearest counts.
std::vector<Vector> merged(std::vector<Vector> feet, const Vector& centre) {
  std::sort(feet.begin(), feet.end(),
            [&](const Vector& a, const Vector& b) { return (a - centre).norm() < (b - centre).norm(); });
  std::vector<Vector> kept;
  for (const Vector& foot : feet) {
    const Vector direction = (centre - foot).normalized();
    if (std::none_of(kept.begin(), kept.end(), [&](const Vector& nearer) {
          return (centre - nearer).normalized().dot(direction) > std::cos(10.0 * degree);
        })) {
      kept.push_back(foot);
    }
  }
  return kept;
}

} // namespace

TEST_CASE("over a face a sphere touches the mesh as it touches the plane, to the bit") {
  Random random{121};
  const MeshSurface surface{fold(0.0)};
  for (int k = 0; k < 1000; ++k) {
    const Vector centre{random.uniform(-0.9, 0.9), random.uniform(-0.9, 0.9), random.uniform(0.4, 0.6)};
    SurfaceContacts on_plane;
    Plane{}.touch(centre, 0.5, on_plane);
    const auto on_mesh = touch(surface, centre, 0.5);
    REQUIRE(on_mesh.size() == on_plane.size());
    if (!on_plane.empty()) {
      REQUIRE(on_mesh[0].overlap == on_plane[0].overlap);
      REQUIRE(on_mesh[0].normal == on_plane[0].normal);
      REQUIRE((on_mesh[0].point - on_plane[0].point).norm() < 1e-15);
    }
  }
}

TEST_CASE("both sides of a surface are touched") {
  const MeshSurface surface{fold(0.0)};
  for (const double side : {1.0, -1.0}) {
    const auto contacts = touch(surface, {0.3, 0.2, side * 0.45}, 0.5);
    REQUIRE(contacts.size() == 1);
    CHECK(contacts[0].overlap == test::about(0.05));
    CHECK(contacts[0].normal == Vector{0, 0, side});
  }
}

TEST_CASE("at the seams of coplanar facets and where many of them meet there is one contact") {
  const MeshSurface surface{fold(0.0)};
  for (const double y : {-0.7, 0.0, 0.4}) {
    for (const double off : {-1e-3, -1e-17, 0.0, 1e-17, 1e-9, 0.2}) {
      const auto contacts = touch(surface, {off, y, 0.45}, 0.5);
      REQUIRE(contacts.size() == 1);
      CHECK(contacts[0].overlap == test::about(0.05, 1e-14));
      CHECK((contacts[0].normal - Vector::UnitZ()).norm() < 1e-14);
    }
  }
  // The middle of a fan.
  TriangleMesh fan{{{0, 0, 0}}, {}};
  constexpr std::uint32_t sectors = 17;
  for (std::uint32_t k = 0; k < sectors; ++k) {
    const double a = 2.0 * std::numbers::pi * k / sectors;
    fan.vertices.push_back({std::cos(a), std::sin(a), 0});
    fan.facets.push_back({0, 1 + k, 1 + (k + 1) % sectors});
  }
  for (const Vector& off : {Vector{0, 0, 0}, Vector{1e-12, -1e-13, 0}, Vector{0.01, 0.02, 0}}) {
    const auto contacts = touch(MeshSurface{fan}, off + Vector{0, 0, 0.45}, 0.5);
    REQUIRE(contacts.size() == 1);
    CHECK(contacts[0].overlap == test::about(0.05, 1e-12));
  }
}

TEST_CASE("a convex edge is touched once, along the line from the edge to the centre") {
  const MeshSurface surface{fold(-90.0 * degree)};
  const Vector centre{0.3, 0.1, 0.3};
  const auto contacts = touch(surface, centre, 0.45);
  REQUIRE(contacts.size() == 1);
  CHECK(contacts[0].overlap == test::about(0.45 - 0.3 * std::sqrt(2.0)));
  CHECK((contacts[0].normal - Vector{1, 0, 1}.normalized()).norm() < 1e-14);
  CHECK((contacts[0].point - Vector{0, 0.1, 0}).norm() < 1e-15);
}

TEST_CASE("a convex vertex is touched once, whichever facets meet there") {
  const MeshSurface surface{test::box_mesh({2, 2, 2})};
  for (int corner = 0; corner < 8; ++corner) {
    const Vector sign{corner & 1 ? 1.0 : -1.0, corner & 2 ? 1.0 : -1.0, corner & 4 ? 1.0 : -1.0};
    const auto contacts = touch(surface, sign * 1.1, 0.2);
    REQUIRE(contacts.size() == 1);
    CHECK(contacts[0].overlap == test::about(0.2 - 0.1 * std::sqrt(3.0)));
    CHECK((contacts[0].normal - sign.normalized()).norm() < 1e-12);
  }
}

TEST_CASE("in a concave edge a sphere touches both faces, in a concave corner all three") {
  const MeshSurface ditch{fold(90.0 * degree)};
  const auto two = touch(ditch, {-0.45, 0.1, 0.48}, 0.5);
  REQUIRE(two.size() == 2);
  CHECK(two[0].overlap == test::about(0.05)); // the deepest first
  CHECK((two[0].normal - Vector{-1, 0, 0}).norm() < 1e-12);
  CHECK(two[1].overlap == test::about(0.02));
  CHECK((two[1].normal - Vector{0, 0, 1}).norm() < 1e-12);

  const MeshSurface box{test::box_mesh({2, 2, 2})};
  CHECK(touch(box, {0.55, 0.6, 0.65}, 0.5).size() == 3); // from within
  CHECK(touch(box, {0.0, 0.6, 0.65}, 0.5).size() == 2);
  CHECK(touch(box, {0.0, 0.0, 0.65}, 0.5).size() == 1);
  CHECK(touch(box, {0.0, 0.0, 0.0}, 0.5).empty());
}

TEST_CASE("a slightly concave seam is touched once, and the overlap does not jump on the way across") {
  for (const double angle : {1.0, 5.0, 9.0}) {
    const MeshSurface surface{fold(angle * degree)};
    constexpr double step = 1e-4;
    double before = 0.0;
    for (double x = -0.3; x < 0.3; x += step) {
      const auto contacts = touch(surface, {x, 0.05, 0.49}, 0.5);
      REQUIRE(contacts.size() == 1);
      if (x > -0.3) {
        REQUIRE(std::abs(contacts[0].overlap - before) <= step * (1.0 + 1e-9));
      }
      before = contacts[0].overlap;
    }
  }
}

TEST_CASE("on the way across a fold the contacts begin and end with no force, whatever its angle") {
  // Overlaps stay below 1.5 per cent of the radius, the share of it by which a concave edge of ten degrees is
  // farther from the centre than the face: then the second face is reached before the edge is.
  constexpr double radius = 0.3, step = 1e-5;
  for (const double angle : {-150.0, -60.0, -10.0, 11.0, 30.0, 80.0, 130.0}) {
    CAPTURE(angle);
    const MeshSurface surface{fold(angle * degree)};
    Vector before{0, 0, 0.002}; // the sum of what equal springs would do, per unit of stiffness
    double most = 0.0;
    std::size_t contacts = 1, most_contacts = 0;
    for (double x = -0.9; x < 0.3 && contacts > 0; x += step) {
      const auto found = touch(surface, {x, 0.1, 0.298}, radius);
      Vector now = Vector::Zero();
      for (const auto& contact : found) {
        now += contact.overlap * contact.normal;
      }
      most = std::max(most, (now - before).norm());
      before = now;
      contacts = found.size();
      most_contacts = std::max(most_contacts, contacts);
      if (contacts > 1 && found[0].overlap > 0.004) {
        break; // well in
      }
    }
    CHECK(most <= step * 1.02);
    CHECK(most_contacts == (angle > 0.0 ? 2 : 1));
    CHECK(contacts == (angle > 0.0 ? 2 : 0));
  }
}

TEST_CASE("the contacts of random surfaces are the local minima of the distance") {
  Random random{122};
  std::array<int, 6> seen{};
  for (const double roughness : {0.1, 0.5, 1.5}) {
    for (int k = 0; k < 60; ++k) {
      const TriangleMesh mesh = rough_ground(5, roughness, random);
      const MeshSurface surface{mesh};
      for (int trial = 0; trial < 10; ++trial) {
        const Vector centre{random.uniform(-0.5, 5.5), random.uniform(-0.5, 5.5), random.uniform(-1.5, 1.5)};
        const double radius = random.uniform(0.3, 1.2);
        const auto expected = merged(local_minima(mesh, centre, radius), centre);
        const auto contacts = touch(surface, centre, radius);
        REQUIRE(contacts.size() == expected.size());
        for (const SurfaceContact& contact : contacts) {
          const bool known = std::any_of(expected.begin(), expected.end(), [&](const Vector& foot) {
            return (foot - contact.point).norm() < 1e-9;
          });
          REQUIRE(known);
          REQUIRE(contact.overlap == test::about(radius - (centre - contact.point).norm(), 1e-9));
          REQUIRE((contact.normal - (centre - contact.point).normalized()).norm() < 1e-6);
        }
        ++seen[std::min<std::size_t>(contacts.size(), 5)];
      }
    }
  }
  for (std::size_t count = 0; count <= 4; ++count) {
    CAPTURE(count);
    CHECK(seen[count] > 3);
  }
}

TEST_CASE(
    "no sample of a surface near a contact is nearer, and none anywhere is nearer than the deepest contact") {
  Random random{123};
  constexpr int n = 40;
  for (int k = 0; k < 30; ++k) {
    const TriangleMesh mesh = rough_ground(3, 0.6, random);
    const MeshSurface surface{mesh};
    const Vector centre{random.uniform(0.0, 3.0), random.uniform(0.0, 3.0), random.uniform(-1.0, 1.0)};
    const double radius = 1.5;
    const auto contacts = touch(surface, centre, radius);
    double nearest = radius;
    for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
      const auto t = mesh.corners(f);
      for (int i = 0; i <= n; ++i) {
        for (int j = 0; i + j <= n; ++j) {
          const Vector sample = (i * t[0] + j * t[1] + (n - i - j) * t[2]) / n;
          const double distance = (sample - centre).norm();
          nearest = std::min(nearest, distance);
          for (const SurfaceContact& contact : contacts) {
            // Near, and so on the same sheet: ground that is nowhere above itself.
            if ((sample - contact.point).norm() < 0.02) {
              REQUIRE(distance >= radius - contact.overlap - 1e-12);
            }
          }
        }
      }
    }
    if (!contacts.empty()) {
      CHECK(radius - contacts[0].overlap <= nearest + 1e-12);
      CHECK(radius - contacts[0].overlap >= nearest - 0.1);
    } else {
      CHECK(nearest == radius);
    }
  }
}

TEST_CASE("a finely tessellated sphere is touched once from outside, as the sphere that it stands for") {
  const TriangleMesh mesh = test::sphere_mesh(1.0, 4);
  double sagitta = 0.0;
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
    const auto t = mesh.corners(f);
    sagitta = std::max(sagitta, 1.0 - ((t[0] + t[1] + t[2]) / 3.0).norm());
  }
  const MeshSurface ball{mesh};
  Random random{124};
  for (int k = 0; k < 500; ++k) {
    const Vector direction = random.orientation() * Vector::UnitX();
    const auto contacts = touch(ball, 1.29 * direction, 0.3);
    REQUIRE(contacts.size() == 1);
    REQUIRE(contacts[0].overlap <= 0.01 + 1e-9);
    REQUIRE(contacts[0].overlap > 0.01 - sagitta); // the facets lie inside the sphere by less
    REQUIRE(contacts[0].normal.dot(direction) > std::cos(4.0 * degree));
  }
}

TEST_CASE("the facets near a point are those within the reach, in ascending order behind what was there") {
  Random random{125};
  const TriangleMesh mesh = rough_ground(6, 1.0, random);
  const MeshSurface surface{mesh};
  for (int k = 0; k < 200; ++k) {
    const Vector centre{random.uniform(-2, 8), random.uniform(-2, 8), random.uniform(-3, 3)};
    const double reach = random.uniform(0.1, 3.0);
    std::vector<std::uint32_t> found{77}, expected{77};
    surface.facets_near(centre, reach, found);
    for (std::uint32_t f = 0; f < mesh.facets.size(); ++f) {
      if ((closest_point(mesh.corners(f), centre).point - centre).norm() <= reach) {
        expected.push_back(f);
      }
    }
    REQUIRE(found == expected);
  }
}

TEST_CASE("a mesh surface refuses what cannot be touched") {
  const TriangleMesh good = fold(0.0);
  CHECK_NOTHROW(MeshSurface{good});
  CHECK_THROWS_AS(MeshSurface{TriangleMesh{}}, Error);
  TriangleMesh bad = good;
  bad.facets[1][2] = 99;
  CHECK_THROWS_WITH_AS(MeshSurface{bad}, doctest::Contains("facet 1"), Error);
  bad = good;
  bad.vertices[3].y() = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH_AS(MeshSurface{bad}, doctest::Contains("vertex 3"), Error);
  bad = good;
  bad.vertices[1] = Vector{-1, -2, 0};
  bad.vertices[2] = Vector{-1, -3, 0}; // facet 0 on a line
  CHECK_THROWS_WITH_AS(MeshSurface{bad}, doctest::Contains("facet 0 has no area"), Error);
}

TEST_CASE("a sphere can grow by the gap before it touches a mesh") {
  Random random{179};
  const MeshSurface surface{rough_ground(6, 0.4, random)};
  std::vector<std::uint32_t> all(surface.mesh().facets.size());
  std::iota(all.begin(), all.end(), 0U);
  std::size_t clear = 0;
  for (int k = 0; k < 1000; ++k) {
    const Vector centre{random.uniform(-0.5, 6.5), random.uniform(-0.5, 6.5), random.uniform(-1.5, 1.5)};
    SurfaceContacts contacts;
    const double gap = surface.touch(all, centre, 0.2, contacts);
    REQUIRE(gap >= 0.0);
    if (!contacts.empty()) {
      REQUIRE(gap == 0.0);
      continue;
    }
    clear += gap > 0.05 ? 1 : 0;
    REQUIRE(touch(surface, centre, 0.2 + gap * (1.0 - 1e-9)).empty());
  }
  CHECK(clear > 100);
}
