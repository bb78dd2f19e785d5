/// \file
/// What goes wrong with a run is found in time and named.

#include "scree/measure/watchdog.hpp"
#include "scree/simulation/run.hpp"
#include "support/models.hpp"
#include "support/scenes.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <string>

using namespace scree;

namespace watchdog_tests {

namespace {

/// A ball in a box of planes, with a lid that a force moves and a block on a rope.
struct Scene {
  Simulation<> sim;
  MaterialId rock = sim.add_material({.normal_stiffness = 1e4, .shear_stiffness = 1e4});
  Clump ball = test::ball(0.05);

  Scene() : sim{Setup<>{.gravity = Vector::Zero(), .time_step = 1e-4}} {
    sim.add_wall({.name = "floor", .surfaces = {{Plane{}, rock}}, .dynamics = Fixed{}});
  }

  /// What the watch says within `steps` steps.
  std::string said(const SaneBounds& bounds, std::size_t steps = 3000) {
    Watchdog watch{bounds};
    try {
      while (sim.steps() < steps) {
        sim.step();
        watch(sim);
      }
    } catch (const Error& error) {
      return error.what();
    }
    return {};
  }
  void add(const Vector& position, const Vector& velocity = Vector::Zero()) {
    sim.add({.clump = &ball, .material = rock, .position = position, .velocity = velocity});
  }
};

bool begins(const std::string& text, const std::string& with) {
  return text.substr(0, with.size()) == with;
}

} // namespace

TEST_CASE("the watch lets a sane run alone, and tells the largest overlap") {
  Scene scene;
  scene.add({0, 0, 0.1}, {0, 0, -0.5});
  CHECK(scene.said({.interval = 1}).empty());
  Watchdog watch{{.interval = 1}};
  Scene again;
  again.add({0, 0, 0.1}, {0, 0, -0.5});
  run_for(again.sim, 0.3, watch);
  // m v^2 / 2 = k d^2 / 2 of one contact in series with the floor's own stiffness.
  const double deepest = 0.5 * std::sqrt(again.sim.bodies().mass(0) / 5e3) / 0.05;
  CHECK(watch.largest_overlap() == doctest::Approx(deepest).epsilon(0.02));
}

TEST_CASE("the watch names grains that overlap too far") {
  Scene pair;
  pair.add({0, 0, 1.0});
  pair.add({0.06, 0, 1.0});
  const std::string said = pair.said({.interval = 1});
  CHECK(begins(said, "body 0 and body 1 overlap by 0."));
  CHECK(said.find("of the smaller radius, above watch.overlap = 0.3, at t = 0.0001 s (step 1). Likely grains "
                  "that overlap at the start, or a stiffness too low") != std::string::npos);

  Scene wall;
  wall.add({0, 0, 0.1}, {0, 0, -5.0});
  CHECK(begins(wall.said({}), "body 0 and wall 'floor' overlap by"));
}

TEST_CASE("the watch names grains that are too fast, too lively or elsewhere, within its interval") {
  Scene fast;
  fast.add({0, 0, 1}, {3, 0, 0});
  CHECK(begins(fast.said({.speed = 2.0}),
               "body 0 has a speed of 3 m/s, above watch.speed = 2 m/s, at t = 0.02 s"));
  CHECK(fast.sim.steps() == 200);

  Scene lively;
  lively.add({0, 0, 1}, {3, 0, 0});
  CHECK(begins(lively.said({.kinetic_energy = 1.0}), "the grains have a kinetic energy of "));

  Scene elsewhere;
  elsewhere.add({0, 0, 1}, {3, 0, 0});
  const Eigen::AlignedBox3d box{Vector{-0.5, -0.5, 0.0}, Vector{0.5, 0.5, 2.0}};
  CHECK(begins(elsewhere.said({.domain = box, .interval = 10}), "body 0 is outside the domain, at (0.5"));
  CHECK(elsewhere.sim.time() == doctest::Approx(0.5 / 3.0).epsilon(0.01));
}

TEST_CASE("the watch names a lid that has left, and ropes that are slack or stretched too far") {
  const Eigen::AlignedBox3d box{Vector{-1, -1, 0.0}, Vector{1, 1, 2.0}};
  Scene lid;
  lid.sim.add_wall({.name = "lid",
                    .surfaces = {{Plane{Vector::Zero(), -Vector::UnitZ()}, lid.rock}},
                    .dynamics = ForceControlled{{.mass = 1.0, .force = [](double) { return 100.0; }}},
                    .motion = {.position = {0, 0, 1}}});
  CHECK(begins(lid.said({.domain = box}), "wall 'lid' has left the domain, at (0, 0, -"));

  const auto rope = [](double wound) {
    Scene scene;
    scene.sim.add_wall({.name = "block",
                        .surfaces = {},
                        .dynamics = RopeCoupled{
                            {10.0, Vector::Zero(), Matrix::Identity()},
                            {{.name = "left", .winch = {1, 0, 0}, .stiffness = 10.0, .wound = [=](double t) {
                                return wound * t;
                              }}}}});
    return scene.said({.rope_strain = 0.1, .rope_slack = 0.2});
  };
  CHECK(begins(rope(1.0), "rope 'left' of 'block' is stretched by 0.1"));
  CHECK(begins(rope(-1.0), "rope 'left' of 'block' hangs through by 0.2"));
  CHECK(rope(0.0).empty());
}

TEST_CASE("bounds of the watch out of range are refused") {
  CHECK_THROWS_WITH_AS(Watchdog{SaneBounds{.overlap = 0.0}}, doctest::Contains("watch overlap = 0"), Error);
  CHECK_THROWS_WITH_AS(Watchdog{SaneBounds{.interval = 0}}, doctest::Contains("watch interval = 0 steps"),
                       Error);
}

} // namespace watchdog_tests
