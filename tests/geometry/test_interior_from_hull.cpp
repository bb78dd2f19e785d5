#include "scree/geometry/dragline_bucket.hpp"
#include "scree/geometry/interior_from_hull.hpp"
#include "scree/geometry/mesh_topology.hpp"
#include "support/meshes.hpp"
#include "support/relative_error.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <string>

using namespace scree;
using scree::test::box_mesh;

namespace {

TriangleMesh moved(TriangleMesh mesh, const Vector& shift) {
  for (auto& v : mesh.vertices) {
    v += shift;
  }
  return mesh;
}

std::string refusal(const TriangleMesh& mesh) {
  try {
    (void)interior_from_hull(mesh);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

} // namespace

TEST_CASE("between two plates lies the box between them") {
  TriangleMesh plates = moved(box_mesh({1.0, 0.02, 0.5}), {2.0, 0.30, 1.0});
  tessellation::append(plates, moved(box_mesh({1.0, 0.02, 0.5}), {2.0, -0.50, 1.0}));
  const auto interior = interior_from_hull(plates);
  CHECK(check(interior).clean());
  CHECK(volume(interior) == test::about(1.0 * 0.5 * (0.29 + 0.49), 1e-12));
  const auto bounds = bounding_box(interior);
  CHECK((bounds.min() - Vector{1.5, -0.49, 0.75}).norm() < 1e-12);
  CHECK((bounds.max() - Vector{2.5, 0.29, 1.25}).norm() < 1e-12);
}

TEST_CASE("the hull of a bucket is its side view by its inner width") {
  DraglineBucket bucket;
  bucket.mouth_rake = 0.0;
  bucket.back_rake = 0.0;
  const double t = bucket.plate_thickness;
  const double r = bucket.heel_radius;
  const auto body = shells(make_dragline_bucket(bucket))[0]; // without the teeth, which would reach forward
  const auto hull = interior_from_hull(body);
  CHECK(check(hull).clean());
  // The heel is a quarter of the regular polygon of 16 sides.
  const double side = bucket.length * bucket.height - r * r * (1.0 - 2.0 * std::sin(std::numbers::pi / 8.0));
  CHECK(volume(hull) == test::about(side * (bucket.width - 2.0 * t), 1e-12));
  CHECK(volume(hull) > volume(bucket_interior(bucket)));
  CHECK(bounding_box(hull).max().y() == test::about(0.5 * bucket.width - t, 1e-12));
  CHECK(bounding_box(hull).min().y() == test::about(t - 0.5 * bucket.width, 1e-12));
}

TEST_CASE("the default bucket's hull holds its whole interior") {
  const auto hull = interior_from_hull(make_dragline_bucket());
  const auto bounds = bounding_box(hull);
  for (const auto& v : bucket_interior().vertices) {
    // A little towards the middle, as many vertices lie in the hull's own faces.
    CHECK(contains(hull, bounds, v + 1e-6 * (bounds.center() - v)));
  }
}

TEST_CASE("a mesh without side view or without cheeks has no interior") {
  CHECK(refusal({}).find("empty") != std::string::npos);
  TriangleMesh plate; // in the plane z = 0
  plate.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  plate.facets = {{0, 1, 2}};
  CHECK(refusal(plate).find("side view") != std::string::npos);
  TriangleMesh floor = box_mesh({1.0, 1.0, 0.1});
  floor.vertices.push_back({0.0, 0.0, 5.0}); // raises the centroid of the hull above the floor
  floor.facets.push_back({0, 1, 8});
  CHECK(refusal(floor).find("no cheek left") != std::string::npos);
  auto one_sided = box_mesh({1.0, 1.0, 0.1});
  one_sided.vertices.insert(one_sided.vertices.end(), {{-3, 0.4, -1}, {3, 0.4, -1}, {0, 0.4, 9}});
  one_sided.facets.push_back({8, 9, 10});
  CHECK(refusal(one_sided).find("no cheek right") != std::string::npos);
}
