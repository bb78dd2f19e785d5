#include "scree/core/random.hpp"
#include "scree/simulation/run.hpp"
#include "scree/simulation/simulation.hpp"
#include "support/meshes.hpp"
#include "support/relative_error.hpp"
#include "support/scenes.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

using namespace scree;

namespace stable_step_tests {

namespace {

/// States a stiffness that is too small by the square of a factor, so that steps longer by that factor pass.
struct Understated : LinearSpring<> {
  double factor = 1.0;

  [[nodiscard]] ContactStiffness stiffness(const PairMaterial<double>& pair, double radius, double mass,
                                           double speed) const {
    const ContactStiffness k = LinearSpring<>::stiffness(pair, radius, mass, speed);
    return {k.normal / (factor * factor), k.shear / (factor * factor)};
  }
};

struct Model : DefaultModel {
  using Contact = Understated;
};
using Sim = Simulation<Model>;

constexpr double radius = 0.01, apart = 2.0 * radius * (1.0 - 1e-3);

struct Crystal {
  const char* name;
  Vector period;
  std::vector<Vector> centres;
};

/// Closest packings, a little compressed, of 256 and 384 spheres.
Crystal face_centred_cubic() {
  const double a = apart * std::sqrt(2.0);
  Crystal crystal{"fcc", Vector::Constant(4.0 * a), {}};
  for (int n = 0; n < 64; ++n) {
    for (const Vector& o : {Vector{0, 0, 0}, Vector{0.5, 0.5, 0}, Vector{0.5, 0, 0.5}, Vector{0, 0.5, 0.5}}) {
      crystal.centres.push_back(a * (Vector(n % 4, n / 4 % 4, n / 16) + o + Vector::Constant(0.25)));
    }
  }
  return crystal;
}
Crystal hexagonal() {
  const double h = apart * std::sqrt(2.0 / 3.0), s = apart * std::sqrt(3.0);
  Crystal crystal{"hcp", {6.0 * apart, 4.0 * s, 8.0 * h}, {}};
  for (int n = 0; n < 96; ++n) {
    for (const Vector& o : {Vector{0, 0, 0}, Vector{0.5 * apart, 0.5 * s, 0}, Vector{0.5 * apart, s / 6.0, h},
                            Vector{0, s * 2.0 / 3.0, h}}) {
      crystal.centres.push_back(Vector(n % 6 * apart, n / 6 % 4 * s, n / 24 * 2.0 * h) + o +
                                Vector::Constant(0.1 * apart));
    }
  }
  return crystal;
}

double kinetic_energy(const Sim& sim) {
  double sum = 0.0;
  for (std::size_t b = 0; b < sim.bodies().size(); ++b) {
    sum += sim.bodies().kinetic_energy(b);
  }
  return sum;
}

/// By how much the kinetic energy of a slightly shaken crystal grows in 2000 steps of `factor` times the
/// critical one.
double growth(const Crystal& crystal, double factor, double restitution, double shear_ratio = 1.0,
              double odd_density = 2650.0) {
  Understated law;
  law.factor = factor;
  Sim sim{{.contact = law,
           .stiffness = Stiffness::of_contact,
           .gravity = Vector::Zero(),
           .period = crystal.period,
           .step_safety = 1.0}};
  // No slip, so that the springs stay linear.
  const Material rock{.normal_stiffness = 1e4,
                      .shear_stiffness = 1e4 * shear_ratio,
                      .friction = 1e9,
                      .restitution = restitution};
  Material odd = rock;
  odd.density = odd_density;
  const auto common = sim.add_material(rock), other = sim.add_material(odd);
  const Clump ball = test::ball(radius);
  Random random{171};
  for (const Vector& centre : crystal.centres) {
    sim.add({.clump = &ball,
             .material = sim.bodies().size() == 100 ? other : common,
             .position = centre,
             .velocity = 1e-7 * Vector{random.normal(), random.normal(), random.normal()},
             .angular_velocity = 1e-5 * Vector{random.normal(), random.normal(), random.normal()}});
  }
  const double start = kinetic_energy(sim);
  double most = 0.0;
  for (int k = 0; k < 2000 && most < 1e6 * start; ++k) {
    sim.step();
    most = std::max(most, kinetic_energy(sim));
  }
  std::size_t contacts = 0;
  sim.visit_contacts([&](const ContactView&) { ++contacts; });
  CHECK((most > 1e3 * start || contacts == 6 * crystal.centres.size()));
  return most / start;
}

} // namespace

TEST_CASE("physics: closest packings are stable at the critical step, and not far above it") {
  for (const Crystal& crystal : {face_centred_cubic(), hexagonal()}) {
    for (const double restitution : {1.0, 0.5, 0.1}) {
      CAPTURE(crystal.name);
      CAPTURE(restitution);
      CHECK(growth(crystal, 1.0, restitution) < 10.0);
      CHECK(growth(crystal, 2.0, restitution) > 1e5);
    }
    CHECK(growth(crystal, 1.0, 0.5, 0.5) < 10.0);
    CHECK(growth(crystal, 1.0, 0.5, 0.0) < 10.0);
  }
}

TEST_CASE("physics: a light sphere among heavy ones is stable at the critical step, which it sets") {
  for (const double restitution : {1.0, 0.5}) {
    CHECK(growth(face_centred_cubic(), 1.0, restitution, 1.0, 26.5) < 10.0);
    CHECK(growth(face_centred_cubic(), 2.0, restitution, 1.0, 26.5) > 1e5);
  }
}

namespace {

struct StackSetup {
  double safety = 0.5;
  double time_step = 0.0;
  double stiffness = 1e5;
  double density = 2650.0;
};

/// Two balls above each other on a floor.
struct Stack : Sim {
  explicit Stack(const StackSetup& s = {}) : Sim{{.time_step = s.time_step, .step_safety = s.safety}} {
    const auto rock = add_material({.name = "granite",
                                    .density = s.density,
                                    .normal_stiffness = s.stiffness,
                                    .shear_stiffness = s.stiffness});
    const Clump ball = test::ball(radius);
    add({.clump = &ball, .material = rock, .position = {0, 0, radius}});
    add({.clump = &ball, .material = rock, .position = {0, 0, 3.0 * radius}});
    add_wall({.name = "floor", .surfaces = {{Plane{}, rock}}, .dynamics = Fixed{}});
  }
};

std::string refusal(Sim& sim) {
  try {
    sim.step();
  } catch (const Error& error) {
    return error.what();
  }
  return "none";
}

bool holds(const std::string& text, const char* part) {
  return text.find(part) != std::string::npos;
}

} // namespace

TEST_CASE("the step given is used, the stable one where none is given, and one above it is refused by name") {
  Stack sim;
  const double stable = sim.time_step();
  CHECK(stable == test::about(0.5 * sim.step_limit().critical, 1e-14));
  CHECK(Stack{{.safety = 0.25}}.time_step() == test::about(0.5 * stable, 1e-14));
  CHECK(Stack{{.time_step = 0.3 * stable}}.time_step() == 0.3 * stable);
  CHECK(Stack{{.time_step = 0.999 * stable}}.time_step() == 0.999 * stable);

  Stack hasty{{.time_step = 1.001 * stable}};
  CHECK_THROWS_AS((void)hasty.time_step(), Error);
  const std::string text = refusal(hasty);
  CHECK(holds(text, "time_step = "));
  CHECK(holds(text, "above the stable"));
  CHECK(holds(text, "'granite'"));
  CHECK(holds(text, "body"));
  CHECK(holds(text, message(5e4, " N/m").c_str())); // the contact's, of two particles in series
  CHECK(hasty.steps() == 0);
}

TEST_CASE("the critical step scales as the root of mass over stiffness") {
  const double critical = Stack{}.step_limit().critical;
  CHECK(Stack{{.stiffness = 4e5}}.step_limit().critical == test::about(0.5 * critical, 1e-12));
  CHECK(Stack{{.density = 4.0 * 2650.0}}.step_limit().critical == test::about(2.0 * critical, 1e-12));
}

TEST_CASE("the lightest free body sets the step, whatever else there is") {
  Stack sim;
  const double critical = sim.step_limit().critical;
  const Clump small = test::ball(0.1 * radius), large = test::ball(10.0 * radius);
  sim.add({.clump = &large, .position = {1, 0, 0.1}});
  CHECK(sim.step_limit().critical == critical);
  sim.add({.clump = &small, .position = {2, 0, 0.1}, .fixed = true});
  CHECK(sim.step_limit().critical == critical);
  const auto id = sim.add({.clump = &small, .position = {3, 0, 0.1}});
  CHECK(sim.step_limit().critical == test::about(critical * std::sqrt(1e-3), 1e-12));
  CHECK(holds(sim.step_limit().cause, message("body ", id).c_str()));
}

TEST_CASE("a step that has become too long is refused when it has") {
  Stack sim;
  const double stable = sim.time_step();
  Stack given{{.time_step = stable}};
  run_for(given, 20.0 * stable);
  const double time = given.time();
  given.change_material(0, {.name = "steel", .normal_stiffness = 1e7, .shear_stiffness = 1e7});
  CHECK(holds(refusal(given), "'steel'"));
  CHECK(given.time() == time);

  // The automatic one becomes shorter, and time goes on from where it was.
  run_for(sim, 20.0 * stable);
  const double before = sim.time();
  sim.change_material(0, {.name = "steel", .normal_stiffness = 1e7, .shear_stiffness = 1e7});
  sim.step();
  CHECK(sim.time_step() == test::about(0.1 * stable));
  CHECK(sim.time() == test::about(before + 0.1 * stable, 1e-12));
}

TEST_CASE("where nothing sets a step one has to be given") {
  Sim empty{Setup<Model>{}};
  CHECK(holds(refusal(empty), "give one"));
  Sim given{{.time_step = 0.01}};
  given.step();
  CHECK(given.time() == 0.01);
}

namespace {

/// A plate hung on one rope, a little stretched.
struct HungPlate : Sim {
  HungPlate(double safety, double damping, double time_step = 0.0)
      : Sim{{.time_step = time_step, .step_safety = safety}} {
    const auto steel = add_material({.name = "steel", .normal_stiffness = 1e6, .shear_stiffness = 1e6});
    const MassProperties body{2.0, Vector::Zero(), Vector{0.01, 0.01, 0.015}.asDiagonal()};
    const Rope hoist{.name = "hoist",
                     .hitch = {0.1, 0, 0.02},
                     .winch = {0.1, 0, 1},
                     .stiffness = 1e5,
                     .damping = damping,
                     .slack = -1e-3};
    add_wall({.name = "plate",
              .surfaces = {{test::box_mesh({0.2, 0.2, 0.05}), steel}},
              .dynamics = RopeCoupled{body, {hoist}}});
  }
};

} // namespace

TEST_CASE("a rope sets the step of what hangs on it, and is named") {
  HungPlate sim{1.0, 0.0};
  const double critical = sim.time_step();
  CHECK(holds(sim.step_limit().cause, "'plate'"));
  CHECK(holds(sim.step_limit().cause, "'hoist'"));
  HungPlate hasty{1.0, 0.0, 1.01 * critical};
  CHECK(holds(refusal(hasty), "'hoist'"));
}

TEST_CASE(
    "a body between taut ropes is stable up to the critical step, damped or not, and not far above it") {
  // Pulled both ways at a point away from its centre, so that the ropes never go slack. Damping ratios up
  // to 9. The ropes move the body in the very way that the bound assumes, so that without damping the bound
  // is the limit itself.
  for (const double damping : {0.0, 50.0, 200.0, 1000.0}) {
    for (const double factor : {0.98, 1.5}) {
      CAPTURE(damping);
      CAPTURE(factor);
      const MassProperties body{2.0, Vector::Zero(), Vector{0.01, 0.01, 0.015}.asDiagonal()};
      std::vector<Rope> ropes;
      for (const double side : {1.0, -1.0}) {
        ropes.push_back({.hitch = {0.1, 0, 0},
                         .winch = {0.1, 0, side},
                         .stiffness = 1e4,
                         .damping = damping,
                         .slack = -0.01});
      }
      Sim sim{{.gravity = Vector::Zero(), .step_safety = 1.0}};
      RopeCoupled held{body, ropes};
      sim.add_wall({.name = "plate", .surfaces = {}, .dynamics = held, .motion = {.velocity = {0, 0, 1e-4}}});
      const double critical = sim.time_step();
      // By itself, to get past the refusal of a longer step.
      WallMotion motion{.velocity = {0, 0, 1e-4}};
      held.start(motion, {0.0, factor * critical, 0.5 * factor * critical, Vector::Zero()});
      double most = 0.0;
      for (int k = 0; k < 2000 && most < 1.0; ++k) {
        held.advance(motion, {}, {0.0, factor * critical, factor * critical, Vector::Zero()});
        most = std::max(most, held.kinetic_energy());
      }
      const double start = 0.5 * 2.0 * 1e-8;
      CHECK((factor > 1.0 ? most > 1e3 * start : most < 10.0 * start));
    }
  }
}

TEST_CASE("physics: a light lid on many grains sets the step, and lies still at it") {
  for (const double restitution : {1.0, 0.3}) {
    CAPTURE(restitution);
    Sim sim{{.local_damping = 0.3}};
    const auto rock = sim.add_material(
        {.name = "rock", .normal_stiffness = 1e5, .shear_stiffness = 1e5, .restitution = restitution});
    const Clump ball = test::ball(radius);
    for (int k = 0; k < 100; ++k) {
      sim.add({.clump = &ball,
               .material = rock,
               .position = radius * Vector{2.1 * (k % 10), 2.1 * (k / 10), 1.0}});
    }
    sim.add_wall({.name = "floor", .surfaces = {{Plane{}, rock}}, .dynamics = Fixed{}});
    const double without_lid = sim.time_step();
    const auto lid = sim.add_wall(
        {.name = "lid",
         .surfaces = {{Plane{{0, 0, 0}, {0, 0, -1}}, rock}},
         .dynamics = ForceControlled{{.mass = 0.001, .force = [](double) { return 5.0; }, .damping = 5.0}},
         .motion = {.position = {0, 0, 2.0 * radius}}});
    run_for(sim, 0.2);
    CHECK(sim.time_step() < 0.5 * without_lid);
    CHECK(holds(sim.step_limit().cause, "'lid'"));
    CHECK(sim.wall(lid).load.force.z() == test::about(5.0, 1e-4));
    CHECK(kinetic_energy(sim) < 1e-12);
  }
}

TEST_CASE("physics: a bed of clumps comes to rest at the critical step") {
  for (const double restitution : {0.9, 0.3}) {
    CAPTURE(restitution);
    Sim sim{{.step_safety = 1.0, .local_damping = 0.2}};
    const auto rock = sim.add_material(
        {.normal_stiffness = 1e5, .shear_stiffness = 1e5, .friction = 0.8, .restitution = restitution});
    const Clump stone = test::stone(radius);
    Random random{172};
    for (int k = 0; k < 75; ++k) {
      sim.add({.clump = &stone,
               .material = rock,
               .position = radius * Vector{2.6 * (k % 5), 2.6 * (k / 5 % 5), 2.0 + 2.6 * (k / 25)},
               .orientation = random.orientation()});
    }
    const auto plane = [&](const Vector& point, const Vector& normal) {
      sim.add_wall({.name = "wall", .surfaces = {{Plane{point, normal}, rock}}, .dynamics = Fixed{}});
    };
    const Vector low = radius * Vector{-1.5, -1.5, 0}, high = radius * Vector{12, 12, 0};
    plane(low, Vector::UnitX());
    plane(low, Vector::UnitY());
    plane(low, Vector::UnitZ());
    plane(high, -Vector::UnitX());
    plane(high, -Vector::UnitY());
    run_for(sim, 3.0); // one in some twenty such beds has a stone that rocks for more than half of it
    CHECK(kinetic_energy(sim) < 1e-9);
  }
}

} // namespace stable_step_tests
