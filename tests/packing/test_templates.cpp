#include "scree/packing/templates.hpp"
#include "support/relative_error.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>

using namespace scree;

TEST_CASE("the templates have the paper's number of spheres and ratios") {
  const auto shapes = paper_shapes();
  REQUIRE(shapes.size() == 4);
  CHECK(shapes[0].spheres.size() == 3);
  CHECK(shapes[1].spheres.size() == 4);
  CHECK(shapes[2].spheres.size() == 4);
  CHECK(shapes[3].spheres.size() == 1);

  const Vector aligned = principal_extents(shapes[0]);
  CHECK(aligned[0] / aligned[1] > 2.0);
  const Vector flat = principal_extents(shapes[2]);
  CHECK(flat[0] / flat[1] < 2.0);
  CHECK(flat[0] / flat[2] > 2.0);
}

TEST_CASE("extents and sieve size of the templates") {
  const auto shapes = paper_shapes();
  CHECK((principal_extents(shapes[0]) - Vector{2.2, 1.0, 1.0}).norm() < 1e-12);
  CHECK((principal_extents(shapes[2]) - Vector{2.3, 1.9, 1.0}).norm() < 1e-12);
  CHECK(principal_extents(shapes[3]) == Vector{1.0, 1.0, 1.0});
  CHECK(sieve_size(shapes[0]) == test::about(1.0, 1e-12));
  CHECK(sieve_size(shapes[2]) == test::about(1.9, 1e-12));
  CHECK(sieve_size(shapes[3]) == 1.0);
  // The pyramid keeps the axes of the cube that holds it: half an edge over the root of two, and a diameter.
  CHECK(sieve_size(shapes[1]) == test::about(1.0 + 0.7 / std::sqrt(2.0), 1e-12));
  CHECK(sieve_size(scaled(shapes[2], 0.01)) == test::about(0.019, 1e-12));
}

TEST_CASE("the spheres of a template overlap, and those of the pyramid all alike") {
  for (const auto& spheres : {aligned_spheres(), pyramid_of_spheres(), flat_of_spheres()}) {
    for (const Sphere& a : spheres) {
      bool attached = false;
      for (const Sphere& b : spheres) {
        const double distance = (a.centre - b.centre).norm();
        attached = attached || (&a != &b && distance < 0.9 * (a.radius + b.radius));
      }
      CHECK(attached);
    }
  }
  const auto pyramid = pyramid_of_spheres();
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = i + 1; j < 4; ++j) {
      CHECK((pyramid[i].centre - pyramid[j].centre).norm() == test::about(0.7, 1e-14));
    }
  }
  const Clump clump = make_clump("pyramid", pyramid);
  CHECK(clump.inertia == Vector::Constant(clump.inertia[0]));
}
