#include "scree/core/random.hpp"
#include "scree/geometry/mesh_measures.hpp"
#include "support/meshes.hpp"
#include "support/relative_error.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

using namespace scree;
using scree::test::box_mesh;
using scree::test::sphere_mesh;

namespace {

constexpr double pi = std::numbers::pi;

TriangleMesh moved(TriangleMesh mesh, const Quaternion& turn, const Vector& shift) {
  for (auto& v : mesh.vertices) {
    v = turn * v + shift;
  }
  return mesh;
}

TriangleMesh inside_out(TriangleMesh mesh) {
  for (auto& f : mesh.facets) {
    std::swap(f[0], f[1]);
  }
  return mesh;
}

TriangleMesh together(TriangleMesh a, const TriangleMesh& b) {
  const auto offset = static_cast<std::uint32_t>(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const auto& f : b.facets) {
    a.facets.push_back({f[0] + offset, f[1] + offset, f[2] + offset});
  }
  return a;
}

const Vector sizes{0.3, 0.5, 0.7};

Matrix box_inertia(double mass) {
  const Vector squares = sizes.cwiseProduct(sizes);
  return (mass / 12.0 * (Vector::Constant(squares.sum()) - squares)).asDiagonal();
}

} // namespace

TEST_CASE("area, volume and bounds of a box") {
  const auto box = box_mesh(sizes);
  CHECK(area(box) == test::about(2.0 * (0.15 + 0.35 + 0.21), 1e-14));
  CHECK(volume(box) == test::about(0.105, 1e-14));
  CHECK(volume(inside_out(box)) == test::about(-0.105, 1e-14));
  CHECK(bounding_box(box).min() == -0.5 * sizes);
  CHECK(bounding_box(box).max() == 0.5 * sizes);
  CHECK(bounding_box(TriangleMesh{}).isEmpty());
  CHECK(volume(TriangleMesh{}) == 0.0);
}

TEST_CASE("vertices that no facet names do not widen the bounds") {
  auto box = box_mesh(sizes);
  box.vertices.push_back({5.0, 5.0, 5.0});
  CHECK(bounding_box(box).max() == 0.5 * sizes);
}

TEST_CASE("a solid box has its mass, centre and inertia, turned and far away too") {
  Random random{5};
  for (const double distance : {0.0, 1.0, 1000.0}) {
    const Quaternion turn = random.orientation();
    const Vector shift = distance * Vector{0.6, -0.7, 0.4};
    const auto solid = solid_properties(moved(box_mesh(sizes), turn, shift), 2500.0);
    const Matrix r = turn.toRotationMatrix();
    const Matrix expected = r * box_inertia(2500.0 * 0.105) * r.transpose();
    // Rounding of the vertices themselves is all that is lost far away.
    const double accuracy = 1e-13 * (1.0 + 10.0 * distance);
    CHECK(solid.mass == test::about(2500.0 * 0.105, accuracy));
    CHECK((solid.centre - shift).norm() <= accuracy);
    CHECK((solid.inertia - expected).norm() <= accuracy * expected.norm());
  }
}

TEST_CASE("a tetrahedron's inertia is that of the closed form") {
  // Unit corner tetrahedron: ∫x² = 1/60, ∫xy = 1/120, about the corner.
  TriangleMesh corner;
  corner.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  corner.facets = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  const auto solid = solid_properties(corner);
  CHECK(solid.mass == test::about(1.0 / 6.0, 1e-14));
  CHECK((solid.centre - Vector::Constant(0.25)).norm() < 1e-15);
  CHECK(solid.inertia(0, 0) == test::about(2.0 / 60.0 - 2.0 / 96.0, 1e-13));
  CHECK(solid.inertia(0, 1) == test::about(-(1.0 / 120.0 - 1.0 / 96.0), 1e-13));
}

TEST_CASE("a tessellated sphere tends to the sphere with the square of the facets' size") {
  const double r = 0.2;
  const double ball = 4.0 / 3.0 * pi * r * r * r;
  const auto error = [&](int divisions) {
    const auto solid = solid_properties(sphere_mesh(r, divisions), 1000.0);
    CHECK(solid.centre.norm() < 1e-15);
    CHECK(solid.inertia.isDiagonal(1e-12));
    const double of_volume = 1.0 - solid.mass / (1000.0 * ball);
    const double of_inertia = 1.0 - solid.inertia(2, 2) / (0.4 * 1000.0 * ball * r * r);
    return std::pair{of_volume, of_inertia};
  };
  const auto coarse = error(4);
  const auto fine = error(5);
  CHECK(coarse.first / fine.first == test::about(4.0, 0.01));
  CHECK(coarse.second / fine.second == test::about(4.0, 0.01));
  // What is left once that order is taken off.
  CHECK(std::abs(4.0 * fine.first - coarse.first) / 3.0 < 2e-5);
  CHECK(std::abs(4.0 * fine.second - coarse.second) / 3.0 < 5e-5);
}

TEST_CASE("a cavity is a shell turned inwards") {
  const auto hollow = together(box_mesh(sizes), inside_out(box_mesh(0.5 * sizes)));
  const auto solid = solid_properties(hollow);
  CHECK(solid.mass == test::about(0.105 * (1.0 - 0.125), 1e-13));
  const Matrix expected = box_inertia(0.105) * (1.0 - std::pow(0.5, 5));
  CHECK((solid.inertia - expected).norm() < 1e-13 * expected.norm());
  CHECK_FALSE(contains(hollow, Vector::Zero()));
  CHECK(contains(hollow, 0.4 * sizes));
}

TEST_CASE("what bounds no volume is no solid") {
  const auto box = box_mesh(sizes);
  CHECK_THROWS_AS((void)solid_properties(TriangleMesh{}), Error);
  CHECK_THROWS_AS((void)solid_properties(inside_out(box)), Error);
  CHECK_THROWS_AS((void)solid_properties(box, 0.0), Error);
}

TEST_CASE("a plate bent along a mesh") {
  // A rectangle of 2 m by 1 m in the plane z = 3.
  TriangleMesh plate;
  plate.vertices = {{0, 0, 3}, {2, 0, 3}, {2, 1, 3}, {0, 1, 3}};
  plate.facets = {{0, 1, 2}, {0, 2, 3}};
  const auto flat = plate_properties(plate, 0.01, 7850.0);
  const double mass = 2.0 * 0.01 * 7850.0;
  CHECK(flat.mass == test::about(mass, 1e-14));
  CHECK((flat.centre - Vector{1.0, 0.5, 3.0}).norm() < 1e-14);
  const Matrix expected = (mass / 12.0 * Vector{1.0, 4.0, 5.0}).asDiagonal();
  CHECK((flat.inertia - expected).norm() < 1e-13 * mass);

  // A spherical shell: 2/3 m r².
  const auto shell = plate_properties(sphere_mesh(0.2, 5), 0.001, 7850.0);
  CHECK(shell.mass == test::about(4.0 * pi * 0.04 * 0.001 * 7850.0, 1e-3));
  CHECK(shell.inertia(0, 0) == test::about(2.0 / 3.0 * shell.mass * 0.04, 1e-3));

  CHECK_THROWS_AS((void)plate_properties(TriangleMesh{}, 0.01, 7850.0), Error);
  CHECK_THROWS_AS((void)plate_properties(plate, 0.0, 7850.0), Error);
  CHECK_THROWS_AS((void)plate_properties(plate, 0.01, -1.0), Error);
}

TEST_CASE("winding numbers count the shells around a point") {
  const auto box = box_mesh({1.0, 1.0, 1.0});
  CHECK(winding_number(box, {0.1, 0.2, -0.3}) == test::about(1.0, 1e-14));
  CHECK(std::abs(winding_number(box, {0.6, 0.2, -0.3})) < 1e-14);
  CHECK(winding_number(inside_out(box), {0.1, 0.2, -0.3}) == test::about(-1.0, 1e-14));
  CHECK(winding_number(together(box, sphere_mesh(0.4, 2)), {0.1, 0.2, 0.1}) == test::about(2.0, 1e-14));
  // Each face of a cube takes a sixth of all directions from its middle.
  auto open = box;
  open.facets.erase(open.facets.begin(), open.facets.begin() + 2);
  CHECK(winding_number(open, Vector::Zero()) == test::about(5.0 / 6.0, 1e-14));
}

TEST_CASE("points inside and outside a turned box") {
  Random random{8};
  const Quaternion turn = random.orientation();
  const Vector shift{3.0, -2.0, 1.0};
  const auto box = moved(box_mesh(sizes), turn, shift);
  const auto bounds = bounding_box(box);
  int inside = 0;
  for (int i = 0; i < 2000; ++i) {
    // Twice the box, so that the quick reject by the bounds is met as well as points between bounds and box.
    const Vector p = sizes.cwiseProduct(
        Vector{random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)});
    const bool expected = (p.cwiseAbs() - 0.5 * sizes).maxCoeff() < 0.0;
    const Vector point = turn * p + shift;
    CHECK(contains(box, point) == expected);
    CHECK(contains(inside_out(box), bounds, point) == expected);
    inside += expected ? 1 : 0;
  }
  CHECK(inside > 150);
}

TEST_CASE("a point in line with a facet but off it is judged rightly") {
  const auto box = box_mesh({1.0, 1.0, 1.0});
  for (const double x : {-0.4999999, 0.0, 0.25, 0.4999999}) {
    CHECK(contains(box, {x, 0.0, 0.0})); // in the plane of the faces' diagonals
  }
  CHECK_FALSE(contains(box, {0.5000001, 0.0, 0.0}));
  CHECK_FALSE(contains(box, {0.5, 0.8, 0.0})); // in the plane of a face
}
