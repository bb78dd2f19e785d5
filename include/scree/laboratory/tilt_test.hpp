#pragma once
/// \file
/// Rocks on a plate, or a layer in a tray, tilted until they move.

#include "scree/core/random.hpp"
#include "scree/laboratory/rocks_on_plate.hpp"
#include "scree/laboratory/settled_bed.hpp"
#include "scree/laboratory/tilt_test_setup.hpp"
#include "scree/simulation/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

namespace scree {

/// Turns gravity slowly about the y axis, so that x points down the slope. The rock feels what it would on a
/// plate that is tilted, but for the plate's own turning, which is slow.
///
/// A rock on the plate has moved when its centre is further from where it lay than the setup asks, in terms
/// of its bounding diameter. It began at the last angle at which it was slower than the onset speed, so that
/// neither the way that it needs nor a face onto which it tipped before counts. Moved rocks are held where
/// they are, as otherwise they would run down into others. A lone sphere rolls at once, and is reported apart
/// from the mean; a long clump across the slope does so too, and is not.
///
/// A layer has failed when half of the grains of its upper half (by number, those not held to the floor) have
/// moved so far, in terms of their mean bounding diameter, and began likewise: the medians, as the tray ends
/// at its brim, and the few grains that go over it travel far.
///
///     scree::TiltTest<> test{scree::desk_tilt_test()};
///     const double angle = test.run().angle; // degrees
template <class Model = DefaultModel>
class TiltTest {
public:
  using Sim = Simulation<Model>;
  using Setting = TiltTestSetup;
  using Result = TiltTestResult;

  /// \throws Error for a parameter out of its range, or gravity that is not straight down.
  explicit TiltTest(TiltTestSetup setup, Setup<Model> physics = {})
      : setup_{std::move(setup)},
        simulation_{with_sample(std::move(physics), setup_.sample, setup_.threads)} {
    setup_.check();
    gravity_ = -simulation_.setup().gravity.z();
    rock_ = simulation_.add_material(setup_.sample.rock);
    rig_ = simulation_.add_material(setup_.sample.rig);
    if (setup_.method == TiltMethod::single) {
      base_ = simulation_.add_wall({.name = "plate", .surfaces = {{Plane{}, rig_}}, .dynamics = Fixed{}});
    } else {
      build_tray();
    }
  }

  /// Once. `watch(simulation, Stage)` is called after every step.
  template <class Watch>
  const TiltTestResult& run(Watch watch) {
    once_.begin("tilt test");
    if (setup_.method == TiltMethod::single) {
      lay_rocks(watch);
      tilt_rocks(watch);
    } else {
      fill_tray(watch);
      tilt_layer(watch);
    }
    return result_;
  }
  const TiltTestResult& run() {
    return run([](const auto&, const Stage&) {});
  }

  [[nodiscard]] const TiltTestSetup& setup() const { return setup_; }
  [[nodiscard]] const TiltTestResult& result() const { return result_; }
  [[nodiscard]] const Sim& simulation() const { return simulation_; }
  /// Degrees, of the slope now.
  [[nodiscard]] double angle() const { return angle_; }

private:
  static constexpr double rest_share = 0.2; // of the whole experiment's time; ours, as seen at desk fidelity
  static constexpr double degree = std::numbers::pi / 180.0;

  // ---- tilting ----

  /// Turns gravity while `go()` is true; calls `each(row_due)` after every step, with whether a row of the
  /// curve is due.
  template <class Go, class Each, class Watch>
  void tilt(Go go, Each each, Watch& watch) {
    start_ = simulation_.time();
    const double interval = setup_.steepest / static_cast<double>(setup_.points);
    double next = 0.0;
    Stage stage{"tilting", rest_share};
    run_while(
        simulation_,
        [&](const auto& s) {
          angle_ = setup_.rate * (s.time() - start_);
          if (!go() || angle_ > setup_.steepest) {
            return false;
          }
          simulation_.set_gravity(gravity_ *
                                  Vector{std::sin(angle_ * degree), 0.0, -std::cos(angle_ * degree)});
          return true;
        },
        [&](const auto& s) {
          const bool due = angle_ >= next;
          next += due ? interval : 0.0;
          each(due);
          stage.share = rest_share + (1.0 - rest_share) * angle_ / setup_.steepest;
          watch(s, std::as_const(stage));
        });
  }

  void note(double share, double displacement) {
    result_.curve.push_back({simulation_.time() - start_, angle_, share, displacement});
  }

  /// How a body lay before the tilting.
  struct Lie {
    Vector position = Vector::Zero();
    Quaternion orientation = Quaternion::Identity();
    double reach = 0.0; ///< m, that it must move
  };
  [[nodiscard]] Lie lie(std::size_t b) const {
    const auto& bodies = simulation_.bodies();
    return {bodies.position(b), bodies.orientation(b), setup_.moved * 2.0 * bodies.bounding_radius(b)};
  }

  // ---- rocks on a plate ----

  template <class Watch>
  void lay_rocks(Watch& watch) {
    Random random{setup_.seed, "rocks"};
    const Assembly& assembly = setup_.sample.assembly;
    const auto drawn = assembly.draw(setup_.rocks, random);
    Packing rocks = turned_rocks(assembly, drawn, rock_, random);
    double largest = 0.0;
    for (const DrawnClump& grain : drawn) {
      largest = std::max(largest, assembly.bounding_diameter(grain));
      result_.rocks.push_back({.rock = grain, .sphere = rocks.shapes[grain.shape].spheres.size() == 1});
    }
    // Ours: a rock tips by less than its size until it lies, and moves by less than its size until it is
    // held.
    const double pitch = (3.0 + 2.0 * std::max(1.0, setup_.moved)) * largest;
    place_in_rows(rocks, pitch, 0.0);
    simulation_.add(rocks);
    settle(0.1, watch);
  }

  /// Lets what lies there come to rest with the damping of the filling.
  template <class Watch>
  void settle(double least, Watch& watch) {
    const Stage stage{"coming to rest", 0.5 * rest_share};
    auto observe = [&](auto& s) { watch(s, stage); };
    result_.unrest = scree::settle(simulation_, setup_.bed.settling_damping, setup_.rest, least, observe);
    require_rest("tilt test", result_.unrest, setup_.rest);
    stop_all(simulation_);
  }

  template <class Watch>
  void tilt_rocks(Watch& watch) {
    const auto& bodies = simulation_.bodies();
    std::vector<Lie> lies(setup_.rocks);
    std::vector<double> way(setup_.rocks, 0.0); // m
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      lies[bodies.id(b)] = lie(b);
    }
    const double slow = setup_.onset_speed * setup_.onset_speed;
    std::size_t open = setup_.rocks;
    const auto follow = [&](bool due) {
      const std::size_t before = open;
      for (std::size_t b = 0; b < bodies.size(); ++b) {
        if (bodies.is_fixed(b)) {
          continue;
        }
        const std::size_t id = bodies.id(b);
        TiltedRock& rock = result_.rocks[id];
        way[id] = (bodies.position(b) - lies[id].position).norm();
        rock.angle = bodies.velocity(b).squaredNorm() <= slow ? angle_ : rock.angle;
        if (way[id] > lies[id].reach) {
          rock.moved = true;
          rock.failure_angle = angle_;
          const double turned = lies[id].orientation.angularDistance(bodies.orientation(b)) / degree;
          rock.rolled = rock.sphere || turned > setup_.rolled;
          --open;
        }
      }
      if (open < before) {
        simulation_.fix_bodies(
            [&](const auto& all, std::size_t b) { return result_.rocks[all.id(b)].moved; });
      }
      if (due || open == 0) {
        note_rocks(way);
      }
    };
    tilt([&] { return open > 0; }, follow, watch);
    summarise_rocks();
  }

  void note_rocks(const std::vector<double>& way) {
    double count = 0.0, moved = 0.0, sum = 0.0;
    for (std::size_t k = 0; k < way.size(); ++k) {
      if (!result_.rocks[k].sphere) {
        count += 1.0;
        moved += result_.rocks[k].moved ? 1.0 : 0.0;
        sum += way[k];
      }
    }
    note(moved / std::max(1.0, count), sum / std::max(1.0, count));
  }

  void summarise_rocks() {
    std::vector<double> angles;
    double sum = 0.0, slid = 0.0, failures = 0.0;
    for (TiltedRock& rock : result_.rocks) {
      rock.angle = rock.moved ? rock.angle : 0.0;
      if (rock.sphere) {
        ++result_.spheres;
      } else if (!rock.moved) {
        ++result_.held;
      } else {
        ++(rock.rolled ? result_.rolled : result_.slid);
        angles.push_back(rock.angle);
        sum += rock.angle;
        slid += rock.rolled ? 0.0 : rock.angle;
        failures += rock.failure_angle;
      }
    }
    result_.failed = result_.held == 0 && !angles.empty();
    if (angles.empty()) {
      return;
    }
    const auto n = static_cast<double>(angles.size());
    result_.angle = sum / n;
    result_.slid_angle = slid / std::max(1.0, static_cast<double>(result_.slid));
    result_.failure_angle = failures / n;
    double squares = 0.0;
    for (const double a : angles) {
      squares += (a - result_.angle) * (a - result_.angle);
    }
    result_.spread = std::sqrt(squares / std::max(1.0, n - 1.0));
    result_.error = result_.spread / std::sqrt(n);
    std::sort(angles.begin(), angles.end());
    result_.median = 0.5 * (angles[(angles.size() - 1) / 2] + angles[angles.size() / 2]);
  }

  // ---- a layer in a tray ----

  /// Sides up to the brim, and inside of them four gates without end that hold what is poured above it.
  void build_tray() {
    const Tray& tray = setup_.tray;
    const double half = 0.5 * tray.width;
    base_ = simulation_.add_wall({.name = "floor",
                                  .surfaces = {{Plane{{0.0, 0.0, -tray.depth}, Vector::UnitZ()}, rig_}},
                                  .dynamics = Fixed{}});
    TriangleMesh sides;
    for (const double z : {-tray.depth, 0.0}) {
      for (const auto& [x, y] : {std::pair{0.0, -half}, std::pair{tray.length, -half},
                                 std::pair{tray.length, half}, std::pair{0.0, half}}) {
        sides.vertices.emplace_back(x, y, z);
      }
    }
    for (std::uint32_t k = 0; k < 4; ++k) {
      const std::uint32_t next = (k + 1) % 4;
      sides.facets.push_back({k, next, k + 4});
      sides.facets.push_back({next, next + 4, k + 4});
    }
    simulation_.add_wall({.name = "sides", .surfaces = {{std::move(sides), rig_}}, .dynamics = Fixed{}});
    add_gate({0.0, 0.0, 0.0}, Vector::UnitX());
    add_gate({tray.length, 0.0, 0.0}, -Vector::UnitX());
    add_gate({0.0, -half, 0.0}, Vector::UnitY());
    add_gate({0.0, half, 0.0}, -Vector::UnitY());
  }

  void add_gate(const Vector& side, const Vector& inward) {
    // Ours: a gate stands so little before the side that nothing falls when it goes, and then goes slowly.
    const double before = 1e-3 * setup_.tray.depth, speed = 0.02; // m, m/s
    const double most = before + setup_.tray.length;
    const auto path = [side, inward, before, speed, most, opened = opened_](double t) {
      const double out = std::clamp(speed * (t - *opened), 0.0, most);
      return Pose{side + (before - out) * inward};
    };
    simulation_.add_wall({.name = "gate",
                          .surfaces = {{Plane{Vector::Zero(), inward}, rig_}},
                          .dynamics = Prescribed{path},
                          .motion = {.position = side + before * inward}});
  }

  template <class Watch>
  void fill_tray(Watch& watch) {
    Random random{setup_.seed, "tray"};
    const BedContainer box = BedContainer::box(setup_.tray.length, setup_.tray.width, setup_.tray.depth);
    result_.bed = settle_bed(simulation_, box, setup_.sample.assembly, rock_, setup_.bed, random,
                             [&](const auto& s, Stage stage) {
                               stage.share *= 0.5 * rest_share;
                               watch(s, stage);
                             });
    if (setup_.tray.rough) {
      std::set<std::size_t> low;
      simulation_.visit_contacts([&](const ContactView& contact) {
        if (contact.with_wall && contact.second == base_) {
          low.insert(contact.first);
        }
      });
      result_.glued = simulation_.fix_bodies([&](const auto&, std::size_t b) { return low.count(b) > 0; });
    }
    *opened_ = simulation_.time();
    settle(0.1, watch);
  }

  template <class Watch>
  void tilt_layer(Watch& watch) {
    const auto& bodies = simulation_.bodies();
    std::vector<double> heights;
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      if (!bodies.is_fixed(b)) {
        heights.push_back(bodies.position(b).z());
      }
    }
    result_.free = heights.size();
    if (heights.empty()) {
      throw Error(message("tray depth = ", setup_.tray.depth,
                          " m leaves no grain above those that are held to the floor"));
    }
    const double middle = middle_of(heights);
    std::vector<Lie> lies;
    std::vector<std::size_t> place_of; // in `lies`, by id
    double count = 0.0;
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      if (!bodies.is_fixed(b) && bodies.position(b).z() >= middle) {
        place_of.resize(std::max(place_of.size(), static_cast<std::size_t>(bodies.id(b)) + 1), none);
        place_of[bodies.id(b)] = lies.size();
        lies.push_back(lie(b));
        result_.grain_size += 2.0 * bodies.bounding_radius(b);
        count += 1.0;
      }
    }
    result_.grain_size /= count;

    std::vector<double> speeds, ways; // of these grains
    const auto follow = [&](bool due) {
      double moved = 0.0;
      speeds.clear();
      ways.clear();
      for (std::size_t b = 0; b < bodies.size(); ++b) {
        const std::size_t k = bodies.id(b) < place_of.size() ? place_of[bodies.id(b)] : none;
        if (k != none) {
          const double own = (bodies.position(b) - lies[k].position).norm();
          speeds.push_back(bodies.velocity(b).norm());
          ways.push_back(own);
          moved += own > lies[k].reach ? 1.0 / count : 0.0;
        }
      }
      const double way = middle_of(ways);
      result_.angle = middle_of(speeds) <= setup_.onset_speed ? angle_ : result_.angle;
      if (way > setup_.moved * result_.grain_size) {
        result_.failed = true;
        result_.failure_angle = angle_;
      }
      if (due || result_.failed) {
        note(moved, way);
      }
    };
    tilt([&] { return !result_.failed; }, follow, watch);
    result_.angle = result_.failed ? result_.angle : 0.0;
  }

  /// The upper median; changes the order.
  static double middle_of(std::vector<double>& values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
  }

  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

  TiltTestSetup setup_;
  RunsOnce once_;
  Sim simulation_;
  MaterialId rock_ = 0, rig_ = 0;
  std::size_t base_ = 0;
  double gravity_ = 0.0;             // m/s2
  double start_ = 0.0, angle_ = 0.0; // s, degrees
  /// s, when the gates began to go.
  std::shared_ptr<double> opened_ = std::make_shared<double>(std::numeric_limits<double>::infinity());
  TiltTestResult result_;
};

} // namespace scree
