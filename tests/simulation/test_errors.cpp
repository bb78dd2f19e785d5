/// \file
/// What a simulation refuses, and where it stops by itself.

#include "scree/simulation/run.hpp"
#include "scree/simulation/simulation.hpp"
#include "support/relative_error.hpp"
#include "support/scenes.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

using namespace scree;

namespace errors_tests {

namespace {

const double not_a_number = std::numeric_limits<double>::quiet_NaN();
const Clump ball = test::ball(0.01);
const Material rock{.name = "rock", .normal_stiffness = 1e4, .shear_stiffness = 1e4};

void refused(const Setup<>& setup, const char* what) {
  CAPTURE(what);
  CHECK_THROWS_WITH_AS(Simulation<>{setup}, doctest::Contains(what), Error);
}

} // namespace

TEST_CASE("a field of the setup out of its range is refused by name") {
  CHECK_NOTHROW(Simulation<>{Setup<>{}});
  refused({.gravity = {0, not_a_number, 0}}, "gravity");
  refused({.period = {-1, 0, 0}}, "period[0]");
  refused({.period = {0, not_a_number, 0}}, "period[1]");
  refused({.time_step = -1e-5}, "time_step");
  refused({.time_step = not_a_number}, "time_step");
  refused({.step_safety = 0.0}, "step_safety");
  refused({.step_safety = 1.1}, "step_safety");
  refused({.top_speed = 0.0}, "top_speed");
  refused({.top_speed = not_a_number}, "top_speed");
  refused({.local_damping = -0.1}, "local_damping");
  refused({.local_damping = 1.0}, "local_damping");

  Simulation<> sim;
  CHECK_THROWS_WITH_AS(sim.set_local_damping(1.0), doctest::Contains("local_damping"), Error);
  CHECK(sim.setup().local_damping == 0.0);
}

TEST_CASE("a body that is not a number, of an unknown material or without a shape is refused and not added") {
  Simulation<> sim;
  const auto id = sim.add_material(rock);
  CHECK_THROWS_WITH_AS(sim.add({.clump = &ball, .material = id, .position = {0, not_a_number, 0}}),
                       doctest::Contains("position, orientation or velocity"), Error);
  CHECK_THROWS_AS(sim.add({.clump = &ball, .material = id, .velocity = {not_a_number, 0, 0}}), Error);
  CHECK_THROWS_WITH_AS(sim.add({.clump = &ball, .material = 7}), doctest::Contains("material number 7"),
                       Error);
  CHECK_THROWS_AS(sim.add({.clump = &ball, .material = id, .scale = -1.0}), Error);
  CHECK_THROWS_AS(sim.add({.material = id}), Error);
  CHECK(sim.bodies().empty());
}

TEST_CASE("a wall of an unknown material is refused and not added") {
  Simulation<> sim;
  CHECK_THROWS_WITH_AS(sim.add_wall({.name = "floor", .surfaces = {{Plane{}, 3}}, .dynamics = Fixed{}}),
                       doctest::Contains("material number 3"), Error);
  CHECK(sim.walls().empty());
}

TEST_CASE("a material without what the law reads is refused by name at the first step") {
  Simulation<> sim;
  const auto id = sim.add_material({.name = "dust", .youngs_modulus = 1e7});
  sim.add({.clump = &ball, .material = id});
  CHECK_THROWS_WITH_AS(sim.step(), doctest::Contains("'dust'"), Error);
}

TEST_CASE("a body that has left for good is reported by its id, place and time") {
  Simulation<> sim{{.gravity = Vector::Zero(), .time_step = 1e-4}};
  const auto id = sim.add_material(rock);
  sim.add({.clump = &ball, .material = id});
  sim.add({.clump = &ball, .material = id, .position = {1, 0, 0}, .velocity = {1e12, 0, 0}});
  CHECK_THROWS_WITH_AS(run_for(sim, 1.0), doctest::Contains("body 1 has left the domain"), Error);
  CHECK(sim.time() > 0.0);
  CHECK(sim.time() < 0.02);

  // Within a billion metres nothing is wrong.
  Simulation<> wide{{.gravity = Vector::Zero(), .time_step = 1e-4}};
  wide.add({.clump = &ball,
            .material = wide.add_material(rock),
            .position = {9e8, 0, -9e8},
            .velocity = {1e3, 0, 0}});
  CHECK_NOTHROW(run_for(wide, 0.01));
}

TEST_CASE("a motion that has blown up is reported by the body") {
  Simulation<> sim{{.gravity = Vector::Zero(), .time_step = 1e-4}};
  const auto id = sim.add_material(rock);
  sim.add({.clump = &ball, .material = id});
  sim.add({.clump = &ball, .material = id, .position = {1, 0, 0}, .velocity = {0, 0, 1e160}});
  CHECK_THROWS_WITH_AS(run_for(sim, 0.01), doctest::Contains("body 1"), Error);
}

TEST_CASE("two spheres in the very same place are reported, not passed over") {
  Simulation<> sim{{.time_step = 1e-5}};
  const auto id = sim.add_material(rock);
  sim.add({.clump = &ball, .material = id});
  sim.add({.clump = &ball, .material = id});
  CHECK_THROWS_AS(run_for(sim, 1e-3), Error);
}

TEST_CASE("a period too short for its spheres is refused with the least one") {
  const auto run = [](double period) {
    Simulation<> sim{{.period = {0, period, 0}, .time_step = 1e-5}};
    sim.add({.clump = &ball, .material = sim.add_material(rock)});
    sim.step();
  };
  // Three times the diameter and the skin, 0.3 of the radius.
  CHECK_NOTHROW(run(3.0 * 0.0231));
  CHECK_THROWS_WITH_AS(run(3.0 * 0.0229), doctest::Contains("period[1]"), Error);
}

TEST_CASE("observers are called at their intervals, and see the simulation at its times") {
  Simulation<> sim{{.time_step = 1e-3}};
  std::vector<double> seen;
  std::size_t each = 0;
  run_for(sim, 0.1, Every{0.025, [&](const auto& s) { seen.push_back(s.time()); }},
          [&](const auto&) { ++each; });
  CHECK(sim.steps() == 100);
  CHECK(sim.time() == test::about(0.1, 1e-12));
  CHECK(each == 100);
  REQUIRE(seen.size() == 4);
  CHECK(seen[0] == test::about(0.001));
  CHECK(seen[1] == test::about(0.026));
  CHECK(seen[3] == test::about(0.076));

  std::size_t steps = 0;
  run_while(
      sim, [](const auto& s) { return s.time() < 0.1095; }, [&](const auto&) { ++steps; });
  CHECK(steps == 10);
  CHECK_THROWS_WITH_AS(run_for(sim, -1.0), doctest::Contains("duration"), Error);
  CHECK_THROWS_AS(Every(0.0, [](const auto&) {}), Error);
  run_for(sim, 0.0);
  CHECK(sim.steps() == 110);
}

TEST_CASE("looking at a simulation does not change what happens") {
  const auto run = [](bool look) {
    Simulation<> sim{{.time_step = 2e-5}};
    const auto id = sim.add_material(rock);
    for (int k = 0; k < 20; ++k) {
      sim.add(
          {.clump = &ball, .material = id, .position = 0.019 * Vector(k % 2, 0.1 * (k % 3), 0.55 + k / 2)});
    }
    sim.add_wall({.name = "floor", .surfaces = {{Plane{}, id}}, .dynamics = Fixed{}});
    double sum = 0.0;
    run_for(sim, 0.05, [&](const auto& s) {
      if (look) {
        s.visit_contacts([&](const ContactView& c) { sum += c.force.norm(); });
        sum += s.step_limit().critical;
      }
    });
    CHECK((sum > 0.0) == look);
    std::vector<Vector> at;
    for (std::size_t b = 0; b < 20; ++b) {
      at.push_back(sim.bodies().position(b));
    }
    return at;
  };
  CHECK(run(false) == run(true));
}

} // namespace errors_tests
