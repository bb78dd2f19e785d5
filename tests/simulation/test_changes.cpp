/// \file
/// Bodies added, removed, fixed and put into another order while a simulation runs.

#include "scree/core/random.hpp"
#include "scree/simulation/run.hpp"
#include "scree/simulation/simulation.hpp"
#include "support/scenes.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

using namespace scree;

namespace changes_tests {

namespace {

constexpr double size = 0.008;
const Clump ball = test::ball(size), stone = test::stone(size);

/// With no skin that could hide a pair that is looked for too near a boundary.
struct Unlisted : DefaultModel {
  using Neighbours = CellGrid;
};

/// Two heaps far apart on one floor: bodies 0 .. 39 near the origin, 40 .. 79 at x = 1.
struct TwoHeaps : Simulation<> {
  explicit TwoHeaps(std::size_t sort_interval)
      : Simulation<>{{.time_step = 2e-5, .sort_interval = sort_interval}} {
    const auto rock =
        add_material({.normal_stiffness = 2e4, .shear_stiffness = 2e4, .friction = 0.5, .restitution = 0.5});
    Random random{201};
    for (int k = 0; k < 80; ++k) {
      add({.clump = k % 3 == 0 ? &stone : &ball,
           .material = rock,
           .position = Vector{k < 40 ? 0.0 : 1.0, 0, 0} + 0.018 * Vector(k % 3, k / 3 % 3, 1 + k % 40 / 9),
           .orientation = random.orientation(),
           .velocity = 0.2 * Vector{random.normal(), random.normal(), -1.0}});
    }
    add_wall({.name = "floor", .surfaces = {{Plane{}, rock}}, .dynamics = Fixed{}});
  }
};

using Positions = std::map<std::uint64_t, Vector>;

Positions positions(const Simulation<>& sim, std::uint64_t end = 1000) {
  Positions all;
  for (std::size_t b = 0; b < sim.bodies().size(); ++b) {
    if (sim.bodies().id(b) < end) {
      all[sim.bodies().id(b)] = sim.bodies().position(b);
    }
  }
  return all;
}

/// A heap at rest that leans on its springs: balls and stones in a tilted tray, damped until nothing moves.
struct Leaning : Simulation<> {
  explicit Leaning(std::size_t sort_interval = 0)
      : Simulation<>{{.gravity = {2.5, 1.0, -9.81},
                      .time_step = 2e-5,
                      .local_damping = 0.4,
                      .sort_interval = sort_interval}} {
    const auto rock =
        add_material({.normal_stiffness = 2e4, .shear_stiffness = 2e4, .friction = 0.7, .restitution = 0.5});
    Random random{202};
    for (int k = 0; k < 45; ++k) {
      add({.clump = k % 3 == 0 ? &ball : &stone,
           .material = rock,
           .position = 0.018 * Vector(0.6 + k % 3, 0.6 + k / 3 % 3, 0.6 + k / 9),
           .orientation = random.orientation()});
    }
    for (const Vector& out :
         {Vector{1, 0, 0}, Vector{-1, 0, 0}, Vector{0, 1, 0}, Vector{0, -1, 0}, Vector{0, 0, 1}}) {
      const Vector corner = 0.058 * (-out).cwiseMax(0.0);
      add_wall({.name = "side", .surfaces = {{Plane{corner, out}, rock}}, .dynamics = Fixed{}});
    }
  }
};

/// By the ids of the bodies, or body and wall, and the place where there are several.
using Forces = std::map<std::tuple<std::uint64_t, std::uint64_t, bool>, Vector>;

/// The sum of the forces on the body with the smaller id, or on the body at a wall.
Forces forces(const Simulation<>& sim) {
  Forces all;
  sim.visit_contacts([&](const ContactView& c) {
    const std::uint64_t a = sim.bodies().id(c.first), b = c.with_wall ? c.second : sim.bodies().id(c.second);
    const bool turned = !c.with_wall && b < a;
    auto& sum = all.try_emplace({turned ? b : a, turned ? a : b, c.with_wall}, Vector::Zero()).first->second;
    sum += turned ? Vector(-c.force) : c.force;
  });
  return all;
}

double tangential_share(const Simulation<>& sim) {
  double normal = 0.0, tangential = 0.0;
  sim.visit_contacts([&](const ContactView& c) {
    normal += std::abs(c.force.dot(c.normal));
    tangential += (c.force - c.force.dot(c.normal) * c.normal).norm();
  });
  return tangential / normal;
}

/// That contacts of bodies other than `but` have kept their forces: the sum of the changes over the sum of
/// the forces.
std::size_t check_kept(const Forces& before, const Forces& after, std::uint64_t but, double tolerance) {
  double all = 0.0, change = 0.0;
  std::size_t kept = 0;
  for (const auto& [key, force] : before) {
    if (std::get<0>(key) == but || (!std::get<2>(key) && std::get<1>(key) == but)) {
      continue;
    }
    const auto found = after.find(key);
    REQUIRE(found != after.end());
    all += force.norm();
    change += (found->second - force).norm();
    ++kept;
  }
  CHECK(change < tolerance * all);
  return kept;
}

constexpr std::uint64_t nobody = 1000;

} // namespace

TEST_CASE("removing or fixing the bodies of one heap leaves the other's trajectory as it is, to the bit") {
  TwoHeaps untouched{0}, thinned{0}, frozen{0};
  for (Simulation<>* sim : {static_cast<Simulation<>*>(&untouched), static_cast<Simulation<>*>(&thinned),
                            static_cast<Simulation<>*>(&frozen)}) {
    run_for(*sim, 0.03);
  }
  const auto some = [](const auto& bodies, std::size_t b) {
    return bodies.id(b) >= 40 && bodies.id(b) % 2 == 0;
  };
  CHECK(thinned.remove_bodies(some) == 20);
  CHECK(frozen.fix_bodies(some) == 20);
  CHECK(frozen.fix_bodies(some) == 0);
  CHECK(thinned.bodies().size() == 60);
  const Positions held = positions(frozen);
  for (int k = 0; k < 10; ++k) {
    run_for(untouched, 0.01);
    run_for(thinned, 0.01);
    run_for(frozen, 0.01);
    const Positions expected = positions(untouched, 40);
    REQUIRE(positions(thinned, 40) == expected);
    REQUIRE(positions(frozen, 40) == expected);
  }
  std::size_t moved = 0, still = 0;
  for (const auto& [id, at] : positions(frozen)) {
    (at == held.at(id) ? still : moved) += id >= 40;
  }
  CHECK(still == 20);
  CHECK(moved == 20);
}

TEST_CASE("contacts keep their springs when other bodies are removed, fixed or added") {
  Leaning heap;
  run_for(heap, 1.5);
  REQUIRE(tangential_share(heap) > 0.05); // what a lost spring would show in
  // One in the middle of things.
  std::map<std::uint64_t, int> partners;
  const Forces resting = forces(heap);
  for (const auto& [key, force] : resting) {
    ++partners[std::get<0>(key)];
  }
  const std::uint64_t busy = std::max_element(partners.begin(), partners.end(), [](auto& a, auto& b) {
                               return a.second < b.second;
                             })->first;
  const auto is_busy = [&](const auto& bodies, std::size_t b) { return bodies.id(b) == busy; };

  heap.step();
  CHECK(check_kept(resting, forces(heap), nobody, 1e-5) == resting.size());

  CHECK(heap.fix_bodies(is_busy) == 1);
  const Forces before_fix = forces(heap);
  heap.step();
  // A fixed body feels no walls; its contacts with others go on.
  Forces after = forces(heap);
  for (const auto& [key, force] : before_fix) {
    if (!std::get<2>(key)) {
      CHECK((after.at(key) - force).norm() < 1e-4 * force.norm() + 1e-6);
    }
  }

  heap.add({.clump = &ball, .position = {0.03, 0.03, 1.0}});
  heap.step();
  check_kept(after, forces(heap), nobody, 1e-5);

  after = forces(heap);
  CHECK(heap.remove_bodies(is_busy) == 1);
  heap.step();
  const std::size_t kept = check_kept(after, forces(heap), busy, 0.01); // its neighbours begin to fall
  CHECK(kept > 20);
  CHECK(kept < after.size());
}

TEST_CASE("the order of the bodies in memory does not change what happens") {
  // Rounding apart, and for as long as it has not grown.
  Leaning in_order, sorted{7};
  Positions start = positions(in_order);
  for (int k = 0; k < 4; ++k) {
    run_for(in_order, 0.005);
    run_for(sorted, 0.005);
    const Positions a = positions(in_order), b = positions(sorted);
    REQUIRE(a.size() == b.size());
    for (const auto& [id, at] : a) {
      REQUIRE((at - b.at(id)).norm() < 1e-10);
    }
  }
  bool moved = false;
  for (std::size_t b = 0; b < sorted.bodies().size(); ++b) {
    moved = moved || sorted.bodies().id(b) != b;
  }
  CHECK(moved);
}

TEST_CASE("sorting keeps the springs of a heap at rest") {
  Leaning heap{3};
  run_for(heap, 1.5);
  REQUIRE(tangential_share(heap) > 0.05);
  const Forces resting = forces(heap);
  for (int k = 0; k < 20; ++k) {
    heap.step();
    check_kept(resting, forces(heap), nobody, 1e-3); // it still creeps a little
  }
}

TEST_CASE("in a periodic space every pair of spheres that overlaps through any image is found") {
  const double period = 0.12;
  for (const Clump* clump : {&ball, &stone}) {
    const int count = clump == &ball ? 150 : 200;
    CAPTURE(clump->name);
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
      CAPTURE(seed);
      Simulation<Unlisted> sim{
          {.gravity = Vector::Zero(), .period = Vector::Constant(period), .time_step = 1e-7}};
      const auto rock = sim.add_material({.normal_stiffness = 1e3, .shear_stiffness = 1e3});
      Random random{seed};
      for (int k = 0; k < count; ++k) {
        sim.add({.clump = clump,
                 .material = rock,
                 .position = period * Vector{random.uniform(-1, 2), random.uniform(), random.uniform()},
                 .orientation = random.orientation(),
                 .scale = random.uniform(0.8, 1.0)});
      }
      sim.step();
      std::size_t found = 0, expected = 0;
      sim.visit_contacts([&](const ContactView&) { ++found; });
      const auto spheres = sim.bodies().spheres();
      for (std::size_t i = 0; i < spheres.size(); ++i) {
        for (std::size_t j = i + 1; j < spheres.size(); ++j) {
          if (sim.bodies().body_of(i) == sim.bodies().body_of(j)) {
            continue;
          }
          for (int image = 0; image < 27; ++image) {
            const Vector shift = period * Vector(image % 3 - 1, image / 3 % 3 - 1, image / 9 - 1);
            expected += (to_eigen(spheres[i].position - spheres[j].position) - shift).norm() <
                        spheres[i].radius + spheres[j].radius;
          }
        }
      }
      CHECK(expected > 10);
      CHECK(found == expected);
    }
  }
}

TEST_CASE("a body that passes a periodic boundary keeps its springs, with others and with walls") {
  for (const bool on_wall : {false, true}) {
    CAPTURE(on_wall);
    // A ball pulled along x rolls on a floor, or over a held ball: its spring is loaded all the time. It is
    // brought back into the domain when it is a tenth of the period outside.
    const double period = 0.1;
    Simulation<> sim{{.gravity = {1.0, 0, -9.81}, .period = {period, 0, 0}, .time_step = 1e-5}};
    const auto rock = sim.add_material(
        {.normal_stiffness = 2e4, .shear_stiffness = 2e4, .friction = 0.5, .restitution = 0.5});
    const double sinking = 2650.0 * ball.volume * 9.81 / 1e4;
    if (on_wall) {
      sim.add_wall({.name = "floor", .surfaces = {{Plane{}, rock}}, .dynamics = Fixed{}});
    } else {
      sim.add({.clump = &ball, .material = rock, .position = {0.1 * period, 0, -size}, .fixed = true});
    }
    const auto id = sim.add({.clump = &ball,
                             .material = rock,
                             .position = {1.1 * period - 1e-3, 0, size - sinking},
                             .velocity = {0.05, 0, 0},
                             .angular_velocity = {0, 0.05 / size, 0}});
    double before = 0.0, largest = 0.0;
    bool crossed = false;
    while (sim.time() < 0.03) {
      sim.step();
      double now = 0.0;
      sim.visit_contacts(
          [&](const ContactView& c) { now += (c.force - c.force.dot(c.normal) * c.normal).norm(); });
      if (sim.time() > 0.01) {
        largest = std::max(largest, std::abs(now - before));
      }
      before = now;
      crossed = crossed || sim.bodies().position(test::number_of(sim, id)).x() < 0.5 * period;
    }
    CHECK(crossed);
    CHECK(before > 1e-4);
    CHECK(largest < 0.05 * before);
  }
}

} // namespace changes_tests
