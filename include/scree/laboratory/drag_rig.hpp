#pragma once
/// \file
/// The dragline experiment: a bed of rock, a bucket, and what hauls it.

#include "scree/core/archive.hpp"
#include "scree/geometry/mesh_measures.hpp"
#include "scree/laboratory/bed_making.hpp"
#include "scree/laboratory/bucket_haul.hpp"
#include "scree/laboratory/drag_setup.hpp"
#include "scree/measure/attitude.hpp"
#include "scree/measure/bucket_fill.hpp"
#include "scree/measure/energy.hpp"
#include "scree/measure/surface_height.hpp"
#include "scree/simulation/simulation.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

namespace scree {

/// One line of the record.
struct DragSample {
  double time = 0.0;        ///< s, since the winch started
  double drag = 0.0;        ///< m, of the bucket's centre of gravity along the bed
  double wound = 0.0;       ///< m, of rope wound in, each, since the winch started
  double force = 0.0;       ///< N, of what hauls the bucket, mean since the sample before
  double force_left = 0.0;  ///< N, of the left rope
  double force_right = 0.0; ///< N
  double lift = 0.0;        ///< N, upwards, of what hauls the bucket, likewise; 0 in the first sample
  Attitude attitude{};      ///< rad; the pitch from where the bucket had come to rest [paper, section 7]
  double depth = 0.0;       ///< m, of the centre of gravity, normal to the bed, below its place at the start
  BucketFill fill{};
  std::size_t bodies = 0;
  double kinetic_energy = 0.0;  ///< J, of grains and bucket
  double frictional_work = 0.0; ///< J, since the winch started
};

/// Builds the rig and runs it.
///
///     DragRig<DigModel> rig{desk_drag(), bucket};
///     rig.make_bed(assembly, watch);
///     rig.place_bucket(watch);
///     while (!rig.done()) { rig.advance(0.01, watch); use(rig.sample()); }
///
/// \tparam Haul what moves the bucket (bucket_haul.hpp)
template <class Model, class Haul = RopeHaul>
class DragRig {
public:
  using Sim = Simulation<Model>;

  /// \throws Error for a parameter out of range.
  explicit DragRig(const DragSetup& setup, BucketBody bucket, Setup<Model> physics = {}, Haul haul = {})
      : setup_{setup},
        bucket_{std::move(bucket)},
        box_{bounding_box(bucket_.surface)},
        gauge_{bucket_.interior, box_.sizes().z()},
        haul_{std::move(haul)},
        simulation_{physics_of(setup, std::move(physics))},
        random_{setup.seed, "bed"},
        rock_{simulation_.add_material(setup_.rock)},
        making_{setup_.container(), rock_, setup_.bed} {
    check();
    const MaterialId floor = simulation_.add_material(setup_.floor);
    steel_ = simulation_.add_material(setup_.steel);
    bed_ = simulation_.add_wall(
        {.name = "trough", .surfaces = setup_.container().surfaces(floor), .dynamics = Fixed{}});
  }

  /// Fills the trough, or goes on with it. `watch(simulation, Stage)` is called after every step.
  template <class Watch>
  const BedReport& make_bed(const Assembly& assembly, Watch watch) {
    if (phase_ == Phase::empty) {
      making_.pour(simulation_, assembly, random_);
      phase_ = Phase::filling;
    }
    while (phase_ == Phase::filling && making_.step(simulation_)) {
      watch(simulation_, making_.stage());
    }
    if (phase_ == Phase::filling) {
      phase_ = Phase::filled;
    }
    return making_.report();
  }

  /// Lays the bucket with its floor flat on the mean surface of the bed, so that teeth that lean below the
  /// floor are in the rock, and takes away the grains that are where the bucket is. Hitches the ropes taut,
  /// where there are any, and lets it come to rest. `watch(simulation)` is called after every step. Goes on
  /// with it, or does nothing, where it had begun.
  template <class Watch>
  void place_bucket(Watch watch) {
    if (phase_ < Phase::filled) {
      throw Error("drag rig: there is no bed to place the bucket on");
    }
    if (phase_ == Phase::filled) {
      laid_.position = {setup_.bucket_start - box_.min().x(), 0.0, surface_below_bucket()};
      clear_of_bucket(laid_);
      winch_start_ = simulation_.time() + setup_.placing_time;
      lay_bucket();
      phase_ = Phase::placing;
    }
    if (phase_ != Phase::placing) {
      return;
    }
    const double half = 0.5 * simulation_.time_step();
    run_while(
        simulation_, [&](const auto& s) { return s.time() < winch_start_ - half; }, watch);
    phase_ = Phase::dragging;
    start_ = centre();
    placed_pitch_ = attitude(bucket_motion().orientation).pitch;
    lost_at_start_ = simulation_.dissipation().friction;
    last_sample_ = simulation_.time();
    next_removal_ = setup_.removal_interval;
    haul_.begin(simulation_, wall_, setup_, bucket_, winch_start_);
    if constexpr (Model::Rest::rests) {
      simulation_.set_rest(setup_.resting);
    }
  }

  /// Steps for about `interval` [s] of simulated time, at least one step. Goes on with an interval that was
  /// not over.
  template <class Watch>
  void advance(double interval, Watch watch) {
    bool first = !until_;
    if (first) {
      until_ = simulation_.time() + interval;
    }
    for (; first || simulation_.time() < *until_; first = false) {
      simulation_.step();
      haul_.observe(simulation_, simulation_.time_step());
      watch(simulation_);
    }
    until_.reset();
    if (setup_.remove_behind && drag() >= next_removal_) {
      remove_behind();
      next_removal_ += setup_.removal_interval;
    }
    check_bucket();
  }

  /// The record at this moment; forces are means since the last call.
  DragSample sample() {
    DragSample s;
    const WallMotion& motion = simulation_.wall(wall_).motion;
    s.time = simulation_.time() - winch_start_;
    s.drag = drag();
    s.wound = setup_.wound(s.time);
    const HaulForce pull = haul_.take(simulation_, simulation_.time() - last_sample_);
    s.force = pull.total;
    s.force_left = pull.left;
    s.force_right = pull.right;
    s.lift = pull.lift;
    last_sample_ = simulation_.time();
    s.attitude = attitude(motion.orientation);
    s.attitude.pitch -= placed_pitch_;
    s.depth = start_.z() - centre().z();
    s.fill = gauge_(simulation_.bodies(), motion);
    s.bodies = simulation_.bodies().size();
    s.kinetic_energy = kinetic_energy(simulation_.bodies()) + haul_.kinetic_energy(simulation_);
    s.frictional_work = simulation_.dissipation().friction - lost_at_start_;
    return s;
  }

  /// m, of the bucket's centre of gravity along the bed since the winch started.
  [[nodiscard]] double drag() const { return phase_ == Phase::dragging ? centre().x() - start_.x() : 0.0; }
  /// rad, of the bucket at rest on the bed before it is pulled, against the level.
  [[nodiscard]] double placed_pitch() const { return placed_pitch_; }
  /// Not within an interval.
  [[nodiscard]] bool done() const { return !until_ && drag() >= setup_.drag_distance; }

  [[nodiscard]] const Sim& simulation() const { return simulation_; }
  [[nodiscard]] Sim& simulation() { return simulation_; }
  [[nodiscard]] const DragSetup& setup() const { return setup_; }
  [[nodiscard]] const BucketBody& bucket() const { return bucket_; }
  [[nodiscard]] const BedReport& bed_report() const { return making_.report(); }
  [[nodiscard]] const WallMotion& bucket_motion() const { return simulation_.wall(wall_).motion; }
  /// Of a bucket that hangs on ropes.
  [[nodiscard]] const std::vector<Rope>& ropes() const { return haul_.ropes(simulation_); }

  /// All that is yet to come depends on: written at any time, or read into a rig that was made with the same
  /// setup, bucket and haul and has done nothing yet (core/archive.hpp).
  /// \throws Error where it was made otherwise, or has begun.
  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {
    archive.section("drag rig");
    if constexpr (Archive::reading) {
      if (self.phase_ != Phase::empty) {
        archive.fail("this rig has begun with something else");
      }
    }
    archive(self.phase_, self.random_, self.making_, self.laid_, self.winch_start_, self.last_sample_,
            self.next_removal_, self.lost_at_start_, self.placed_pitch_, self.start_, self.until_,
            self.haul_);
    if constexpr (Archive::reading) {
      if (self.phase_ >= Phase::placing) {
        self.lay_bucket();
      }
      if (self.phase_ == Phase::dragging) {
        self.haul_.go_on(self.simulation_, self.setup_, self.bucket_);
      }
    }
    archive(self.simulation_);
  }

private:
  enum class Phase : std::uint8_t { empty, filling, filled, placing, dragging };

  static Setup<Model> physics_of(const DragSetup& setup, Setup<Model> physics) {
    physics.gravity = setup.gravity();
    physics.stiffness = setup.stiffness;
    physics.local_damping = setup.local_damping;
    physics.threads = setup.threads;
    return physics;
  }

  void check() const {
    require_positive("drag_speed", setup_.drag_speed, "m/s");
    require_positive("drag_distance", setup_.drag_distance, "m");
    require_positive("ramp", setup_.ramp, "s");
    require_positive("removal_interval", setup_.removal_interval, "m");
    require_positive("removal_distance", setup_.removal_distance, "bucket lengths");
    require("placing_time", setup_.placing_time, {0.0, 1e3, "s"});
    require("drag_angle", setup_.drag_angle, {-1.2, 1.2, "rad"});
    require("bucket_start", setup_.bucket_start, {0.0, setup_.bed_length, "m"});
    const double needed = setup_.bucket_start + box_.sizes().x() + setup_.drag_distance;
    if (needed > setup_.bed_length) {
      throw Error(message("bed_length = ", setup_.bed_length,
                          " m is too short: start, bucket and drag distance need ", needed, " m"));
    }
    if (box_.sizes().y() > setup_.bed_width) {
      throw Error(message("bed_width = ", setup_.bed_width, " m is narrower than the bucket, ",
                          box_.sizes().y(), " m"));
    }
    if (!Model::Rest::rests && setup_.resting.speed != 0.0) {
      throw Error(message("resting.speed = ", setup_.resting.speed,
                          " m/s: in this simulation nothing rests (Model::Rest is not RestingRegions)"));
    }
    setup_.resting.check();
    haul_.check(setup_);
  }

  /// Where `laid_` says.
  void lay_bucket() {
    wall_ = simulation_.add_wall({.name = "bucket",
                                  .surfaces = {{bucket_.surface, steel_}},
                                  .dynamics = haul_.laid(setup_, bucket_, laid_, winch_start_),
                                  .motion = laid_});
  }

  [[nodiscard]] Vector centre() const { return simulation_.wall(wall_).motion.to_space(bucket_.body.centre); }

  /// m, mean height of the bed over the plan of the bucket, from the highest point of each of its cells.
  [[nodiscard]] double surface_below_bucket() const {
    constexpr int cells = 6;
    const double width = box_.sizes().x() / cells, depth = box_.sizes().y() / cells;
    double sum = 0.0;
    for (int i = 0; i < cells; ++i) {
      for (int j = 0; j < cells; ++j) {
        const Eigen::Vector2d low{setup_.bucket_start + i * width, box_.min().y() + j * depth};
        sum += highest_point(simulation_.bodies(), {low, Eigen::Vector2d{low.x() + width, low.y() + depth}});
      }
    }
    if (!std::isfinite(sum)) {
      throw Error(
          message("bucket_start = ", setup_.bucket_start, " m: there is no rock below a part of the bucket"));
    }
    return sum / (cells * cells);
  }

  /// Takes away the grains that a bucket at this place would cut.
  void clear_of_bucket(const WallMotion& motion) {
    const MeshSurface surface{bucket_.surface};
    std::vector<std::uint32_t> facets;
    simulation_.remove_bodies([&](const auto& bodies, std::size_t b) {
      for (std::size_t s = bodies.first_sphere(b); s < bodies.first_sphere(b + 1); ++s) {
        const auto& sphere = bodies.spheres()[s];
        facets.clear();
        surface.facets_near(motion.to_wall(to_eigen(sphere.position)), sphere.radius, facets);
        if (!facets.empty()) {
          return true;
        }
      }
      return false;
    });
  }

  /// Removes grains further behind the bucket than the removal distance and makes the row behind that line a
  /// wall.
  void remove_behind() {
    const double rear = simulation_.wall(wall_).motion.to_space(Vector{box_.min().x(), 0.0, 0.0}).x();
    const double cut = rear - setup_.removal_distance * box_.sizes().x();
    simulation_.remove_bodies(
        [&](const auto& bodies, std::size_t b) { return bodies.position(b).x() < cut; });
    simulation_.fix_bodies([&](const auto& bodies, std::size_t b) {
      return bodies.position(b).x() - bodies.bounding_radius(b) < cut;
    });
  }

  void check_bucket() const {
    const WallMotion& motion = simulation_.wall(wall_).motion;
    for (const Vector& vertex : bucket_.surface.vertices) {
      const Vector at = motion.to_space(vertex);
      if (at.z() < -setup_.container().depth_at(at.x())) {
        throw Error(message("the bucket has reached the floor of the trough at t = ", simulation_.time(),
                            " s, drag ", drag(), " m: make the bed deeper"));
      }
      if (at.x() > setup_.bed_length) {
        throw Error(
            message("the bucket has reached the end of the trough at t = ", simulation_.time(), " s"));
      }
    }
  }

  DragSetup setup_;
  BucketBody bucket_;
  Eigen::AlignedBox3d box_;
  BucketGauge gauge_;
  Haul haul_;
  Sim simulation_;
  Random random_;
  MaterialId rock_, steel_ = 0;
  BedMaking making_;
  Phase phase_ = Phase::empty;
  std::size_t bed_ = 0, wall_ = 0;
  WallMotion laid_;             // of the bucket when it was laid on the bed
  std::optional<double> until_; // s, the end of an interval that is not over
  double winch_start_ = 0.0, last_sample_ = 0.0, next_removal_ = 0.0, lost_at_start_ = 0.0;
  double placed_pitch_ = 0.0;
  Vector start_ = Vector::Zero();
};

} // namespace scree
