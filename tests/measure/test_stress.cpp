#include "scree/measure/stress.hpp"
#include "scree/packing/loose_lattice.hpp"
#include "scree/simulation/run.hpp"
#include "scree/simulation/simulation.hpp"
#include "support/relative_error.hpp"
#include "support/scenes.hpp"

#include <doctest/doctest.h>

using namespace scree;
using test::about;

namespace {

constexpr double stiffness = 1e4; // N/m, at the contact

/// Without gravity and with steps so short that nothing moves, unless said otherwise.
Simulation<> still(const Vector& period = Vector::Zero(), const Vector& gravity = Vector::Zero(),
                   double time_step = 1e-12) {
  return Simulation<>{
      {.stiffness = Stiffness::of_contact, .gravity = gravity, .period = period, .time_step = time_step}};
}

MaterialId add_rock(Simulation<>& sim) {
  return sim.add_material({.normal_stiffness = stiffness, .shear_stiffness = stiffness});
}

/// A periodic simple cubic lattice of 4 x 4 x 4 spheres of radius 1 at the given distances.
void add_lattice(Simulation<>& sim, const Vector& pitch) {
  const Clump ball = test::ball(1.0);
  const MaterialId rock = add_rock(sim);
  const Vector corner{0.15, 0.25, 0.35}; // so that no line of centres lies in a face of a box
  for (int x = 0; x < 4; ++x) {
    for (int y = 0; y < 4; ++y) {
      for (int z = 0; z < 4; ++z) {
        const Vector at = corner + pitch.cwiseProduct(Vector(x, y, z));
        sim.add({.clump = &ball, .material = rock, .position = at});
      }
    }
  }
  sim.step();
}

} // namespace

TEST_CASE("stress of a cubic lattice is the contact force over the face of its cell") {
  const Vector pitch{1.98, 1.96, 1.99};
  Simulation<> sim = still(4.0 * pitch);
  add_lattice(sim, pitch);
  const Vector force = stiffness * (Vector::Constant(2.0) - pitch);
  const double cell = pitch.prod();
  // Boxes of whole cells, wherever they cut the spheres: over the corner of the domain, and all of it.
  for (const Vector& corner : {Vector{0.0, 0.0, 0.0}, Vector{0.3, 0.9, 1.3}, Vector{1.2, 2.9, 2.5}}) {
    const Matrix stress = mean_stress(sim, {corner, Vector(corner + 2.0 * pitch)});
    CAPTURE(corner.transpose());
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        const double expected = i == j ? force[i] * pitch[i] / cell : 0.0;
        CHECK(std::abs(stress(i, j) - expected) < 1e-9 * force.maxCoeff());
      }
    }
  }
  const Matrix all = mean_stress(sim, {Vector::Zero(), Vector(4.0 * pitch)});
  for (int d = 0; d < 3; ++d) {
    CHECK(all(d, d) == about(force[d] * pitch[d] / cell));
    // Sixteen rows of spheres go through any plane, also through the periodic boundary.
    for (const double at : {0.1, 1.0, 3.9 * pitch[d], -0.5}) {
      const Vector through = force_through_plane(sim, d, at);
      CHECK(through[d] == about(16.0 * force[d]));
      CHECK(through.norm() == about(16.0 * force[d]));
    }
  }
}

TEST_CASE("stress of two squeezed spheres is their force times their distance over the volume") {
  Simulation<> sim = still();
  const Clump ball = test::ball(1.0);
  const MaterialId rock = add_rock(sim);
  const Vector normal = Vector{1.0, 2.0, 2.0} / 3.0;
  constexpr double distance = 1.9;
  sim.add({.clump = &ball, .material = rock, .position = distance * normal});
  sim.add({.clump = &ball, .material = rock});
  sim.step();
  const Eigen::AlignedBox3d box{Vector::Constant(-0.1), Vector::Constant(1.5)};
  const Matrix expected = stiffness * 0.1 * distance * normal * normal.transpose() / box.volume();
  CHECK((mean_stress(sim, box) - expected).norm() < 1e-9 * expected.norm());
  // Half of the line: by its middle, where z is half of what it is at its end.
  const Eigen::AlignedBox3d lower{Vector::Constant(-0.1), Vector{1.5, 1.5, distance / 3.0}};
  const Matrix half = 0.5 * expected * box.volume() / lower.volume();
  CHECK((mean_stress(sim, lower) - half).norm() < 1e-9 * half.norm());
  CHECK((force_through_plane(sim, 2, 0.4) - stiffness * 0.1 * normal).norm() < 1e-9 * stiffness);
  CHECK(force_through_plane(sim, 2, 1.3).isZero(0.0));
  CHECK(force_through_plane(sim, 2, -0.1).isZero(0.0));
}

TEST_CASE("planes through a stack on a floor bear what is above them") {
  constexpr double g = 10.0, density = 1000.0;
  Simulation<> sim = still(Vector::Zero(), {0.0, 0.0, -g}, 1e-5);
  const Clump ball = test::ball(0.1);
  const double weight = density * g * ball.volume;
  const MaterialId rock = sim.add_material(
      {.density = density, .normal_stiffness = 1e6, .shear_stiffness = 1e6, .restitution = 0.5});
  double top = 0.0;
  for (int k = 0; k < 3; ++k) { // each as deep in the next as at rest
    const double overlap = (3 - k) * weight / 1e6;
    top += k == 0 ? 0.1 - overlap : 0.2 - overlap;
    sim.add({.clump = &ball, .material = rock, .position = {0.0, 0.0, top}});
  }
  sim.add_wall({.name = "floor", .surfaces = {{Plane{}, rock}}, .dynamics = Fixed{}});
  run_for(sim, 1e-3);
  CHECK(force_through_plane(sim, 2, 0.05).z() == about(3.0 * weight, 1e-6));
  CHECK(force_through_plane(sim, 2, 0.2).z() == about(2.0 * weight, 1e-6));
  CHECK(force_through_plane(sim, 2, 0.4).z() == about(weight, 1e-6));
  CHECK(force_through_plane(sim, 2, 0.55).z() == 0.0);
  CHECK(force_through_plane(sim, 2, -0.01).z() == 0.0); // below the floor
}

TEST_CASE("the mean stress of a layer is the mean of the forces through its planes") {
  const Vector period{4.0, 5.0, 0.0};
  Simulation<> sim = still(period);
  const MaterialId rock = add_rock(sim);
  // Stones thrown about at random, in one another: forces of all sizes and directions.
  const Clump stone = test::stone(0.5);
  Random random{7, "stones"};
  for (int k = 0; k < 120; ++k) {
    const Vector at{random.uniform(0.0, 4.0), random.uniform(0.0, 5.0), random.uniform(0.0, 4.0)};
    sim.add({.clump = &stone,
             .material = rock,
             .position = at,
             .orientation = random.orientation(),
             .velocity = Vector{random.normal(), random.normal(), random.normal()}});
  }
  sim.add_wall({.name = "floor", .surfaces = {{Plane{}, rock}}, .dynamics = Fixed{}});
  sim.step();
  const Eigen::AlignedBox3d layer{Vector{0.0, 0.0, -0.1}, Vector{4.0, 5.0, 2.7}};
  const Matrix stress = mean_stress(sim, layer);
  constexpr int planes = 4000;
  Vector mean = Vector::Zero();
  for (int k = 0; k < planes; ++k) {
    mean += force_through_plane(sim, 2, -0.1 + 2.8 * (k + 0.5) / planes) / planes;
  }
  CHECK(mean.z() > 0.0);
  CHECK((stress.col(2) - mean / 20.0).norm() < 1e-3 * stress.norm());
}

TEST_CASE("stress refuses what it cannot measure") {
  const Simulation<> sim = still({2.0, 0.0, 0.0});
  const Eigen::AlignedBox3d box{Vector::Zero(), Vector::Ones()};
  CHECK(mean_stress(sim, box).isZero(0.0));
  CHECK_THROWS_AS((void)mean_stress(sim, Eigen::AlignedBox3d{}), Error);
  CHECK_THROWS_AS((void)mean_stress(sim, {Vector::Zero(), Vector{1.0, 0.0, 1.0}}), Error);
  CHECK_THROWS_AS((void)mean_stress(sim, {Vector{1.5, 0.0, 0.0}, Vector{2.5, 1.0, 1.0}}), Error);
  CHECK_NOTHROW((void)mean_stress(sim, {Vector{0.0, -5.0, 0.0}, Vector{2.0, 5.0, 1.0}}));
  CHECK_THROWS_AS((void)force_through_plane(sim, 3, 0.0), Error);
}
