/// \file
/// What a law refuses, and how the message says so.

#include "support/models.hpp"
#include "support/relative_error.hpp"

#include "scree/contact/hertz_mindlin.hpp"
#include "scree/contact/linear_spring.hpp"
#include "scree/contact/rolling_resistance.hpp"
#include "scree/simulation/simulation.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

using namespace scree;

namespace requirements_tests {
using test::relative_error;

namespace {

template <class Action>
std::string complaint(Action action) {
  try {
    action();
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

const Clump ball = make_clump("ball", std::vector<Sphere>{{Vector::Zero(), 0.01}});

} // namespace

static_assert(ContactLaw<LinearSpring<>> && ContactLaw<LinearSpring<>, float>);
static_assert(ContactLaw<HertzMindlin<>> && ContactLaw<HertzMindlin<>, float>);
static_assert(ContactLaw<LinearSpring<RollingResistance>> &&
              ContactLaw<HertzMindlin<RollingResistance>, float>);

TEST_CASE("a linear law without stiffness names the pair and the parameter") {
  Simulation<> sim{{.time_step = 1e-6}};
  sim.add_material({.name = "rock", .normal_stiffness = 1e6});
  const auto clay = sim.add_material({.name = "clay"});
  sim.add({.clump = &ball, .material = 0});
  sim.add({.clump = &ball, .material = clay, .position = {1.0, 0.0, 0.0}});
  const std::string said = complaint([&] { sim.step(); });
  CAPTURE(said);
  CHECK(holds(said, "materials 'rock' and 'clay'"));
  CHECK(holds(said, "normal_stiffness = 0 N/m at the contact must be above 0"));
}

TEST_CASE("Hertz's law without Young's modulus names the pair and the parameter") {
  Simulation<test::Hertzian> sim{{.time_step = 1e-6}};
  const auto rock = sim.add_material({.name = "rock", .youngs_modulus = 1e9});
  const auto plate = sim.add_material({.name = "plate", .normal_stiffness = 1e6});
  sim.add({.clump = &ball, .material = rock});
  sim.add_wall({.name = "lid", .surfaces = {{Plane{}, plate}}, .dynamics = Fixed{}});
  const std::string said = complaint([&] { sim.step(); });
  CAPTURE(said);
  CHECK(holds(said, "materials 'rock' and 'plate'"));
  CHECK(holds(said, "youngs_modulus gives E* = 0 Pa"));
}

TEST_CASE("an extension's parameter out of range is refused by its name") {
  using Rolling = test::RollingLinear;
  for (const double damping : {-0.1, std::nan("")}) {
    Simulation<Rolling> sim{{.contact = Rolling::Contact{RollingResistance{damping}}, .time_step = 1e-6}};
    const auto rock = sim.add_material({.name = "rock", .normal_stiffness = 1e6});
    sim.add({.clump = &ball, .material = rock});
    const std::string said = complaint([&] { sim.step(); });
    CAPTURE(said);
    CHECK(holds(said, message("RollingResistance::damping = ", damping, " is outside [0, ")));
  }
}

TEST_CASE("materials that meet nowhere need not suit the law") {
  Simulation<> sim{{.time_step = 1e-6}};
  const auto rock = sim.add_material({.name = "rock", .normal_stiffness = 1e6});
  sim.add_material({.name = "unused"});
  sim.add({.clump = &ball, .material = rock});
  CHECK(complaint([&] { sim.step(); }).empty());
}

TEST_CASE("a material out of range is refused where it is added, given for a pair or changed") {
  Simulation<> sim{{.time_step = 1e-6}};
  const auto rock = sim.add_material({.name = "rock", .normal_stiffness = 1e6});
  CHECK(complaint([&] { sim.add_material({.name = "ice", .restitution = 1.2}); }) ==
        "material 'ice': restitution = 1.2 is outside [1e-06, 1]");
  CHECK(holds(complaint([&] { sim.add_material({.name = "ice", .friction = -0.2}); }),
              "material 'ice': friction = -0.2 is outside [0, "));
  CHECK(holds(complaint([&] { sim.set_pair(rock, rock, {.friction = -1.0}); }),
              "pair 'rock'-'rock': friction = -1 is outside [0, "));
  CHECK(complaint([&] { sim.change_material(rock, {.name = "rock", .poisson_ratio = 0.7}); }) ==
        "material 'rock': poisson_ratio = 0.7 is outside [0, 0.5]");
  CHECK(sim.materials().at(rock).poisson_ratio == 0.25);
}

TEST_CASE("a law tells the stiffest that a contact gets, for the time step") {
  const Material m{
      .normal_stiffness = 4e6, .shear_stiffness = 2e6, .youngs_modulus = 1e9, .poisson_ratio = 0.2};
  const auto pair = mix(m, m, Stiffness::of_particle);
  const auto linear = LinearSpring<>{}.stiffness(pair, 0.005, 0.01, 1.0);
  CHECK(linear.normal == 2e6);
  CHECK(linear.shear == 1e6);
  // Hertz: dF/dU = 2 E* sqrt(R* U) at the largest overlap of a free impact.
  const double e = 1e9 / (2.0 * 0.96), g = 1e9 / (2.0 * 1.2 * 1.8 * 2.0);
  const double overlap = std::pow(15.0 / 16.0 * 0.01 * 9.0 / (e * std::sqrt(0.005)), 0.4);
  const auto hertz = HertzMindlin<>{}.stiffness(pair, 0.005, 0.01, 3.0);
  CHECK(relative_error(hertz.normal, 2.0 * e * std::sqrt(0.005 * overlap)) < 1e-12);
  CHECK(relative_error(hertz.shear, 8.0 * g * std::sqrt(0.005 * overlap)) < 1e-12);
}

} // namespace requirements_tests
