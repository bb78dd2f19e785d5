#pragma once
/// \file
/// Angle of repose: a heap below a funnel, or of a lifted cylinder (Coetzee et al. 2010, section 4.5).

#include "scree/core/random.hpp"
#include "scree/laboratory/heap_setup.hpp"
#include "scree/simulation/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <numbers>
#include <utility>

namespace scree {

/// Makes a heap and measures its angle.
///
///     scree::HeapTest<> test{scree::desk_heap()};
///     const scree::HeapAngle& flank = test.run().flank; // flank.angle, flank.standard_error [rad]
template <class Model = DefaultModel>
class HeapTest {
public:
  using Sim = Simulation<Model>;
  using Setting = HeapSetup;
  using Result = HeapResult;

  /// \throws Error for a parameter out of its range.
  explicit HeapTest(HeapSetup setup, Setup<Model> physics = {})
      : setup_{std::move(setup)},
        simulation_{with_sample(std::move(physics), setup_.sample, setup_.threads)} {
    setup_.check();
    if (setup_.method == HeapSetup::Method::funnel) {
      require_wide("funnel outlet", setup_.funnel.outlet);
    } else {
      require_wide("tube radius", setup_.tube.radius);
    }
    rock_ = simulation_.add_material(setup_.sample.rock);
    rig_ = simulation_.add_material(setup_.sample.rig);
    Material plate = setup_.sample.rock;
    plate.name = "plate";
    plate.friction = setup_.plate_friction;
    simulation_.add_wall(
        {.name = "plate", .surfaces = {{Plane{}, simulation_.add_material(plate)}}, .dynamics = Fixed{}});
  }

  /// Once. `watch(simulation, Stage)` is called after every step.
  /// \throws Error where grains stay in the funnel or there is no heap.
  template <class Watch>
  const HeapResult& run(Watch watch) {
    once_.begin("heap");
    Random random{setup_.seed, "filling"};
    const double begin =
        setup_.method == HeapSetup::Method::funnel ? fill_funnel(random, watch) : fill_tube(random, watch);
    result_.flow_time = simulation_.time() - begin;
    const Stage stage{"coming to rest", 0.9};
    const auto observe = [&](const auto& s) { watch(s, stage); };
    result_.unrest = come_to_rest(simulation_, setup_.rest, 0.05, observe);
    require_rest("heap", result_.unrest, setup_.rest);
    const auto& bodies = simulation_.bodies();
    result_.grains = bodies.size();
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      result_.mass += bodies.mass(b);
    }
    result_.flank = heap_angle(bodies, setup_.flank);
    return result_;
  }
  const HeapResult& run() {
    return run([](const auto&, const Stage&) {});
  }

  [[nodiscard]] const HeapSetup& setup() const { return setup_; }
  [[nodiscard]] const HeapResult& result() const { return result_; }
  [[nodiscard]] const Sim& simulation() const { return simulation_; }

private:
  /// s, when shutter or tube begin to move; both stand still before.
  using Begin = std::shared_ptr<double>;
  static Begin never() { return std::make_shared<double>(std::numeric_limits<double>::infinity()); }

  /// A cone of flat facets, and the disc that closes it, its origin in the middle of the outlet.
  [[nodiscard]] TriangleMesh cone() const {
    constexpr std::uint32_t sides = 48;
    const Funnel& f = setup_.funnel;
    TriangleMesh mesh;
    for (std::uint32_t k = 0; k < sides; ++k) {
      const double azimuth = 2.0 * std::numbers::pi * k / sides;
      const Vector out{std::cos(azimuth), std::sin(azimuth), 0.0};
      mesh.vertices.emplace_back(f.outlet * out);
      mesh.vertices.emplace_back(f.rim * out + f.height() * Vector::UnitZ());
      const std::uint32_t low = 2 * k, next = 2 * ((k + 1) % sides);
      mesh.facets.push_back({low, next, low + 1});
      mesh.facets.push_back({low + 1, next, next + 1});
    }
    return mesh;
  }
  [[nodiscard]] TriangleMesh disc() const {
    constexpr std::uint32_t sides = 48;
    TriangleMesh mesh;
    mesh.vertices.emplace_back(Vector::Zero());
    for (std::uint32_t k = 0; k < sides; ++k) {
      const double azimuth = 2.0 * std::numbers::pi * k / sides;
      mesh.vertices.emplace_back(1.05 * setup_.funnel.outlet *
                                 Vector{std::cos(azimuth), std::sin(azimuth), 0.0});
      mesh.facets.push_back({0, k + 1, (k + 1) % sides + 1});
    }
    return mesh;
  }

  /// Fills the funnel, opens it and waits until it is empty. Returns when it was opened [s].
  template <class Watch>
  double fill_funnel(Random& random, Watch& watch) {
    const Funnel& f = setup_.funnel;
    const double outlet = f.clearance, rim = f.clearance + f.height();
    const Begin begin = never();
    // Falls twice as fast as the grains that lie on it, to below the plate.
    const double fall = 2.0 * simulation_.setup().gravity.norm(), depth = outlet + 1.0;
    const auto sinks = [begin, outlet, fall, depth](double time) {
      const double after = std::max(0.0, time - *begin);
      return Pose{{0.0, 0.0, outlet - std::min(depth, 0.5 * fall * after * after)}};
    };
    const auto level = [begin, outlet, speed = f.lift_speed](double time) {
      return outlet + speed * std::max(0.0, time - *begin);
    };
    simulation_.add_wall(
        {.name = "funnel",
         .surfaces = {{cone(), rig_},
                      {Cylinder{.base = {0.0, 0.0, f.height()}, .radius = f.rim, .length = 1e3}, rig_}},
         .dynamics = Prescribed{[level](double time) {
           return Pose{{0.0, 0.0, level(time)}};
         }},
         .motion = {.position = {0.0, 0.0, outlet}}});
    simulation_.add_wall({.name = "shutter",
                          .surfaces = {{disc(), rig_}},
                          .dynamics = Prescribed{sinks},
                          .motion = {.position = {0.0, 0.0, outlet}}});

    const Assembly& assembly = setup_.sample.assembly;
    const auto drawn = assembly.draw_volume(f.solid, random);
    Packing pile = loose_pile(assembly.clumps(), drawn, RoundFootprint{0.99 * f.rim, rim}, random);
    for (PackedBody& body : pile.bodies) {
      body.material = rock_;
    }
    simulation_.add(pile);
    settle(std::sqrt(2.0 * (rim - outlet) / simulation_.setup().gravity.norm()), watch);
    *begin = simulation_.time();
    wait_until_below(level, 0.2, "the funnel", watch);
    return *begin;
  }

  /// Rock arches over openings of a few grains (five times the largest is the usual rule).
  void require_wide(const char* what, double radius) const {
    const double largest = setup_.sample.assembly.largest_diameter();
    if (2.0 * radius < 3.0 * largest) {
      throw Error(message(what, " = ", radius, " m: an opening of less than three of the largest grains, ",
                          largest, " m across, is sure to be arched over"));
    }
  }

  template <class Watch>
  void settle(double least, Watch& watch) {
    const Stage stage{"filling", 0.1};
    const auto observe = [&](const auto& s) { watch(s, stage); };
    const RestCriterion& rest = setup_.fill.rest;
    require_rest("funnel", scree::settle(simulation_, setup_.fill.settling_damping, rest, least, observe),
                 rest);
  }

  /// Fills the tube on the plate and draws it up. Returns when it began to move [s].
  template <class Watch>
  double fill_tube(Random& random, Watch& watch) {
    const Begin begin = never();
    const double height = setup_.tube.height, speed = setup_.lift_speed;
    const auto rises = [begin, height, speed](double time) {
      return Pose{{0.0, 0.0, std::min(1.5 * height, speed * std::max(0.0, time - *begin))}};
    };
    simulation_.add_wall(
        {.name = "tube",
         .surfaces = {{Cylinder{.radius = setup_.tube.radius, .length = 10.0 * height}, rig_}},
         .dynamics = Prescribed{rises}});
    fill_container(simulation_, setup_.tube, setup_.sample.assembly, rock_, setup_.fill, random,
                   [&](const auto& s, Stage stage) {
                     stage.share *= 0.2;
                     watch(s, stage);
                   });
    *begin = simulation_.time();
    const Stage stage{"lifting the tube", 0.5};
    run_for(simulation_, 1.2 * height / speed, [&](const auto& s) { watch(s, stage); });
    const auto& bodies = simulation_.bodies();
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      if (bodies.position(b).z() > 1.2 * height) {
        throw Error(message("heap: grains were carried up by the tube: tube radius = ", setup_.tube.radius,
                            " m is too narrow for them"));
      }
    }
    return *begin;
  }

  /// Steps until no grain is above `level(time)` [m].
  /// \throws Error where none passes it for as long as the setup's patience.
  template <class Level, class Watch>
  void wait_until_below(Level level, double share, const char* what, Watch& watch) {
    const std::size_t all = simulation_.bodies().size();
    std::size_t above = all;
    double next = simulation_.time(), last_passed = next;
    Stage stage{"flowing", share};
    run_while(
        simulation_,
        [&](const auto& s) {
          if (s.time() < next) {
            return true;
          }
          next = s.time() + 0.02;
          std::size_t left = 0;
          for (std::size_t b = 0; b < s.bodies().size(); ++b) {
            left += s.bodies().position(b).z() > level(s.time()) ? 1 : 0;
          }
          last_passed = left < above ? s.time() : last_passed;
          above = std::min(above, left);
          if (above > 0 && s.time() - last_passed > setup_.patience) {
            throw Error(message("heap: ", above, " of ", all, " grains are in ", what,
                                ", and none has left it for patience = ", setup_.patience,
                                " s: they arch, or the heap has grown up to it"));
          }
          return above > 0;
        },
        [&](const auto& s) {
          stage.share = share + 0.7 * (1.0 - static_cast<double>(above) / static_cast<double>(all));
          watch(s, std::as_const(stage));
        });
  }

  HeapSetup setup_;
  RunsOnce once_;
  Sim simulation_;
  MaterialId rock_ = 0, rig_ = 0;
  HeapResult result_;
};

} // namespace scree
