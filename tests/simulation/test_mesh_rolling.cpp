/// \file
/// A sphere that moves over a mesh moves as over the solid that the mesh stands for.

#include "scree/simulation/run.hpp"
#include "scree/simulation/simulation.hpp"
#include "support/meshes.hpp"
#include "support/relative_error.hpp"
#include "support/scenes.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

using namespace scree;

namespace mesh_rolling_tests {

namespace {

constexpr double radius = 0.01;
const Clump ball = test::ball(radius);
const Material rock{.normal_stiffness = 2e4, .shear_stiffness = 2e4, .friction = 0.5, .restitution = 0.5};
const double weight = rock.density * ball.volume * 9.81;

/// A ball that lies on z = 0 at (x, y).
struct Lying {
  double x = 0.0, y = 0.0;
  Vector velocity = Vector::Zero();
  Vector spin = Vector::Zero();
  Vector gravity{0, 0, -9.81};
};

struct Track : Simulation<> {
  Track(const Lying& b, const std::vector<TriangleMesh>& meshes, const Vector& origin = Vector::Zero())
      : Simulation<>{{.gravity = b.gravity, .time_step = 1e-5}} {
    const auto id = add_material(rock);
    std::vector<WallSurface> surfaces;
    for (const TriangleMesh& mesh : meshes) {
      surfaces.emplace_back(mesh, id);
    }
    if (meshes.empty()) {
      surfaces.emplace_back(Plane{}, id);
    }
    add({.clump = &ball,
         .material = id,
         .position = {b.x, b.y, radius - weight / 1e4},
         .velocity = b.velocity,
         .angular_velocity = b.spin});
    add_wall({.name = "track", .surfaces = surfaces, .dynamics = Fixed{}, .motion = {.position = origin}});
  }

  struct Touch {
    std::size_t contacts = 0;
    double normal = 0.0;
    Vector tangential = Vector::Zero();
  };
  /// Of all contacts of the ball.
  [[nodiscard]] Touch touch() const {
    Touch sum;
    visit_contacts([&](const ContactView& c) {
      ++sum.contacts;
      sum.normal += c.force.dot(c.normal);
      sum.tangential += c.force - c.force.dot(c.normal) * c.normal;
    });
    return sum;
  }
};

/// A square plate of many facets, none of whose seams is along an axis.
TriangleMesh tessellated_plane() {
  TriangleMesh mesh;
  constexpr int n = 40;
  const Quaternion turn{Eigen::AngleAxisd{0.37, Vector::UnitZ()}};
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j) {
      mesh.vertices.push_back(turn * Vector{0.007 * (i - 20), 0.007 * (j - 20) + 0.003 * (i % 2), 0.0});
    }
  }
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const auto at = [](int a, int b) { return static_cast<std::uint32_t>(a * (n + 1) + b); };
      mesh.facets.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
      mesh.facets.push_back({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

} // namespace

TEST_CASE("a ball moves over coplanar facets as over the plane") {
  // It slides, spins and comes to roll, over some forty seams.
  const Lying start{.x = -0.06, .y = -0.05, .velocity = {0.6, 0.4, 0.0}, .spin = {5.0, 3.0, 40.0}};
  Track on_plane{start, {}}, on_mesh{start, {tessellated_plane()}};
  for (int k = 0; k < 200; ++k) {
    run_for(on_plane, 1e-3);
    run_for(on_mesh, 1e-3);
    const Vector a = on_plane.bodies().position(0), b = on_mesh.bodies().position(0);
    REQUIRE((a - b).norm() < 1e-9 * a.norm());
    const Vector v = on_plane.bodies().velocity(0), w = on_plane.bodies().angular_velocity(0);
    REQUIRE((v - on_mesh.bodies().velocity(0)).norm() < 1e-9 * v.norm());
    REQUIRE((w - on_mesh.bodies().angular_velocity(0)).norm() < 1e-9 * w.norm());
  }
  // The slide is over.
  CHECK(on_plane.bodies().velocity(0).x() ==
        test::about(radius * on_plane.bodies().angular_velocity(0).y(), 1e-3));
  CHECK((on_plane.bodies().position(0) - Vector{-0.06, -0.05, 0.0}).norm() > 0.09);
}

TEST_CASE("a ball that rolls over seams and the edge of a box keeps its spring") {
  // A pull along x loads the tangential spring with 2/7 of it before the edge is reached. The edge is at x =
  // 0, a seam at x = -0.002; slowly, or the ball would fly off.
  const Lying start{
      .x = -0.004, .y = -0.098, .velocity = {0.02, 0, 0}, .spin = {0, 2.0, 0}, .gravity = {0.5, 0, -9.81}};
  Track track{start, {test::box_mesh({0.2, 0.2, 0.1})}, {-0.1, 0, -0.05}};
  run_for(track, 0.04);
  CHECK(track.bodies().position(0).x() < -0.0025);
  const double pull = 0.5 * weight / 9.81;
  double before = track.touch().tangential.norm(), largest = 0.0;
  CHECK(before == test::about(2.0 / 7.0 * pull, 0.05));
  double tilt = 0.0, at_edge = 0.0;
  while (tilt < 0.3) {
    track.step();
    const Vector at = track.bodies().position(0);
    REQUIRE(at.x() < radius);
    const auto touch = track.touch();
    REQUIRE(touch.contacts == 1);
    const double now = touch.tangential.norm();
    largest = std::max(largest, std::abs(now - before));
    before = now;
    tilt = std::atan2(std::max(at.x(), 0.0), at.z());
    if (at.x() < 0.0) {
      at_edge = now;
    }
  }
  CHECK(at_edge == test::about(2.0 / 7.0 * pull, 0.05));
  CHECK(largest < 0.01 * at_edge); // in one step; a spring lost would be all of it
  CHECK(before > 4.0 * at_edge);   // it pivots about the edge, and its weight begins to pull too
}

TEST_CASE("a ball that rolls through a slightly concave seam is carried without a jump") {
  for (const double angle : {2.0, 5.0, 9.0}) {
    CAPTURE(angle);
    const double a = angle * std::numbers::pi / 180.0;
    const TriangleMesh valley{{{-1, -1, 0},
                               {-1, 1, 0},
                               {0, -1, 0},
                               {0, 1, 0},
                               {std::cos(a), -1, std::sin(a)},
                               {std::cos(a), 1, std::sin(a)}},
                              {{0, 2, 1}, {1, 2, 3}, {2, 4, 3}, {3, 4, 5}}};
    const double speed = 0.3;
    Track track{{.x = -0.02, .y = 0.03, .velocity = {speed, 0, 0}, .spin = {0, speed / radius, 0}}, {valley}};
    run_for(track, 0.03);
    const double energy = test::mechanical_energy(track) - weight * radius;
    double before = track.touch().normal, largest = 0.0;
    while (track.time() < 0.15) {
      track.step();
      const auto touch = track.touch();
      REQUIRE(touch.contacts <= 1);
      largest = std::max(largest, std::abs(touch.normal - before));
      before = touch.normal;
    }
    // In one step the spring's end moves by at most v dt sin(angle); the dashpot feels the new normal at
    // once.
    const double contact = 1e4, m = weight / 9.81;
    const double dashpot = 2.0 * damping_ratio(0.5) * std::sqrt(contact * m);
    CHECK(largest < 1.1 * (contact * track.time_step() + dashpot) * speed * std::sin(a));
    CHECK(track.bodies().position(0).x() > 0.005); // and is on its way up the other side
    // With all of its energy but the little that the kink takes.
    CHECK(test::mechanical_energy(track) - weight * radius > 0.95 * energy);
  }
}

TEST_CASE("a ball dropped on an edge or vertex of a box is thrown back along the line to it") {
  const TriangleMesh box = test::box_mesh({0.1, 0.1, 0.1});
  const Vector corner{0.05, 0.05, 0.05};
  for (const Vector& out : {Vector{1, 0, 1}, Vector{1, 1, 1}, Vector{0, 0, 1}}) {
    const Vector n = out.normalized();
    const Vector feature = corner.cwiseProduct(out) + Vector{0, out.y() > 0 ? 0.0 : 0.013, 0};
    Simulation<> sim{{.gravity = Vector::Zero(), .time_step = 5e-6}};
    Material hard = rock;
    hard.restitution = 1.0;
    const auto id = sim.add_material(hard);
    sim.add(
        {.clump = &ball, .material = id, .position = feature + (radius + 1e-4) * n, .velocity = -0.2 * n});
    sim.add_wall({.name = "box", .surfaces = {{box, id}}, .dynamics = Fixed{}});
    run_for(sim, 0.01);
    CHECK((sim.bodies().velocity(0) - 0.2 * n).norm() < 2e-3 * 0.2);
    CHECK(sim.bodies().angular_velocity(0).norm() < 1e-9);
  }
}

} // namespace mesh_rolling_tests
