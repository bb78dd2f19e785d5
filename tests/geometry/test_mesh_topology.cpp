#include "scree/geometry/mesh_topology.hpp"
#include "scree/geometry/mesh_weld.hpp"
#include "support/meshes.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

using namespace scree;

namespace mesh_topology_tests {
using scree::test::box_mesh;
using scree::test::soup;
using scree::test::sphere_mesh;

namespace {

using Facets = std::vector<std::size_t>;
using Ends = std::array<std::uint32_t, 2>;

const TriangleMesh box = box_mesh({1.0, 2.0, 3.0});

} // namespace

TEST_CASE("a closed mesh has nothing to report") {
  for (const auto& mesh : {box, sphere_mesh(0.01, 3)}) {
    const auto report = check(mesh);
    CHECK(report.closed());
    CHECK(report.clean());
    CHECK(report.facet_count == mesh.facets.size());
    CHECK(report.vertex_count == mesh.vertices.size());
  }
  CHECK(check(box).summary() == "12 facets, 8 vertices, closed");
}

TEST_CASE("a mesh without facets is not closed") {
  CHECK_FALSE(check(TriangleMesh{}).closed());
}

TEST_CASE("a missing facet leaves three free edges") {
  auto open = box;
  open.facets.erase(open.facets.begin()); // {0, 2, 1}
  const auto report = check(open);
  CHECK_FALSE(report.closed());
  REQUIRE(report.free_edges.size() == 3);
  CHECK(report.free_edges[0].vertices == Ends{0, 1});
  CHECK(report.free_edges[0].facets == Facets{3});
  CHECK(report.free_edges[1].vertices == Ends{0, 2});
  CHECK(report.free_edges[1].facets == Facets{7});
  CHECK(report.free_edges[2].vertices == Ends{1, 2});
  CHECK(report.free_edges[2].facets == Facets{0});
  CHECK(report.non_manifold_edges.empty());
  CHECK(report.flipped_edges.empty());
  CHECK(report.t_junctions.empty());
  CHECK(report.degenerate_facets.empty());
  CHECK(report.summary() == "11 facets, 8 vertices, open\n  3 free edges at facets 1, 4, 8");
}

TEST_CASE("a soup is all free edges until it is welded") {
  CHECK(check(soup(box)).free_edges.size() == 36);
  CHECK(check(weld(soup(box), 0.0)).clean());
}

TEST_CASE("an edge of three facets is reported with all of them") {
  auto fin = box;
  fin.vertices.push_back({3.0, 3.0, 3.0});
  fin.facets.push_back({0, 1, 8});
  const auto report = check(fin);
  CHECK_FALSE(report.closed());
  REQUIRE(report.non_manifold_edges.size() == 1);
  CHECK(report.non_manifold_edges[0].vertices == Ends{0, 1});
  CHECK(report.non_manifold_edges[0].facets == Facets{0, 4, 12});
  CHECK(report.free_edges.size() == 2);
}

TEST_CASE("a flipped facet disagrees with its three neighbours") {
  auto flipped = box;
  std::swap(flipped.facets[4][1], flipped.facets[4][2]); // {0, 4, 1}
  const auto report = check(flipped);
  CHECK_FALSE(report.closed());
  REQUIRE(report.flipped_edges.size() == 3);
  for (const auto& edge : report.flipped_edges) {
    REQUIRE(edge.facets.size() == 2);
    CHECK((edge.facets[0] == 4 || edge.facets[1] == 4));
  }
  CHECK(report.free_edges.empty());
  CHECK(report.summary() ==
        "12 facets, 8 vertices, open\n  3 edges between flipped neighbours at facets 1, 5, 6, 9");
}

TEST_CASE("a mesh turned inside out as a whole agrees with itself") {
  auto inverted = box;
  for (auto& f : inverted.facets) {
    std::swap(f[0], f[1]);
  }
  CHECK(check(inverted).clean());
}

TEST_CASE("a vertex inside a facet's edge is a T-junction") {
  // A square whose upper half is one facet and whose lower half is cut in two at the middle of the diagonal.
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 0}};
  mesh.facets = {{0, 2, 3}, {0, 1, 4}, {1, 2, 4}};
  auto report = check(mesh);
  REQUIRE(report.t_junctions.size() == 1);
  CHECK(report.t_junctions[0].vertex == 4);
  CHECK(report.t_junctions[0].edge.vertices == Ends{0, 2});
  CHECK(report.t_junctions[0].edge.facets == Facets{0});
  CHECK_FALSE(report.clean());
  CHECK(report.summary().find("1 T-junction at facet 1") != std::string::npos);

  // It is told from a gap by the tolerance, which is relative to the mesh's diagonal.
  mesh.vertices[4] += Vector{1e-3, -1e-3, 0.0};
  CHECK(check(mesh).t_junctions.empty());
  CHECK(check(mesh, 2e-3).t_junctions.size() == 1);
  // Out of the plane it is a gap as well.
  mesh.vertices[4] = {0.5, 0.5, 1e-3};
  CHECK(check(mesh).t_junctions.empty());
}

TEST_CASE("T-junctions are found on an edge along an axis and with any number of vertices in it") {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {10, 0, 0}, {5, 5, 0}};
  mesh.facets = {{0, 1, 2}};
  for (int i = 1; i < 10; ++i) {
    const auto next = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.push_back({static_cast<double>(i), 0.0, 0.0});
    mesh.vertices.push_back({i - 0.3, -1.0, 0.0});
    mesh.vertices.push_back({i + 0.3, -1.0, 0.0});
    mesh.facets.push_back({next, next + 1, next + 2});
  }
  const auto report = check(mesh);
  REQUIRE(report.t_junctions.size() == 9);
  for (std::size_t i = 0; i < 9; ++i) {
    CHECK(report.t_junctions[i].vertex == 3 + 3 * i);
    CHECK(report.t_junctions[i].edge.facets == Facets{0});
  }
}

TEST_CASE("vertices that no facet names make no T-junction") {
  auto mesh = box;
  mesh.vertices.push_back(0.5 * (box.vertices[0] + box.vertices[1]));
  CHECK(check(mesh).clean());
}

TEST_CASE("degenerate facets: a vertex twice, or no height") {
  auto mesh = box;
  mesh.facets.push_back({0, 0, 1});
  auto report = check(mesh);
  CHECK(report.degenerate_facets == Facets{12});
  // Its neighbours meet across it.
  CHECK(report.closed());
  CHECK_FALSE(report.clean());

  mesh = box;
  mesh.vertices.push_back(0.5 * (box.vertices[0] + box.vertices[1]));
  mesh.facets.push_back({0, 8, 1});
  report = check(mesh);
  CHECK(report.degenerate_facets == Facets{12});
  CHECK(report.summary().find("1 degenerate facet at facet 13") != std::string::npos);
}

TEST_CASE("a long list of facets is cut short in the summary") {
  const auto text = check(soup(box)).summary();
  CHECK(text.find("36 free edges at facets 1, 2, 3, 4, 5, 6, 7, 8, 9, 10 and 2 more") != std::string::npos);
}

TEST_CASE("a facet that names a vertex that is not there is refused by its number") {
  auto mesh = box;
  mesh.facets[6][1] = 8;
  CHECK_THROWS_WITH_AS((void)check(mesh), "facet 7 names vertex 8 of 8", Error);
}

TEST_CASE("shells are the parts that share no vertex") {
  auto mesh = box;
  const auto sphere = sphere_mesh(0.1, 1);
  for (const auto& f : sphere.facets) {
    mesh.facets.insert(mesh.facets.begin(), {f[0] + 8, f[1] + 8, f[2] + 8});
  }
  mesh.vertices.insert(mesh.vertices.end(), sphere.vertices.begin(), sphere.vertices.end());
  mesh.vertices.push_back({9.0, 9.0, 9.0});
  const auto parts = shells(mesh);
  REQUIRE(parts.size() == 2);
  CHECK(parts[0].facets.size() == sphere.facets.size());
  CHECK(parts[0].vertices.size() == sphere.vertices.size());
  CHECK(parts[1].vertices.size() == 8);
  CHECK(check(parts[0]).clean());
  REQUIRE(check(parts[1]).clean());
  for (std::size_t i = 0; i < box.facets.size(); ++i) {
    CHECK(parts[1].corners(i) == box.corners(i));
  }
}

} // namespace mesh_topology_tests
