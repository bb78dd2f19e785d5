/// \file
/// A bed comes to rest and stays there, and no energy is lost unaccounted for.

#include "scree/contact/hertz_mindlin.hpp"
#include "scree/contact/rolling_resistance.hpp"
#include "scree/core/random.hpp"
#include "scree/simulation/run.hpp"
#include "scree/simulation/simulation.hpp"
#include "support/models.hpp"
#include "support/relative_error.hpp"
#include "support/scenes.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <vector>

using namespace scree;

namespace energy_tests {

namespace {

struct Case {
  bool stones = false;
  double restitution = 1.0;
  double local_damping = 0.0;
  bool moving_floor = false;
};

constexpr double size = 0.01, width = 0.07;

/// Bodies that are thrown into a box.
template <class Model>
struct Bed : Simulation<Model> {
  Clump clump;

  static auto law() {
    if constexpr (std::is_constructible_v<typename Model::Contact, RollingResistance>) {
      return typename Model::Contact{RollingResistance{.damping = 0.3}}; // as Ai et al. (2011) take it
    } else {
      return typename Model::Contact{};
    }
  }

  explicit Bed(const Case& c, double step_safety, std::size_t count = 45)
      : Simulation<Model>{{.contact = law(),
                           .step_safety = step_safety,
                           .top_speed = 3.0,
                           .local_damping = c.local_damping}},
        clump{c.stones ? test::stone(0.8 * size) : test::ball(size)} {
    const auto rock = this->add_material({.normal_stiffness = 4e4,
                                          .shear_stiffness = 3e4,
                                          .youngs_modulus = 2e7,
                                          .friction = 0.4,
                                          .restitution = c.restitution,
                                          .rolling_friction = 0.1});
    Random random{181};
    for (std::size_t k = 0; k < count; ++k) {
      const auto at = [](std::size_t n) { return 0.011 + 0.0225 * static_cast<double>(n % 3); };
      this->add({.clump = &clump,
                 .material = rock,
                 .position = {at(k), at(k / 3), 0.015 + 0.0225 * static_cast<double>(k / 9)},
                 .orientation = random.orientation(),
                 .velocity = 0.5 * Vector{random.normal(), random.normal(), random.normal()},
                 .angular_velocity = 10.0 * Vector{random.normal(), random.normal(), random.normal()},
                 .scale = random.uniform(0.8, 1.0)});
    }
    const auto side = [&](const Vector& point, const Vector& normal) {
      this->add_wall({.name = "side", .surfaces = {{Plane{point, normal}, rock}}, .dynamics = Fixed{}});
    };
    side({0, 0, 0}, Vector::UnitX());
    side({0, 0, 0}, Vector::UnitY());
    side({width, width, 0}, -Vector::UnitX());
    side({width, width, 0}, -Vector::UnitY());
    if (c.moving_floor) {
      this->add_wall({.name = "shaker",
                      .surfaces = {{Plane{}, rock}},
                      .dynamics = Prescribed{[](double t) {
                        return Pose{0.004 * Vector{std::sin(60.0 * t), 0.0, std::sin(90.0 * t)}};
                      }}});
    } else {
      side({0, 0, 0}, Vector::UnitZ());
    }
  }
};

template <class Model>
void check_balance(const Case& c) {
  CAPTURE(c.stones);
  CAPTURE(c.restitution);
  CAPTURE(c.local_damping);
  CAPTURE(c.moving_floor);
  // The energy is that of velocities half a step behind: an error of first order in the step at every impact.
  Bed<Model> bed{c, 0.06};
  bed.step();
  const double start = test::mechanical_energy(bed), lost_before = bed.dissipation().total();
  double work_before = 0.0;
  for (const auto& wall : bed.walls()) {
    work_before += wall.load.work;
  }
  for (int part = 1; part <= 3; ++part) {
    run_for(bed, 0.08);
    double work = -work_before;
    for (const auto& wall : bed.walls()) {
      work += wall.load.work;
    }
    const double lost = bed.dissipation().total() - lost_before;
    const double missing = start + work - test::mechanical_energy(bed);
    CAPTURE(part);
    CHECK(missing == test::about(lost, 0.01));
    if (c.moving_floor) {
      CHECK(std::abs(work) > 0.1 * lost); // it matters
    }
  }
  CHECK(bed.dissipation().friction > 0.05 * bed.dissipation().total());
  CHECK((bed.dissipation().viscous > 0.05 * bed.dissipation().total()) == (c.restitution < 1.0));
  CHECK((bed.dissipation().local_damping > 0.05 * bed.dissipation().total()) == (c.local_damping > 0.0));
}

/// The largest resultant on a body over the mean contact force.
template <class Sim>
double unbalanced(const Sim& sim) {
  const auto& bodies = sim.bodies();
  double most = 0.0, sum = 0.0;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    Vector force = bodies.mass(b) * sim.setup().gravity;
    for (std::size_t s = bodies.first_sphere(b); s < bodies.first_sphere(b + 1); ++s) {
      force += to_eigen(bodies.forces()[s].force);
    }
    most = std::max(most, force.norm());
  }
  std::size_t contacts = 0;
  sim.visit_contacts([&](const ContactView& c) {
    sum += c.force.norm();
    ++contacts;
  });
  return contacts > 0 ? most / (sum / static_cast<double>(contacts)) : 1e9;
}

// With rolling resistance, as a lone sphere on the floor would roll on for ever.
template <class Model>
void check_rest(bool stones) {
  CAPTURE(stones);
  Bed<Model> bed{{.stones = stones, .restitution = 0.6, .local_damping = 0.5}, 0.25};
  run_for(bed, 2.5);
  CHECK(unbalanced(bed) < 1e-4);
  // And stays, without the help of the damping.
  bed.set_local_damping(0.0);
  std::vector<Vector> at;
  for (std::size_t b = 0; b < bed.bodies().size(); ++b) {
    at.push_back(bed.bodies().position(b));
  }
  const std::uint64_t first = bed.bodies().id(0);
  double most = 0.0;
  for (int k = 0; k < 10; ++k) {
    run_for(bed, 0.03);
    most = std::max(most, unbalanced(bed));
  }
  CHECK(most < 1e-4);
  REQUIRE(bed.bodies().id(0) == first);
  for (std::size_t b = 0; b < bed.bodies().size(); ++b) {
    CHECK((bed.bodies().position(b) - at[b]).norm() < 1e-6 * size);
  }
}

} // namespace

TEST_CASE("physics: energy lost is energy dissipated, linear law") {
  for (const bool stones : {false, true}) {
    for (const bool moving : {false, true}) {
      check_balance<DefaultModel>({.stones = stones, .restitution = 0.5, .moving_floor = moving});
      check_balance<DefaultModel>({.stones = stones, .local_damping = 0.2, .moving_floor = moving});
    }
  }
}

TEST_CASE("physics: energy lost is energy dissipated, Hertz-Mindlin law") {
  for (const bool stones : {false, true}) {
    for (const bool moving : {false, true}) {
      check_balance<test::Hertzian>({.stones = stones, .restitution = 0.5, .moving_floor = moving});
      check_balance<test::Hertzian>({.stones = stones, .local_damping = 0.2, .moving_floor = moving});
    }
  }
}

TEST_CASE("physics: a loose stack comes to rest and stays there, linear law") {
  check_rest<test::RollingLinear>(false);
  check_rest<test::RollingLinear>(true);
}

TEST_CASE("physics: a loose stack comes to rest and stays there, Hertz-Mindlin law") {
  check_rest<test::RollingHertzian>(false);
  check_rest<test::RollingHertzian>(true);
}

} // namespace energy_tests
