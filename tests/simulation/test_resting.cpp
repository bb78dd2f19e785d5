/// \file
/// Bodies at rest are left alone, and nothing that would move is.

#include "scree/core/archive.hpp"
#include "scree/core/random.hpp"
#include "scree/measure/state_hash.hpp"
#include "scree/neighbours/all_pairs.hpp"
#include "scree/neighbours/r_tree.hpp"
#include "scree/simulation/run.hpp"
#include "scree/simulation/simulation.hpp"
#include "support/relative_error.hpp"
#include "support/scenes.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

using namespace scree;

namespace resting_tests {

namespace {

template <class Search>
struct RestingBy : DefaultModel {
  using Neighbours = Search;
  using Rest = RestingRegions;
};
using Resting = RestingBy<VerletList<CellGrid>>;

constexpr RestingRegions rule{.speed = 2e-3, .force = 0.05, .window = 100, .interval = 10};
constexpr double width = 0.3;     // m, of the box
constexpr std::size_t piston = 0; // its left side

/// Grains about to fall into a box with a floor and four sides.
template <class Model>
std::unique_ptr<Simulation<Model>> poured(unsigned threads = 1, std::size_t grains = 250,
                                          double step_safety = 0.8) {
  auto out = std::make_unique<Simulation<Model>>(Setup<Model>{
      .step_safety = step_safety, .local_damping = 0.1, .threads = threads, .sort_interval = 170});
  Simulation<Model>& sim = *out;
  const auto rock = sim.add_material(
      {.normal_stiffness = 2e4, .shear_stiffness = 1.5e4, .friction = 0.5, .restitution = 0.3});
  for (const Vector& out_of :
       {Vector{-1, 0, 0}, Vector{1, 0, 0}, Vector{0, 1, 0}, Vector{0, -1, 0}, Vector{0, 0, -1}}) {
    const Vector corner = width * out_of.cwiseMax(0.0);
    sim.add_wall({.name = "side",
                  .surfaces = {{Plane{Vector::Zero(), -out_of}, rock}},
                  .dynamics = Fixed{},
                  .motion = {.position = corner}});
  }
  const Clump ball = test::ball(0.016), stone = test::stone(0.018);
  Random random{11};
  for (std::size_t k = 0; k < grains; ++k) {
    sim.add({.clump = k % 5 < 2 ? &stone : &ball,
             .position = Vector{0.03 + 0.048 * static_cast<double>(k % 6),
                                0.03 + 0.048 * static_cast<double>(k / 6 % 6),
                                0.03 + 0.048 * static_cast<double>(k / 36)},
             .orientation = random.orientation(),
             .velocity = 0.1 * Vector{random.normal(), random.normal(), random.normal()},
             .scale = random.uniform(0.8, 1.0)});
  }
  return out;
}

/// Moves the piston into the box from now on. \param speed m/s
template <class Sim>
void push(Sim& sim, double speed) {
  sim.set_dynamics(piston, Prescribed{[speed, begin = sim.time()](double time) {
                     return Pose{{speed * (time - begin), 0.0, 0.0}, Quaternion::Identity()};
                   }});
}

template <class Sim>
double weight(const Sim& sim) {
  double sum = 0.0;
  for (std::size_t b = 0; b < sim.bodies().size(); ++b) {
    sum += 9.81 * sim.bodies().mass(b);
  }
  return sum;
}

/// N, resultants of the contacts of all bodies: as observers see them, and as the step summed them.
template <class Sim>
std::pair<std::vector<Vector>, std::vector<Vector>> resultants(const Sim& sim) {
  const auto& bodies = sim.bodies();
  std::vector<Vector> seen(bodies.size(), Vector::Zero()), summed = seen;
  sim.visit_contacts([&](const ContactView& c) {
    seen[c.first] += c.force;
    if (!c.with_wall) {
      seen[c.second] -= c.force;
    }
  });
  for (std::size_t s = 0; s < bodies.sphere_count(); ++s) {
    summed[bodies.body_of(s)] += to_eigen(bodies.forces()[s].force);
  }
  return {seen, summed};
}

} // namespace

TEST_CASE("physics: a bed that has come to rest is left alone, and the floor carries it") {
  const auto made = poured<Resting>();
  Simulation<Resting>& sim = *made;
  sim.set_rest(rule);
  run_for(sim, 1.2);
  CHECK(sim.resting_count() >= sim.bodies().size() * 19 / 20); // a ball may roll on
  const double floor = -sim.wall(4).load.force.z(), carried = weight(sim);
  CHECK(floor > 0.5 * carried); // friction of the sides bears some
  Vector all = Vector::Zero();
  for (const auto& wall : sim.walls()) {
    all -= wall.load.force;
  }
  CHECK(all.z() == test::about(carried, rule.force));
  const auto [seen, summed] = resultants(sim);
  std::vector<std::pair<std::uint64_t, Vector>> resting;
  for (std::size_t b = 0; b < seen.size(); ++b) {
    if (at_rest(sim.bodies().activity(b))) {
      CAPTURE(b);
      CHECK((seen[b] - summed[b]).norm() < 1e-5 * carried); // an awake neighbour has moved since
      CHECK(sim.bodies().kinetic_energy(b) == 0.0);
      resting.emplace_back(sim.bodies().id(b), sim.bodies().position(b));
    }
  }
  run_for(sim, 0.1);
  std::size_t stayed = 0;
  for (const auto& [id, place] : resting) {
    stayed += sim.bodies().position(test::number_of(sim, id)) == place ? 1U : 0U;
  }
  CHECK(stayed >= resting.size() * 19 / 20);
}

TEST_CASE("physics: bodies that rest on fixed ones feel them, while they rest and after") {
  const auto made = poured<Resting>();
  Simulation<Resting>& sim = *made;
  run_for(sim, 0.8);
  sim.fix_bodies([](const auto& bodies, std::size_t b) { return bodies.position(b).z() < 0.05; });
  sim.set_rest(rule);
  run_for(sim, 0.2);
  CHECK(sim.resting_count() > 20);
  const auto check_forces = [&](bool resting, double share) {
    const auto [seen, summed] = resultants(sim);
    std::size_t looked_at = 0;
    for (std::size_t b = 0; b < seen.size(); ++b) {
      if (!sim.bodies().is_fixed(b) && at_rest(sim.bodies().activity(b)) == resting) {
        CAPTURE(b);
        CHECK((seen[b] - summed[b]).norm() <
              share * sim.bodies().mass(b) * 9.81); // of now, and of the last step
        ++looked_at;
      }
    }
    CHECK(looked_at > 20);
  };
  check_forces(true, 0.05);
  sim.set_gravity({0.5, 0.0, -9.81}); // wakes all
  for (int k = 0; k < 20; ++k) {
    sim.step();
  }
  check_forces(false, 0.3);
}

TEST_CASE("physics: where nothing may rest the bits are those of a model without rest") {
  const auto plain = poured<DefaultModel>();
  const auto never = poured<Resting>();
  run_for(*plain, 0.2);
  run_for(*never, 0.2);
  CHECK(state_hash(plain->bodies()) == state_hash(never->bodies()));
  CHECK(never->resting_count() == 0);
}

TEST_CASE("physics: a stone that falls on a resting bed goes as deep as in one that is stepped") {
  const auto fallen = [](bool rests) {
    const auto made = poured<Resting>();
    Simulation<Resting>& sim = *made;
    run_for(sim, 0.8);
    if (rests) {
      sim.set_rest(rule);
      run_for(sim, 4.0 * static_cast<double>(rule.window) * sim.time_step());
      CHECK(sim.resting_count() > sim.bodies().size() * 9 / 10);
    }
    double top = 0.0;
    for (const auto& sphere : sim.bodies().spheres()) {
      top = std::max(top, sphere.position.z + sphere.radius);
    }
    const Clump rock = test::ball(0.05);
    const std::uint64_t id =
        sim.add({.clump = &rock, .position = {0.15, 0.15, top + 0.051}, .velocity = {0, 0, -2}});
    std::vector<double> heights;
    std::size_t fewest = sim.bodies().size();
    for (int k = 0; k < 60; ++k) {
      run_for(sim, 0.005);
      heights.push_back(sim.bodies().position(test::number_of(sim, id)).z() - top - 0.05);
      fewest = std::min(fewest, sim.resting_count());
    }
    CHECK(fewest < sim.bodies().size() / 2);
    return heights;
  };
  const std::vector<double> stepped = fallen(false), rested = fallen(true);
  const double depth = -*std::min_element(stepped.begin(), stepped.end());
  CHECK(depth > 0.01);
  for (std::size_t k = 0; k < stepped.size(); ++k) {
    CAPTURE(k);
    CHECK(std::abs(stepped[k] - rested[k]) < 0.1 * depth);
  }
}

TEST_CASE("physics: a resting body is off balance by no more than is said") {
  const auto made = poured<Resting>();
  Simulation<Resting>& sim = *made;
  run_for(sim, 0.6);
  sim.set_rest(rule);
  push(sim, 0.02);
  std::size_t rested = 0, off = 0;
  for (int k = 0; k < 400; ++k) {
    for (std::size_t n = 0; n < rule.interval; ++n) {
      sim.step();
    }
    const auto resultant = resultants(sim).second;
    for (std::size_t b = 0; b < sim.bodies().size(); ++b) {
      if (at_rest(sim.bodies().activity(b))) {
        double pressed = 0.0;
        for (std::size_t s = sim.bodies().first_sphere(b); s < sim.bodies().first_sphere(b + 1); ++s) {
          pressed += sim.bodies().forces()[s].pressed;
        }
        ++rested;
        off +=
            (resultant[b] + sim.bodies().mass(b) * sim.setup().gravity).norm() > 1.2 * rule.force * pressed;
      }
    }
  }
  CHECK(rested > 400 * 25); // a tenth, in the mean
  CHECK(static_cast<double>(off) < 1e-3 * static_cast<double>(rested));
}

TEST_CASE("physics: a bed with resting regions pushes back as one without") {
  // N, mean force on a side that is pushed slowly into the bed; N s / s
  const auto pushed = [](bool rests) {
    const auto made = poured<Resting>();
    Simulation<Resting>& sim = *made;
    run_for(sim, 0.8);
    push(sim, 0.05);
    if (rests) {
      sim.set_rest(rule);
    }
    run_for(sim, 0.2);
    const double before = sim.wall(piston).load.impulse.x();
    run_for(sim, 0.6);
    return (before - sim.wall(piston).load.impulse.x()) / 0.6;
  };
  const double stepped = pushed(false), rested = pushed(true);
  CHECK(stepped > 0.5 * weight(*poured<Resting>()));
  CHECK(rested == test::about(stepped, 0.05));
}

TEST_CASE("physics: energy is accounted for where bodies are put to rest") {
  // As coarse a rule as may be, so that much is taken; small steps, for the balance is of first order in
  // them.
  const auto made = poured<Resting>(1, 250, 0.1);
  Simulation<Resting>& sim = *made;
  run_for(sim, 0.25);
  sim.set_rest({.speed = 1.0, .force = 0.999, .window = 20, .interval = 10});
  const double start = test::mechanical_energy(sim), lost_before = sim.dissipation().total();
  run_for(sim, 0.2);
  const double lost = sim.dissipation().total() - lost_before;

  CHECK(sim.dissipation().resting > 0.02 * lost);
  CHECK(start - test::mechanical_energy(sim) == test::about(lost, 0.01));
}

TEST_CASE_TEMPLATE("physics: what rests depends on no search", Search, AllPairs, CellGrid, RTree,
                   VerletList<RTree>) {
  const auto hash_after = [](auto made) {
    made->set_rest({.speed = 0.02, .force = 0.2, .window = 50, .interval = 10});
    run_for(*made, 0.3);
    CHECK(made->resting_count() > 0);
    CHECK(made->resting_count() < made->bodies().size());
    return state_hash(made->bodies());
  };
  CHECK(hash_after(poured<RestingBy<Search>>(1, 120)) == hash_after(poured<Resting>(1, 120)));
}

TEST_CASE("physics: what rests depends on no number of threads") {
  const auto hash_with = [](unsigned threads) {
    const auto made = poured<Resting>(threads, 1300); // more than one block holds
    made->set_rest({.speed = 0.05, .force = 0.5, .window = 50, .interval = 10});
    run_for(*made, 0.4);
    CHECK(made->resting_count() > 100);
    return state_hash(made->bodies());
  };
  const std::uint64_t one = hash_with(1);
  CHECK(hash_with(2) == one);
  CHECK(hash_with(4) == one);
}

TEST_CASE("physics: a run with resting bodies that is taken up at any step ends in the same bits") {
  const std::vector<std::size_t> splits{1, 9, 10, 11, 55, 99, 100, 101, 170, 222};
  const auto made = poured<Resting>();
  Simulation<Resting>& whole = *made;
  run_for(whole, 0.8);
  whole.set_rest(rule);
  push(whole, 0.05);
  const double begin = whole.time();
  std::vector<std::string> states;
  for (std::size_t step = 0, next = 0; step < 700; ++step) {
    if (next < splits.size() && step == 300 + splits[next]) {
      CHECK(whole.resting_count() > 20);
      CHECK(whole.resting_count() < whole.bodies().size());
      ArchiveWriter writer;
      writer(whole);
      states.push_back(writer.bytes());
      ++next;
    }
    whole.step();
  }
  for (std::size_t k = 0; k < states.size(); ++k) {
    CAPTURE(splits[k]);
    const auto other = poured<Resting>(static_cast<unsigned>(1 + k % 2));
    other->set_dynamics(piston, Prescribed{[begin](double time) {
                          return Pose{{0.05 * (time - begin), 0.0, 0.0}, Quaternion::Identity()};
                        }});
    ArchiveReader reader{states[k], "memory"};
    reader(*other);
    while (other->steps() < whole.steps()) {
      other->step();
    }
    CHECK(state_hash(other->bodies()) == state_hash(whole.bodies()));
    CHECK(other->wall(piston).load.impulse == whole.wall(piston).load.impulse);
    CHECK(other->wall(4).load.impulse == whole.wall(4).load.impulse);
  }
}

TEST_CASE("physics: whatever changes a simulation from outside wakes all") {
  const auto made = poured<Resting>();
  Simulation<Resting>& sim = *made;
  const auto rest = [&] {
    sim.set_rest(rule);
    for (int k = 0; k < 40 && sim.resting_count() < 200; ++k) {
      run_for(sim, 0.05);
    }
    REQUIRE(sim.resting_count() >= 200);
  };
  rest();
  sim.set_gravity({5.0, 0.0, -9.81});
  CHECK(sim.resting_count() == 0);
  const auto mean_place = [&] {
    double sum = 0.0;
    for (std::size_t b = 0; b < sim.bodies().size(); ++b) {
      sum += sim.bodies().position(b).x() / static_cast<double>(sim.bodies().size());
    }
    return sum;
  };
  const double before = mean_place();
  run_for(sim, 0.3);
  CHECK(mean_place() > before + 0.005);
  sim.set_gravity({0.0, 0.0, -9.81});
  rest();
  sim.set_motion(0, {1.0, 0.0, 0.0}, Vector::Zero());
  CHECK(sim.resting_count() == 0);
  rest();
  sim.remove_bodies([](const auto& bodies, std::size_t b) { return bodies.id(b) == 3; });
  CHECK(sim.resting_count() == 0);
  rest();
  push(sim, 0.1);
  CHECK(sim.resting_count() == 0);
}

TEST_CASE("what counts as rest is checked") {
  const auto refused = [](const RestingRegions& rest) {
    try {
      Simulation<Resting> sim{{.rest = rest}};
    } catch (const Error& error) {
      return std::string{error.what()};
    }
    return std::string{};
  };
  CHECK(refused(rule).empty());
  CHECK(refused({.speed = -1.0}).find("rest.speed = -1 m/s") == 0);
  CHECK(refused({.force = 1.5}).find("rest.force = 1.5") == 0);
  CHECK(refused({.interval = 0}).find("rest.interval = 0") == 0);
  CHECK(refused({.window = 15, .interval = 10}) ==
        "rest.window = 15 steps must be a multiple of rest.interval = 10");
}

} // namespace resting_tests
