/// \file
/// A run that is kept and taken up again ends in the same bits as the whole run.

#include "scree/contact/adhesion.hpp"
#include "scree/contact/attrition.hpp"
#include "scree/contact/normal_hysteresis.hpp"
#include "scree/core/archive.hpp"
#include "scree/core/random.hpp"
#include "scree/integrators/rotor_splitting.hpp"
#include "scree/measure/state_hash.hpp"
#include "scree/neighbours/r_tree.hpp"
#include "scree/simulation/run.hpp"
#include "support/meshes.hpp"
#include "support/models.hpp"
#include "support/scenes.hpp"

#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

using namespace scree;

namespace {

struct Worn : DefaultModel {
  using Contact = LinearSpring<Adhesion, NormalHysteresis, Attrition>;
  using Neighbours = RTree;
  using Integrator = RotorSplitting;
  static constexpr bool energy_audit = false;
};

/// Walls of every kind around grains that fly, fall and pile up. What is here is given again to a simulation
/// that takes a kept one up.
template <class Model>
std::unique_ptr<Simulation<Model>> made(const Vector& period, unsigned threads) {
  auto out = std::make_unique<Simulation<Model>>(Setup<Model>{
      .period = period, .step_safety = 0.5, .local_damping = 0.02, .threads = threads, .sort_interval = 130});
  Simulation<Model>& sim = *out;
  const auto rock = sim.add_material({.normal_stiffness = 2e4,
                                      .shear_stiffness = 1.4e4,
                                      .youngs_modulus = 2e6,
                                      .restitution = 0.6,
                                      .rolling_friction = 0.1});
  const auto steel = sim.add_material({.name = "steel",
                                       .normal_stiffness = 6e4,
                                       .shear_stiffness = 4e4,
                                       .youngs_modulus = 6e6,
                                       .friction = 0.3,
                                       .restitution = 0.6,
                                       .rolling_friction = 0.05});
  sim.add_wall({.name = "floor", .surfaces = {{Plane{}, rock}}, .dynamics = Fixed{}});
  sim.add_wall({.name = "drum",
                .surfaces = {{Cylinder{{0.65, -2.0, 0.9}, Vector::UnitY(), 1.2, 6.0}, steel}},
                .dynamics = Prescribed::constant_rotation({0.0, 2.0, 0.0}, {0.65, 0.0, 0.9})});
  sim.add_wall(
      {.name = "lid",
       .surfaces = {{Plane{Vector::Zero(), -Vector::UnitZ()}, steel}},
       .dynamics =
           ForceControlled{{.mass = 20.0, .force = [](double t) { return 500.0 * t; }, .damping = 10.0}},
       .motion = {.position = {0.0, 0.0, 0.55}}});
  const TriangleMesh block = test::box_mesh({0.3, 0.3, 0.2});
  sim.add_wall({.name = "block",
                .surfaces = {{block, steel}},
                .dynamics = RopeCoupled{{30.0, Vector::Zero(), Matrix::Identity()},
                                        {{.name = "rope",
                                          .hitch = {0.15, 0.0, 0.0},
                                          .winch = {3.0, 0.5, 0.6},
                                          .stiffness = 1e4,
                                          .damping = 20.0,
                                          .wound = [](double t) { return 0.5 * t; }}}},
                .motion = {.position = {0.5, 0.5, 0.4}}});
  return out;
}

template <class Model>
void fill(Simulation<Model>& sim) {
  Random random{4, "grains"};
  const Clump ball = test::ball(0.045), stone = test::stone(0.05);
  for (int k = 0; k < 288; ++k) {
    sim.add({.clump = k % 3 == 0 ? &stone : &ball,
             .position = {0.1 + 0.09 * (k % 12), 0.1 + 0.09 * (k / 12 % 12), 0.1 + 0.11 * (k / 144)},
             .orientation = random.orientation(),
             .velocity = {random.normal(), random.normal(), random.normal()},
             .scale = random.uniform(0.7, 1.0)});
  }
}

/// What happens to both runs: changes between steps, at fixed steps.
template <class Model>
void step(Simulation<Model>& sim) {
  if (sim.steps() == 300) {
    sim.remove_bodies([](const auto& bodies, std::size_t b) { return bodies.id(b) % 7 == 0; });
    Material rock = sim.materials().at(0);
    rock.friction = 0.2;
    sim.change_material(0, rock);
    sim.set_gravity({1.0, 0.0, -9.0});
  }
  if (sim.steps() == 400) {
    sim.fix_bodies([](const auto& bodies, std::size_t b) { return bodies.id(b) % 11 == 0; });
    sim.set_local_damping(0.1);
  }
  sim.step();
}

template <class Model>
std::string kept(const Simulation<Model>& sim) {
  ArchiveWriter writer;
  writer(sim);
  return writer.bytes();
}

/// Wall time is no state.
template <class Model>
std::uint64_t hash_of(const Simulation<Model>& sim) {
  std::uint64_t hash = state_hash(sim.bodies());
  const auto add = [&](const auto& v) {
    for (int d = 0; d < static_cast<int>(v.size()); ++d) {
      hash = (hash ^ std::bit_cast<std::uint64_t>(static_cast<double>(v[d]) + 0.0)) * 1099511628211ULL;
    }
  };
  for (const auto& wall : sim.walls()) {
    add(wall.motion.position);
    add(wall.motion.orientation.coeffs());
    add(wall.motion.velocity);
    add(wall.load.impulse);
    add(wall.load.angular_impulse);
  }
  add(Vector{sim.time(), sim.dissipation().total(),
             sim.template dynamics<RopeCoupled>(3).ropes()[0].winch_work});
  sim.visit_contacts([&](const auto& contact) { add(Vector{contact.elastic_energy, 0.0, 0.0}); });
  return hash;
}

template <class Model>
void check_split(const Vector& period) {
  constexpr std::size_t end = 900;
  const auto first = made<Model>(period, 1);
  Simulation<Model>& whole = *first;
  fill(whole);
  std::vector<std::string> states;
  std::vector<std::uint64_t> hashes;
  const std::vector<std::size_t> splits{0, 1, 2, 129, 130, 300, 301, 333, 399, 400, 650, 899};
  for (std::size_t next = 0; whole.steps() < end; step(whole)) {
    if (next < splits.size() && whole.steps() == splits[next]) {
      states.push_back(kept(whole));
      hashes.push_back(hash_of(whole));
      ++next;
    }
  }
  REQUIRE(states.size() == splits.size());
  std::size_t touching = 0;
  whole.visit_contacts([&](const auto&) { ++touching; });
  REQUIRE(touching > 100); // a pile, not a cloud
  const std::uint64_t expected = hash_of(whole);
  for (std::size_t k = 0; k < states.size(); ++k) {
    CAPTURE(splits[k]);
    const auto second = made<Model>(period, static_cast<unsigned>(1 + k % 2));
    Simulation<Model>& taken_up = *second;
    ArchiveReader reader{states[k], "memory"};
    reader(taken_up);
    reader.end();
    CHECK(hash_of(taken_up) == hashes[k]);
    while (taken_up.steps() < end) {
      step(taken_up);
    }
    CHECK(hash_of(taken_up) == expected);
  }
}

} // namespace

TEST_CASE_TEMPLATE("physics: a run taken up at any step ends in the same bits", Model, DefaultModel,
                   test::RollingHertzian, test::LinearInFloat, Worn) {
  check_split<Model>(Vector::Zero());
  check_split<Model>({1.3, 1.3, 0.0});
}

TEST_CASE("a kept simulation of another model, setup or build is refused with the reason") {
  const auto made_first = made<DefaultModel>(Vector::Zero(), 1);
  Simulation<>& sim = *made_first;
  fill(sim);
  sim.step();
  const std::string bytes = kept(sim);
  const auto refusal = [&](const auto& other) {
    ArchiveReader reader{bytes, "c"};
    try {
      reader(*other);
    } catch (const Error& error) {
      return std::string{error.what()};
    }
    return std::string{};
  };
  CHECK(refusal(made<DefaultModel>(Vector::Zero(), 1)).empty());
  const std::string model = refusal(made<test::LinearInFloat>(Vector::Zero(), 1));
  CHECK(model.find("c: model is Real = double") == 0);
  CHECK(model.find(" there and Real = float") != std::string::npos);
  CHECK(refusal(made<DefaultModel>({2.0, 2.0, 0.0}, 1)) == "c: period[0] is 0 there and 2 here");
  const auto more = made<DefaultModel>(Vector::Zero(), 1);
  more->add_wall({.name = "another", .surfaces = {}, .dynamics = Fixed{}});
  CHECK(refusal(more) == "c: number of walls is 4 there and 5 here");
}

TEST_CASE("a kept simulation that is cut off or has other numbers in it does no harm") {
  const auto made_first = made<DefaultModel>(Vector::Zero(), 1);
  Simulation<>& sim = *made_first;
  fill(sim);
  for (int k = 0; k < 40; ++k) {
    sim.step();
  }
  const std::string bytes = kept(sim);
  Random random{1};
  const auto taken_up = [](const std::string& from) {
    const auto other = made<DefaultModel>(Vector::Zero(), 1);
    ArchiveReader reader{from, "memory"};
    reader(*other);
    reader.end();
  };
  CHECK_NOTHROW(taken_up(bytes));
  for (int k = 0; k < 40; ++k) {
    CHECK_THROWS_AS(taken_up(bytes.substr(0, random.index(bytes.size()))), Error);
    std::string other = bytes;
    for (int n = 0; n < 8; ++n) {
      other[random.index(other.size())] = static_cast<char>(random.index(256));
    }
    try {
      taken_up(other); // most bytes are numbers, of which any will do
    } catch (const Error&) {
    }
  }
}
