#pragma once
/// \file
/// Single rocks dropped on a plate: how fast they come back.

#include "scree/core/random.hpp"
#include "scree/laboratory/rock_sample.hpp"
#include "scree/laboratory/rocks_on_plate.hpp"
#include "scree/laboratory/stage.hpp"
#include "scree/simulation/run.hpp"
#include "scree/simulation/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace scree {

/// All numbers are ours.
struct DropTestSetup {
  RockSample sample = paper_rock();
  std::vector<double> speeds{0.5, 1.0, 2.0, 3.0, 4.0}; ///< m/s, at the plate, one or more, each above 0
  std::size_t drops = 200;                             ///< at each speed, 2 or more
  double patience = 0.25; ///< s of simulated time for a rock to leave the plate, above 0
  std::uint64_t seed = 1;
  unsigned threads = 0; ///< 0: one for each processor

  /// \throws Error for a value out of its range.
  void check() const {
    require("drop test: number of speeds", static_cast<double>(speeds.size()), {1.0, 1000.0});
    for (const double speed : speeds) {
      require_positive("drop test speeds", speed, "m/s");
    }
    require("drop test drops", static_cast<double>(drops), {2.0, 1e6});
    require_positive("drop test patience", patience, "s");
  }
};

/// The desk version: fewer and softer rocks. All ours.
inline DropTestSetup desk_drop_test() {
  return {.sample = desk_rock(), .drops = 50};
}

/// One rock.
struct Drop {
  DrawnClump rock{};        ///< which shape of the assembly, how large
  double restitution = 0.0; ///< vertical speed of the centre after over before
  double energy_restitution =
      0.0;              ///< root of the kinetic energy after over before, spin and sliding included
  std::size_t hits = 0; ///< times that it touched the plate until then, 1 or more
  bool left = false;    ///< whether it has left the plate within the patience
};

/// Mean of single values.
struct DropMean {
  double mean = 0.0;
  double error = 0.0;  ///< standard error of the mean
  double spread = 0.0; ///< standard deviation of the values
};

/// All drops at one speed.
struct DropSeries {
  double speed = 0.0;  ///< m/s, at the plate
  double height = 0.0; ///< m, of a free fall to that speed
  DropMean restitution{};
  DropMean energy_restitution{};
  std::size_t hit_again = 0; ///< rocks that touched the plate more than once
  std::size_t stayed = 0;    ///< rocks that did not leave it; they count with restitution 0
  std::vector<Drop> drops{}; ///< in the order in which the rocks were drawn
};

struct DropTestResult {
  std::vector<DropSeries> series{}; ///< in the order of the speeds
};

/// Drops rocks in random orientation and without spin on a plate, each alone, and compares their speed before
/// and after, as a laboratory does from the height of the rebound: e = sqrt(rebound height / drop height).
///
/// A rock that lands on an edge gets spin, and its other end may hit a moment later. The centre's height is
/// all that a camera sees, so hits count until the centre is at the top of its first flight or so high that
/// no part of the rock could touch the plate. Speeds are those with which the rock left the plate for this
/// flight: it has left where the plate no longer pushes and the centre rises.
/// A rock that hardly rises at first and is thrown up later by its other end counts with the first flight.
/// That matters in slow drops only: with the desk version's rock at 0.5 m/s the mean is 0.39, and 0.42 with
/// the highest flight of each rock.
///
/// All speeds have the same rocks in the same orientations, so that from one to the next the speed alone
/// changes. Of one speed all rocks fall at once, on one plate, so far apart that they cannot meet.
///
///     scree::DropTest<> test{scree::desk_drop_test()};
///     const double restitution = test.run().series.front().restitution.mean;
template <class Model = DefaultModel>
class DropTest {
public:
  using Sim = Simulation<Model>;
  using Setting = DropTestSetup;
  using Result = DropTestResult;

  /// \throws Error for a parameter out of its range, or gravity that is not straight down.
  explicit DropTest(DropTestSetup setup, Setup<Model> physics = {})
      : setup_{std::move(setup)},
        simulation_{with_sample(std::move(physics), setup_.sample, setup_.threads)} {
    setup_.check();
    rock_ = simulation_.add_material(setup_.sample.rock);
    const MaterialId rig = simulation_.add_material(setup_.sample.rig);
    simulation_.add_wall({.name = "plate", .surfaces = {{Plane{}, rig}}, .dynamics = Fixed{}});
    draw_rocks();
  }

  /// Once. `watch(simulation, Stage)` is called after every step. The rocks of the last speed stay in the
  /// simulation.
  template <class Watch>
  const DropTestResult& run(Watch watch) {
    once_.begin("drop test");
    for (std::size_t k = 0; k < setup_.speeds.size(); ++k) {
      drop_all(k, watch);
    }
    return result_;
  }
  const DropTestResult& run() {
    return run([](const auto&, const Stage&) {});
  }

  [[nodiscard]] const DropTestSetup& setup() const { return setup_; }
  [[nodiscard]] const DropTestResult& result() const { return result_; }
  [[nodiscard]] const Sim& simulation() const { return simulation_; }

private:
  /// What is known of a rock while it is watched.
  struct Flight {
    bool touched = false; ///< in the last step
    bool rising = false;  ///< has left the plate
    bool done = false;
    Drop drop{};
  };

  [[nodiscard]] double gravity() const { return -simulation_.setup().gravity.z(); }

  void draw_rocks() {
    Random random{setup_.seed, "drops"};
    const Assembly& assembly = setup_.sample.assembly;
    drawn_ = assembly.draw(setup_.drops, random);
    rocks_ = turned_rocks(assembly, drawn_, rock_, random);
    for (const DrawnClump& grain : drawn_) {
      largest_ = std::max(largest_, 0.5 * assembly.bounding_diameter(grain));
    }
  }

  /// Rocks just above the plate, from where they come to it with `speed` [m/s].
  [[nodiscard]] Packing placed(double speed) const {
    const double height = 0.5 * speed * speed / gravity();
    const double gap = 0.01 * height; // ours: the first step must not put a rock into the plate
    // No rock gets more than the energy that it has, also from sinking by its own radius.
    const double fastest = std::sqrt(speed * speed + 2.0 * gravity() * largest_);
    const double pitch = 2.1 * (largest_ + fastest * (setup_.patience + 2.0 * gap / speed));
    Packing rocks = rocks_;
    place_in_rows(rocks, pitch, gap);
    for (PackedBody& body : rocks.bodies) {
      body.velocity = {0.0, 0.0, -std::sqrt(speed * speed - 2.0 * gravity() * gap)};
    }
    return rocks;
  }

  template <class Watch>
  void drop_all(std::size_t number, Watch& watch) {
    const double speed = setup_.speeds[number];
    simulation_.remove_bodies([](const auto&, std::size_t) { return true; });
    const std::size_t first = added_;
    simulation_.add(placed(speed));
    added_ += setup_.drops;
    std::vector<Flight> flights(setup_.drops);
    for (std::size_t k = 0; k < setup_.drops; ++k) {
      flights[k].drop.rock = drawn_[k];
    }

    const double end = simulation_.time() + setup_.patience, count = static_cast<double>(setup_.drops);
    std::size_t open = setup_.drops;
    Stage stage{message("dropping at ", speed, " m/s"), 0.0};
    run_while(
        simulation_, [&](const auto& s) { return open > 0 && s.time() < end; },
        [&](const auto& s) {
          for (std::size_t b = 0; b < s.bodies().size(); ++b) {
            Flight& flight = flights[s.bodies().id(b) - first];
            if (!flight.done) {
              follow(flight, b, speed);
              open -= flight.done ? 1 : 0;
            }
          }
          const double share = 1.0 - static_cast<double>(open) / count;
          stage.share = (static_cast<double>(number) + share) / static_cast<double>(setup_.speeds.size());
          watch(s, std::as_const(stage));
        });
    summarise(speed, flights);
  }

  void follow(Flight& flight, std::size_t b, double speed) {
    const auto& bodies = simulation_.bodies();
    bool touches = false;
    for (std::size_t s = bodies.first_sphere(b); s < bodies.first_sphere(b + 1); ++s) {
      touches = touches || squared_norm(bodies.forces()[s].force) > 0;
    }
    const double up = bodies.velocity(b).z();
    if (touches) {
      flight.drop.hits += flight.touched ? 0 : 1;
      flight.rising = false;
    } else if (flight.drop.hits > 0 && up > 0.0 && !flight.rising) {
      flight.rising = true;
      flight.drop.restitution = up / speed;
      flight.drop.energy_restitution =
          std::sqrt(2.0 * bodies.kinetic_energy(b) / (bodies.mass(b) * speed * speed));
    } else if (flight.rising && up <= 0.0) {
      flight.done = true;
    }
    flight.touched = touches;
    flight.done = flight.done || (flight.rising && bodies.position(b).z() > bodies.bounding_radius(b));
  }

  void summarise(double speed, const std::vector<Flight>& flights) {
    DropSeries series{.speed = speed, .height = 0.5 * speed * speed / gravity()};
    for (const Flight& flight : flights) {
      Drop drop = flight.drop;
      drop.left = flight.done || flight.rising;
      if (!drop.left) {
        drop.restitution = drop.energy_restitution = 0.0;
      }
      series.hit_again += drop.hits > 1 ? 1 : 0;
      series.stayed += drop.left ? 0 : 1;
      series.drops.push_back(drop);
    }
    series.restitution = mean_of(series.drops, &Drop::restitution);
    series.energy_restitution = mean_of(series.drops, &Drop::energy_restitution);
    result_.series.push_back(std::move(series));
  }

  static DropMean mean_of(const std::vector<Drop>& drops, double Drop::*value) {
    const auto n = static_cast<double>(drops.size());
    DropMean out;
    for (const Drop& drop : drops) {
      out.mean += drop.*value / n;
    }
    for (const Drop& drop : drops) {
      out.spread += std::pow(drop.*value - out.mean, 2) / (n - 1.0);
    }
    out.spread = std::sqrt(out.spread);
    out.error = out.spread / std::sqrt(n);
    return out;
  }

  DropTestSetup setup_;
  RunsOnce once_;
  Sim simulation_;
  MaterialId rock_ = 0;
  Packing rocks_;                 // about the origin
  std::vector<DrawnClump> drawn_; // the same
  double largest_ = 0.0;          // m, bounding radius
  std::size_t added_ = 0;         // bodies so far, for their ids
  DropTestResult result_;
};

} // namespace scree
