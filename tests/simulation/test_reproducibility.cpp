/// \file
/// Same input, same bits: for any neighbour search, any number of threads, again and again.

#include "scree/contact/rolling_resistance.hpp"
#include "scree/core/random.hpp"
#include "scree/neighbours/all_pairs.hpp"
#include "scree/neighbours/r_tree.hpp"
#include "scree/simulation/run.hpp"
#include "scree/simulation/simulation.hpp"
#include "support/meshes.hpp"
#include "support/scenes.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

using namespace scree;

namespace {

template <class Search>
struct SearchedBy : DefaultModel {
  using Contact = LinearSpring<RollingResistance>;
  using Neighbours = Search;
};

/// Every number of a simulation that a later step depends on, as bits, and some that only observers see.
template <class Sim>
std::vector<std::uint64_t> state_of(const Sim& sim) {
  std::vector<std::uint64_t> bits;
  const auto note = [&](const auto& v) {
    for (Eigen::Index k = 0; k < v.size(); ++k) {
      bits.push_back(std::bit_cast<std::uint64_t>(v[k] + 0.0)); // -0 is 0
    }
  };
  std::vector<std::pair<std::uint64_t, std::size_t>> order;
  for (std::size_t b = 0; b < sim.bodies().size(); ++b) {
    order.emplace_back(sim.bodies().id(b), b);
  }
  std::sort(order.begin(), order.end());
  for (const auto& entry : order) {
    const std::size_t b = entry.second;
    bits.push_back(entry.first);
    note(sim.bodies().position(b));
    note(sim.bodies().velocity(b));
    note(sim.bodies().angular_velocity(b));
    note(sim.bodies().orientation(b).coeffs());
  }
  for (const auto& wall : sim.walls()) {
    note(wall.motion.position);
    note(wall.load.force);
    note(wall.load.impulse);
    note(wall.load.angular_impulse);
  }
  note(Vector{sim.dissipation().friction, sim.dissipation().viscous, sim.time()});
  return bits;
}

struct Scene {
  std::size_t balls = 150, stones = 50;
  Vector period = Vector::Zero();
  std::size_t steps = 1500;
  std::size_t sort_interval = 70;
  unsigned threads = 1;
};

struct Outcome {
  std::vector<std::vector<std::uint64_t>> states;
  std::size_t renewals = 0;
  std::size_t began = 0, ended = 0; ///< contacts of pairs, between looks
};

/// Spheres and clumps of two sizes thrown into a box: its floor a mesh with a step in it, its sides planes
/// (where space is not periodic), a turning tube across it.
template <class Search>
Outcome run(const Scene& scene) {
  constexpr double width = 0.16;
  Simulation<SearchedBy<Search>> sim{{.period = scene.period,
                                      .time_step = 2e-5,
                                      .step_safety = 1.0,
                                      .threads = scene.threads,
                                      .sort_interval = scene.sort_interval}};
  const auto rock = sim.add_material({.normal_stiffness = 2e4,
                                      .shear_stiffness = 1.5e4,
                                      .friction = 0.5,
                                      .restitution = 0.6,
                                      .rolling_friction = 0.1});
  const Clump ball = test::ball(0.006), stone = test::stone(0.006);
  Random random{161};
  const std::size_t count = scene.balls + scene.stones;
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t ix = k % 9, iy = k / 9 % 9, iz = k / 81;
    const double scale = random.uniform(0.7, 1.1);
    sim.add(
        {.clump = k * scene.stones / count != (k + 1) * scene.stones / count ? &stone : &ball,
         .material = rock,
         .position = Vector{0.01 + 0.0175 * static_cast<double>(ix), 0.01 + 0.0175 * static_cast<double>(iy),
                            0.045 + 0.0175 * static_cast<double>(iz)},
         .orientation = random.orientation(),
         .velocity = {random.normal(), random.normal(), -1.0},
         .angular_velocity = 20.0 * Vector{random.normal(), random.normal(), random.normal()},
         .scale = scale});
  }
  TriangleMesh slab = test::box_mesh({0.5, 0.5, 0.1}), step = test::box_mesh({0.06, 0.5, 0.04});
  sim.add_wall({.name = "floor",
                .surfaces = {{slab, rock}},
                .dynamics = Fixed{},
                .motion = {.position = {0.08, 0.08, -0.05}}});
  sim.add_wall({.name = "step",
                .surfaces = {{step, rock}},
                .dynamics = Fixed{},
                .motion = {.position = {0.05, 0.08, 0}}});
  const Cylinder tube{
      .axis = Vector::UnitY(), .radius = 0.01, .length = 0.16, .side = Cylinder::Side::outside};
  sim.add_wall({.name = "roller",
                .surfaces = {{tube, rock}},
                .dynamics = Prescribed{[](double t) {
                  return Pose{{0.11, 0, 0.03}, Quaternion{Eigen::AngleAxisd{6.0 * t, Vector::UnitY()}}};
                }}});
  if (scene.period.isZero()) {
    for (const Vector& out : {Vector{1, 0, 0}, Vector{-1, 0, 0}, Vector{0, 1, 0}, Vector{0, -1, 0}}) {
      const Vector corner = width * (Vector::Ones() - out).cwiseMax(0.0).cwiseMin(1.0);
      sim.add_wall({.name = "side", .surfaces = {{Plane{corner, out}, rock}}, .dynamics = Fixed{}});
    }
  }
  Outcome outcome;
  std::map<std::pair<std::uint64_t, std::uint64_t>, bool> touching;
  for (std::size_t k = 1; k <= scene.steps; ++k) {
    sim.step();
    if (k % 50 == 0) {
      outcome.states.push_back(state_of(sim));
      for (auto& pair : touching) {
        pair.second = false;
      }
      sim.visit_contacts([&](const ContactView& c) {
        if (!c.with_wall) {
          const auto a = sim.bodies().id(c.first), b = sim.bodies().id(c.second);
          const std::pair key{std::min(a, b), std::max(a, b)};
          outcome.began += touching.count(key) == 0;
          touching[key] = true;
        }
      });
      outcome.ended += std::erase_if(touching, [](const auto& pair) { return !pair.second; });
    }
  }
  outcome.renewals = sim.list_renewals();
  return outcome;
}

void check_same(const Outcome& a, const Outcome& b, const std::string& what) {
  CAPTURE(what);
  REQUIRE(a.states.size() == b.states.size());
  for (std::size_t k = 0; k < a.states.size(); ++k) {
    CAPTURE(k);
    REQUIRE(a.states[k] == b.states[k]);
  }
}

void check_searches(const Scene& scene) {
  const Outcome oracle = run<AllPairs>(scene);
  CHECK(oracle.renewals == scene.steps);
  CHECK(oracle.began > 200);
  CHECK(oracle.ended > 100);
  check_same(oracle, run<CellGrid>(scene), "CellGrid");
  check_same(oracle, run<RTree>(scene), "RTree");
  const Outcome listed = run<VerletList<CellGrid>>(scene);
  check_same(oracle, listed, "VerletList<CellGrid>");
  CHECK(listed.renewals > 10);
  CHECK(listed.renewals < scene.steps / 2);
  check_same(oracle, run<VerletList<AllPairs>>(scene), "VerletList<AllPairs>");
  check_same(oracle, run<VerletList<RTree>>(scene), "VerletList<RTree>");
}

} // namespace

TEST_CASE("physics: every search gives the same trajectory to the bit, in a box") {
  check_searches({});
}

TEST_CASE("physics: every search gives the same trajectory to the bit, in a periodic space") {
  check_searches({.period = {0.16, 0.16, 0}});
}

TEST_CASE("physics: any number of threads gives the same trajectory to the bit") {
  for (const Vector& period : {Vector{0, 0, 0}, Vector{0.16, 0, 0}}) {
    // More spheres than one block holds.
    Scene scene{.balls = 500, .stones = 400, .period = period, .steps = 250};
    const Outcome one = run<VerletList<CellGrid>>(scene);
    CHECK(one.began > 100);
    for (const unsigned threads : {2U, 4U}) {
      scene.threads = threads;
      check_same(one, run<VerletList<CellGrid>>(scene), message(threads, " threads"));
    }
  }
}

TEST_CASE("a run repeated gives the same bits, another start others") {
  const Scene scene{.balls = 60, .stones = 20, .steps = 400};
  const Outcome first = run<VerletList<CellGrid>>(scene);
  check_same(first, run<VerletList<CellGrid>>(scene), "again");
  Scene other = scene;
  other.stones = 19;
  CHECK(first.states.back() != run<VerletList<CellGrid>>(other).states.back());
}
