#pragma once
/// \file
/// Confined compression in a cylinder (Coetzee et al. 2010, section 4.4).

#include "scree/core/random.hpp"
#include "scree/laboratory/come_to_rest.hpp"
#include "scree/laboratory/oedometer_setup.hpp"
#include "scree/simulation/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <tuple>
#include <utility>
#include <vector>

namespace scree {

/// Fills the container, brings a lid down on the grains at a constant speed until it carries the high load,
/// up again until it carries the low one, and so on.
///
///     scree::Oedometer<> oedometer{scree::desk_oedometer()};
///     const double modulus = oedometer.run().modulus; // Pa
template <class Model = DefaultModel>
class Oedometer {
public:
  using Sim = Simulation<Model>;
  using Setting = OedometerSetup;
  using Result = OedometerResult;

  /// \throws Error for a parameter out of its range.
  explicit Oedometer(OedometerSetup setup, Setup<Model> physics = {})
      : setup_{std::move(setup)},
        simulation_{with_sample(std::move(physics), setup_.sample, setup_.threads)} {
    setup_.check();
    result_.inertial_number = setup_.strain_rate * setup_.sample.assembly.mean_diameter() *
                              std::sqrt(setup_.sample.rock.density / setup_.low_stress);
    if (result_.inertial_number > setup_.most_inertial_number) {
      throw Error(message("oedometer strain_rate = ", setup_.strain_rate,
                          " 1/s: the inertial number under low_stress = ", setup_.low_stress, " Pa is ",
                          result_.inertial_number,
                          ", above most_inertial_number = ", setup_.most_inertial_number));
    }
    rock_ = simulation_.add_material(setup_.sample.rock);
    rig_ = simulation_.add_material(setup_.sample.rig);
    mantle_ = simulation_.add_wall(
        {.name = "mantle", .surfaces = setup_.container.mantle(rig_), .dynamics = Fixed{}});
    base_ =
        simulation_.add_wall({.name = "base", .surfaces = RoundContainer::floor(rig_), .dynamics = Fixed{}});
  }

  /// Once. `watch(simulation, Stage)` is called after every step.
  /// \throws Error where the grains do not carry the load.
  template <class Watch>
  const OedometerResult& run(Watch watch) {
    once_.begin("oedometer");
    Random random{setup_.seed, "filling"};
    result_.fill = fill_container(simulation_, setup_.container, setup_.sample.assembly, rock_, setup_.fill,
                                  random, [&](const auto& s, Stage stage) {
                                    stage.share *= fill_share;
                                    watch(s, stage);
                                  });
    bring_down_lid(watch);
    for (std::size_t cycle = 0; cycle < setup_.cycles; ++cycle) {
      branch(cycle, true, watch);
      if (cycle + 1 < setup_.cycles) {
        branch(cycle, false, watch);
      }
      result_.cycles.push_back(oedometer_cycle(result_.curve, cycle, window()));
    }
    result_.slope = result_.cycles.back().slope;
    result_.modulus = result_.cycles.back().modulus;
    return result_;
  }
  const OedometerResult& run() {
    return run([](const auto&, const Stage&) {});
  }

  [[nodiscard]] const OedometerSetup& setup() const { return setup_; }
  [[nodiscard]] const OedometerResult& result() const { return result_; }
  [[nodiscard]] const Sim& simulation() const { return simulation_; }
  /// m, of the lid above the floor.
  [[nodiscard]] double lid_height() const { return simulation_.wall(lid_).motion.position.z(); }

private:
  // Of the whole experiment's time, when the container is filled and when the lid carries the low load; ours,
  // as seen at desk fidelity.
  static constexpr double fill_share = 0.4, lid_share = 0.45;

  /// How the lid moves from now on.
  struct Drive {
    double since = 0.0, from = 0.0; ///< s, m
    double speed = 0.0;             ///< m/s, up

    [[nodiscard]] Pose at(double time) const { return {{0.0, 0.0, from + speed * (time - since)}}; }
  };

  void drive(double speed) {
    drive_->from = lid_height();
    drive_->since = simulation_.time();
    drive_->speed = speed;
  }
  [[nodiscard]] double speed() const { return setup_.strain_rate * setup_.container.height; }
  [[nodiscard]] double load(double stress) const { return stress * setup_.container.area(); }
  [[nodiscard]] double lid_force() const { return simulation_.wall(lid_).load.force.z(); }

  /// Puts the lid on the highest grain and lowers it until it carries the low load.
  template <class Watch>
  void bring_down_lid(Watch& watch) {
    double top = 0.0;
    for (const auto& sphere : simulation_.bodies().spheres()) {
      top = std::max(top, sphere.position.z + static_cast<double>(sphere.radius));
    }
    drive_->from = top;
    drive_->since = simulation_.time();
    lid_ = simulation_.add_wall({.name = "lid",
                                 .surfaces = {{Plane{Vector::Zero(), -Vector::UnitZ()}, rig_}},
                                 .dynamics = Prescribed{[drive = drive_](double t) { return drive->at(t); }},
                                 .motion = {.position = {0.0, 0.0, top}}});
    Stage stage{"bringing down the lid", fill_share};
    const auto lower = [&](double stress, double down) {
      drive(-down);
      run_while(
          simulation_, [&](const auto&) { return lid_force() < load(stress) && in_container(); },
          [&](const auto& s) {
            const double carried = std::clamp(lid_force() / load(setup_.low_stress), 0.0, 1.0);
            stage.share = std::max(stage.share, fill_share + (lid_share - fill_share) * carried);
            watch(s, std::as_const(stage));
          });
    };
    const auto to_low_load = [&] {
      lower(setup_.approach_to * setup_.low_stress, setup_.approach * speed());
      lower(setup_.low_stress, speed());
      return lid_height();
    };
    result_.height = setup_.seated
                         ? with_friction(simulation_, rock_, setup_.fill.packing_friction, to_low_load)
                         : to_low_load();
    start_ = simulation_.time();
  }

  [[nodiscard]] bool in_container() const {
    if (lid_height() < 0.5 * setup_.container.height) {
      throw Error(message("oedometer: the lid has sunk to ", lid_height(), " m of ", setup_.container.height,
                          " m and the grains carry ", lid_force() / setup_.container.area(),
                          " Pa: normal_stiffness is too low for high_stress = ", setup_.high_stress, " Pa"));
    }
    return true;
  }

  /// One loading or unloading, with its rows of the curve.
  template <class Watch>
  void branch(std::size_t cycle, bool loading, Watch& watch) {
    drive(loading ? -speed() : speed());
    const auto branches = static_cast<double>(2 * setup_.cycles - 1);
    const double done = static_cast<double>(2 * cycle + (loading ? 0 : 1)) / branches;
    const double wanted = load(loading ? setup_.high_stress : setup_.low_stress);
    const double from = lid_force();
    Reading last = read();
    double last_force = from;
    const double least = 20.0 * simulation_.time_step(), change = std::abs(wanted - from);
    Stage stage{loading ? "loading" : "unloading", 0.0};
    run_while(
        simulation_,
        [&](const auto&) {
          return (loading ? lid_force() < wanted : lid_force() > wanted) && in_container();
        },
        [&](const auto& s) {
          if (s.time() - last.time >= least &&
              std::abs(lid_force() - last_force) * static_cast<double>(setup_.points) >= change) {
            note(cycle, loading, last);
            last_force = lid_force();
          }
          const double way = std::clamp((lid_force() - from) / (wanted - from), 0.0, 1.0);
          stage.share = lid_share + (1.0 - lid_share) * (done + way / branches);
          watch(s, std::as_const(stage));
        });
    note(cycle, loading, last);
  }

  /// What adds up over time.
  struct Reading {
    double time, displacement, lid, base, mantle; // s, m, N s
  };
  [[nodiscard]] Reading read() const {
    const auto impulse = [this](std::size_t wall) { return simulation_.wall(wall).load.impulse.z(); };
    return {simulation_.time(), result_.height - lid_height(), impulse(lid_), -impulse(base_),
            -impulse(mantle_)};
  }

  void note(std::size_t cycle, bool loading, Reading& last) {
    const Reading now = read();
    const double span = now.time - last.time;
    if (span > 0.0) {
      result_.curve.push_back({0.5 * (last.time + now.time) - start_,
                               0.5 * (last.displacement + now.displacement), (now.lid - last.lid) / span,
                               (now.base - last.base) / span, (now.mantle - last.mantle) / span, cycle,
                               loading});
    }
    last = now;
  }

  [[nodiscard]] SlopeWindow window() const {
    const double low = load(setup_.low_stress), range = load(setup_.high_stress) - low;
    return {.low_force = low + setup_.slope_from * range,
            .high_force = low + setup_.slope_to * range,
            .height = result_.height,
            .area = setup_.container.area()};
  }

  OedometerSetup setup_;
  RunsOnce once_;
  Sim simulation_;
  MaterialId rock_ = 0, rig_ = 0;
  std::size_t mantle_ = 0, base_ = 0, lid_ = 0;
  std::shared_ptr<Drive> drive_ = std::make_shared<Drive>();
  double start_ = 0.0; // s
  OedometerResult result_;
};

} // namespace scree
