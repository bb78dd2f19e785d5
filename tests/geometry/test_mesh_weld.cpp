#include "scree/core/random.hpp"
#include "scree/geometry/mesh_weld.hpp"
#include "support/meshes.hpp"

#include <doctest/doctest.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

using namespace scree;
using scree::test::box_mesh;
using scree::test::soup;
using scree::test::sphere_mesh;

namespace {

TriangleMesh shaken(TriangleMesh mesh, double distance, Random& random) {
  for (auto& v : mesh.vertices) {
    v += distance * (random.orientation() * Vector::UnitX());
  }
  return mesh;
}

/// weld() by its definition: every vertex against every vertex kept.
TriangleMesh welded_by_search(const TriangleMesh& mesh, double tolerance) {
  TriangleMesh welded;
  std::vector<std::uint32_t> renumbered;
  for (const auto& v : mesh.vertices) {
    std::size_t kept = 0;
    while (kept < welded.vertices.size() && (welded.vertices[kept] - v).norm() > tolerance) {
      ++kept;
    }
    if (kept == welded.vertices.size()) {
      welded.vertices.push_back(v);
    }
    renumbered.push_back(static_cast<std::uint32_t>(kept));
  }
  for (const auto& f : mesh.facets) {
    welded.facets.push_back({renumbered[f[0]], renumbered[f[1]], renumbered[f[2]]});
  }
  return welded;
}

} // namespace

TEST_CASE("a soup welds back to the mesh it was made of") {
  const auto box = box_mesh({1.0, 2.0, 3.0});
  const auto welded = weld(soup(box), 0.0);
  CHECK(welded.vertices.size() == 8);
  REQUIRE(welded.facets.size() == 12);
  for (std::size_t i = 0; i < box.facets.size(); ++i) {
    CHECK(welded.corners(i) == box.corners(i));
  }
}

TEST_CASE("vertices weld within the tolerance and not beyond") {
  TriangleMesh mesh;
  mesh.vertices = {{0.0, 0.0, 0.0}, {0.99e-3, 0.0, 0.0}, {1.01e-3, 0.0, 0.0}, {-0.99e-3, 0.0, 0.0}};
  mesh.facets = {{0, 1, 2}, {3, 2, 1}};
  const auto welded = weld(mesh, 1e-3);
  REQUIRE(welded.vertices.size() == 2);
  CHECK(welded.vertices[0] == mesh.vertices[0]);
  CHECK(welded.vertices[1] == mesh.vertices[2]);
  CHECK(welded.facets == std::vector<TriangleMesh::Facet>{{0, 0, 1}, {0, 1, 0}});
}

TEST_CASE("a tolerance of zero welds equal coordinates only, and both zeros are equal") {
  TriangleMesh mesh;
  mesh.vertices = {{0.0, 1.0, 2.0}, {-0.0, 1.0, 2.0}, {std::numeric_limits<double>::denorm_min(), 1.0, 2.0}};
  mesh.facets = {{0, 1, 2}};
  CHECK(weld(mesh, 0.0).facets.front() == TriangleMesh::Facet{0, 0, 1});
}

TEST_CASE("welding agrees with the search through all vertices") {
  Random random{3};
  for (const double tolerance : {0.02, 0.1, 0.5}) {
    // Shaken by about the tolerance, so that many distances lie near it, around and across the origin.
    const auto mesh = shaken(soup(sphere_mesh(1.0, 2)), 0.5 * tolerance, random);
    const auto welded = weld(mesh, tolerance);
    const auto expected = welded_by_search(mesh, tolerance);
    CHECK(welded.vertices == expected.vertices);
    CHECK(welded.facets == expected.facets);
  }
}

TEST_CASE("an outlying vertex does not hinder welding") {
  auto mesh = soup(box_mesh({1.0, 1.0, 1.0}));
  mesh.vertices.push_back({1e300, -1e300, 1e300});
  CHECK(weld(mesh, 1e-9).vertices.size() == 9);
  CHECK(weld(mesh, 1e-300).vertices.size() == 9);
}

TEST_CASE("collapsed facets keep their number until they are taken out") {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1e-6, 0, 0}, {2, 0, 0}};
  mesh.facets = {{0, 3, 2}, {0, 1, 2}, {0, 1, 4}};
  const auto welded = weld(mesh, 1e-5);
  REQUIRE(welded.facets.size() == 3);
  const auto kept = without_collapsed_facets(welded);
  // The last facet has no area either, but three vertices.
  REQUIRE(kept.facets.size() == 2);
  CHECK(kept.facets[0] == welded.facets[1]);
  CHECK(kept.facets[1] == welded.facets[2]);
}

TEST_CASE("a tolerance that makes no sense is refused") {
  const auto box = box_mesh({1.0, 1.0, 1.0});
  CHECK_THROWS_AS((void)weld(box, -1e-9), Error);
  CHECK_THROWS_AS((void)weld(box, std::numeric_limits<double>::quiet_NaN()), Error);
  CHECK_THROWS_AS((void)weld(box, std::numeric_limits<double>::infinity()), Error);
}
