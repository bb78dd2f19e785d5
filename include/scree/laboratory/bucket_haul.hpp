#pragma once
/// \file
/// What moves the bucket of a dragline experiment: ropes, or a path that it is made to follow.
///
/// A haul offers
///
///     // Refuses a setup that it cannot work with.
///     void check(const DragSetup& setup) const;
///     // How the bucket moves from when it is laid on the bed; the winch starts at `start` [s].
///     RopeCoupled laid(const DragSetup& setup, const BucketBody& bucket, const WallMotion& motion,
///                      double start) const;
///     // Called when the winch starts, with the bucket at rest as wall `wall`; `start` as before.
///     void begin(Simulation& simulation, std::size_t wall, const DragSetup& setup,
///                const BucketBody& bucket, double start);
///     // Called instead of `begin` where the winch has started in a run that was read, before the walls are.
///     void go_on(Simulation& simulation, const DragSetup& setup, const BucketBody& bucket);
///     // What it keeps of a run (core/archive.hpp).
///     static void fields(Self& self, Archive& archive);
///     // Called after every step of `dt` [s] from then on.
///     void observe(const Simulation& simulation, double dt);
///     // What it pulled with since the last call, which was `span` [s] ago.
///     HaulForce take(const Simulation& simulation, double span);
///     // J, of the bucket.
///     double kinetic_energy(const Simulation& simulation) const;

#include "scree/laboratory/bucket_path.hpp"
#include "scree/laboratory/drag_setup.hpp"
#include "scree/measure/attitude.hpp"
#include "scree/walls/prescribed.hpp"
#include "scree/walls/rope_coupled.hpp"

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace scree {

/// N, means.
struct HaulForce {
  double total = 0.0;
  double left = 0.0, right = 0.0; ///< of the ropes, 0 without
  double lift = 0.0;              ///< upwards, beside the weight of the bucket
};

/// Two ropes from the bucket's hitches to a winch: the bucket finds its own path.
class RopeHaul {
public:
  void check(const DragSetup& setup) const {
    require_positive("winch_distance", setup.winch_distance, "m");
    if (setup.winch_distance < setup.drag_distance * 1.05) {
      throw Error(message("winch_distance = ", setup.winch_distance, " m must exceed the drag distance ",
                          setup.drag_distance, " m by 5 % or more"));
    }
  }

  [[nodiscard]] RopeCoupled laid(const DragSetup& setup, const BucketBody& bucket, const WallMotion& motion,
                                 double start) const {
    std::vector<Rope> ropes;
    const std::array<const char*, 2> names{"left", "right"};
    for (std::size_t k = 0; k < 2; ++k) {
      const Vector hitch = motion.to_space(bucket.hitches[k]);
      ropes.push_back({.name = names[k],
                       .hitch = bucket.hitches[k],
                       .winch = {hitch.x() + setup.winch_distance, hitch.y(), setup.winch_height},
                       .stiffness = setup.rope_stiffness,
                       .damping = setup.rope_damping,
                       // It hangs loose while the bucket sinks to its rest, and is hauled taut at the start.
                       .wound = [setup, start](double time) { return setup.wound(time - start); }});
    }
    return RopeCoupled{bucket.body, std::move(ropes)};
  }

  template <class Simulation>
  void begin(Simulation& simulation, std::size_t wall, const DragSetup&, const BucketBody&, double) {
    wall_ = wall;
    lifted_ = lift(simulation);
  }

  template <class Simulation>
  static void go_on(Simulation&, const DragSetup&, const BucketBody&) {} // ropes are the wall's own

  template <class Simulation>
  void observe(const Simulation& simulation, double dt) {
    for (std::size_t k = 0; k < 2; ++k) {
      pulled_[k] += ropes(simulation)[k].tension * dt;
    }
  }

  template <class Simulation>
  [[nodiscard]] HaulForce take(const Simulation& simulation, double span) {
    const auto mean = [&](std::size_t k) {
      return span > 0.0 ? pulled_[k] / span : ropes(simulation)[k].tension;
    };
    HaulForce out{.left = mean(0), .right = mean(1)};
    out.total = out.left + out.right;
    const double lifted = std::exchange(lifted_, lift(simulation));
    out.lift = span > 0.0 ? (lifted_ - lifted) / span : 0.0;
    pulled_ = {};
    return out;
  }

  template <class Simulation>
  [[nodiscard]] double kinetic_energy(const Simulation& simulation) const {
    return simulation.template dynamics<RopeCoupled>(wall_).kinetic_energy();
  }

  template <class Simulation>
  [[nodiscard]] const std::vector<Rope>& ropes(const Simulation& simulation) const {
    return simulation.template dynamics<RopeCoupled>(wall_).ropes();
  }

  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {
    archive(self.wall_, self.pulled_, self.lifted_);
  }

private:
  /// N s, since the start.
  template <class Simulation>
  [[nodiscard]] double lift(const Simulation& simulation) const {
    return ropes(simulation)[0].impulse.z() + ropes(simulation)[1].impulse.z();
  }

  std::size_t wall_ = 0;
  std::array<double, 2> pulled_{}; // N s
  double lifted_ = 0.0;            // N s
};

/// The bucket lies free on the bed until the winch starts, and then is made to follow a path, as fast as the
/// winch would wind in, whatever the rock does to it. It keeps the roll and yaw of its rest. Its force is
/// what that takes along the bed; a lift far from what ropes could give says that a free bucket would not go
/// this way. The model's walls must list Prescribed.
class PathHaul {
public:
  explicit PathHaul(BucketPath path) : path_{std::move(path)} {}

  void check(const DragSetup& setup) const {
    if (path_.length() < setup.drag_distance) {
      throw Error(message("bucket path: ends at a drag of ", path_.length(),
                          " m, before drag_distance = ", setup.drag_distance, " m"));
    }
  }

  [[nodiscard]] RopeCoupled laid(const DragSetup&, const BucketBody& bucket, const WallMotion&,
                                 double) const {
    return RopeCoupled{bucket.body};
  }

  template <class Simulation>
  void begin(Simulation& simulation, std::size_t wall, const DragSetup& setup, const BucketBody& bucket,
             double start) {
    wall_ = wall;
    start_ = start;
    const WallMotion& rest = simulation.wall(wall).motion;
    from_ = rest.to_space(bucket.body.centre);
    placed_ = attitude(rest.orientation);
    go_on(simulation, setup, bucket);
    before_ = received(simulation);
  }

  template <class Simulation>
  void go_on(Simulation& simulation, const DragSetup& setup, const BucketBody& bucket) {
    body_ = bucket.body;
    gravity_ = setup.gravity();
    simulation.set_dynamics(
        wall_, Prescribed{[setup, path = path_, start = start_, centre = body_.centre, from = from_,
                           placed = placed_](double time) {
          const PathPoint now = path.at(setup.wound(time - start));
          Attitude turned = placed;
          turned.pitch += now.pitch;
          Pose out{.orientation = orientation(turned)};
          out.position = from + Vector{now.drag, 0.0, -now.depth} - out.orientation * centre;
          return out;
        }});
  }

  template <class Simulation>
  void observe(const Simulation&, double) const {}

  /// By the balance of momentum: what the bucket has more of it than rock and weight gave.
  template <class Simulation>
  [[nodiscard]] HaulForce take(const Simulation& simulation, double span) {
    const Vector before = std::exchange(before_, received(simulation));
    if (!(span > 0.0)) {
      return {};
    }
    const Vector force = (before_ - before) / span - body_.mass * gravity_;
    return {.total = force.x(), .lift = force.z()};
  }

  template <class Simulation>
  [[nodiscard]] double kinetic_energy(const Simulation& simulation) const {
    const WallMotion& motion = simulation.wall(wall_).motion;
    const Vector spin = motion.orientation.conjugate() * motion.angular_velocity;
    return 0.5 * body_.mass * velocity(motion).squaredNorm() + 0.5 * spin.dot(body_.inertia * spin);
  }

  /// The path is the one that it was made with.
  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {
    archive(self.wall_, self.start_, self.from_, self.placed_.pitch, self.placed_.roll, self.placed_.yaw,
            self.before_);
  }

private:
  [[nodiscard]] Vector velocity(const WallMotion& motion) const {
    return motion.velocity_at(motion.to_space(body_.centre));
  }
  /// N s, momentum less what the rock has given; by weight and haul.
  template <class Simulation>
  [[nodiscard]] Vector received(const Simulation& simulation) const {
    const auto& wall = simulation.wall(wall_);
    return body_.mass * velocity(wall.motion) - wall.load.impulse;
  }

  BucketPath path_;
  std::size_t wall_ = 0;
  MassProperties body_{};
  Vector gravity_ = Vector::Zero();
  double start_ = 0.0;           // s, of the winch
  Vector from_ = Vector::Zero(); // m, of the centre of mass, then
  Attitude placed_{};            // then
  Vector before_ = Vector::Zero();
};

} // namespace scree
