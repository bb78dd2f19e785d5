#pragma once
/// \file
/// Bodies that rest are left alone until the forces on them ask for motion.

#include "scree/core/error.hpp"
#include "scree/core/parallel.hpp"
#include "scree/state/blocks.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace scree {

/// Every free body is stepped in every step.
struct AllAwake {
  static constexpr bool rests = false;
};

/// Takes bodies out of the time step that have come to rest, with the pairs and forces between them.
///
///     struct Digging : scree::DefaultModel {
///       using Rest = scree::RestingRegions;
///     };
///     scree::Simulation<Digging> simulation{{.rest = {.speed = 1.5e-3}}};
///
/// A body rests when in a whole window it has come less far than `speed` allows (centre and surface), and the
/// resultant of its contacts and gravity is below half of `force` of the sum of their normal forces, its
/// moment below that times the bounding radius. It then has no velocity, and its contacts with other resting
/// bodies keep their forces. It wakes when the resultant comes above `force`, at the next look. So the error
/// is bounded: what is missed of a body's motion is slower than `speed`, and the forces on a resting body are
/// off balance by no more than `force` of what presses it, but for what a few steps bring. Bodies that touch
/// a wall that is not `Fixed` never rest. Whatever changes the simulation from outside wakes all.
///
/// The manner is that of the sleeping islands of game physics and of adaptive sparse contacts; the criteria
/// and all defaults are ours.
struct RestingRegions {
  static constexpr bool rests = true;

  double speed = 0.0;          ///< m/s; 0: nothing rests; one hundredth of a tool's speed is a good one
  double force = 0.05;         ///< of the sum of the normal forces on a body, in (0, 1)
  std::uint64_t window = 500;  ///< steps over which motion is measured, a multiple of the interval
  std::uint64_t interval = 10; ///< steps between two looks at the forces on resting bodies, above 0

  /// \throws Error for a field out of its range.
  void check() const {
    require("rest.speed", speed, {0.0, std::numeric_limits<double>::max(), "m/s"});
    require("rest.force", force, {1e-9, 1.0});
    if (interval == 0) {
      throw Error("rest.interval = 0 is out of its range, at least 1 step");
    }
    if (window == 0 || window % interval != 0) {
      throw Error(
          message("rest.window = ", window, " steps must be a multiple of rest.interval = ", interval));
    }
  }
};

namespace detail {

/// Follows which bodies rest.
template <class Real>
class RestKeeper {
public:
  explicit RestKeeper(const RestingRegions& rule) { set_rule(rule); }

  void set_rule(const RestingRegions& rule) {
    rule.check();
    rule_ = rule;
  }

  /// Free bodies that rest.
  [[nodiscard]] std::size_t count() const { return count_; }
  /// J, kinetic energy taken from bodies that were put to rest in the last look.
  [[nodiscard]] double taken() const { return taken_; }
  [[nodiscard]] bool due(std::size_t step) const { return rule_.speed > 0.0 && step % rule_.interval == 0; }

  /// Marks those that settle and wake, from the forces of the last step; settling ones are stopped. To be
  /// followed by `changed_over` where it returns true.
  /// \param disturbed for each body, whether it touches a wall that may move; empty where none does
  bool look(std::size_t step, double dt, const Vector& gravity, std::span<const std::uint8_t> disturbed,
            std::span<const Block> blocks, Workers& workers, Bodies<Real>& bodies) {
    const bool end = step % rule_.window == 0;
    const Window window{end, end && step == window_begun_ + rule_.window,
                        static_cast<double>(rule_.window) * dt};
    if (end) {
      window_begun_ = step;
      for (std::size_t b = 0; b < bodies.size(); ++b) {
        seen_.resize(std::max(seen_.size(), static_cast<std::size_t>(bodies.id(b)) + 1));
      }
    }
    std::vector<Found> found(blocks.size());
    workers.for_each(blocks.size(), [&](std::size_t k) {
      for (std::size_t b = blocks[k].first_body; b < blocks[k].end_body; ++b) {
        if (!bodies.is_fixed(b)) {
          look_at(b, window, gravity, !disturbed.empty() && disturbed[b] != 0, bodies, found[k]);
        }
      }
    });
    taken_ = 0.0;
    bool change = false;
    for (const Found& f : found) {
      count_ = count_ + f.settled - f.woken;
      taken_ += f.taken;
      change = change || f.settled > 0 || f.woken > 0;
    }
    return change;
  }

  /// Says that the pairs have been dealt out anew.
  static void changed_over(Bodies<Real>& bodies) {
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      if (bodies.activity(b) == Activity::settling) {
        bodies.set_activity(b, Activity::resting);
      } else if (bodies.activity(b) == Activity::waking) {
        bodies.set_activity(b, Activity::fresh);
      }
    }
  }

  /// Wakes all, before the lists are made anew.
  void wake_all(Bodies<Real>& bodies) {
    if (count_ == 0) {
      return;
    }
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      if (!bodies.is_fixed(b)) {
        bodies.set_activity(b, Activity::fresh);
      }
    }
    const auto held = bodies.held_forces();
    std::fill(held.begin(), held.end(), ForceRecord<Real>{});
    count_ = 0;
  }

  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {
    archive(self.seen_, self.window_begun_, self.count_);
  }

private:
  /// Where a body was.
  struct Place {
    Vec3<double> position;
    Quat<double> orientation;
  };

  struct Window {
    bool ends;
    bool whole;  // no step of it was left out
    double time; // s
  };
  /// In one block.
  struct Found {
    std::size_t settled = 0, woken = 0;
    double taken = 0.0;
  };

  void look_at(std::size_t b, const Window& window, const Vector& gravity, bool disturbed,
               Bodies<Real>& bodies, Found& found) {
    const Activity now = bodies.activity(b);
    if (now == Activity::resting) {
      if (disturbed || !balanced(bodies, b, gravity, rule_.force)) {
        bodies.set_activity(b, Activity::waking);
        ++found.woken;
      }
      return;
    }
    if (!window.ends) {
      return;
    }
    Place& seen = seen_[static_cast<std::size_t>(bodies.id(b))];
    if (window.whole && now == Activity::awake && !disturbed &&
        way(bodies, b, seen, window.time) < rule_.speed * window.time &&
        balanced(bodies, b, gravity, 0.5 * rule_.force)) {
      found.taken += bodies.kinetic_energy(b);
      bodies.stop(b);
      bodies.set_activity(b, Activity::settling);
      ++found.settled;
      return;
    }
    seen = {to_vec3(bodies.position(b)), to_quat(bodies.orientation(b))};
    bodies.set_activity(b, Activity::awake);
  }

  /// m, by which a point of the body has come at most since it was seen. The orientation of a lone sphere is
  /// not followed: it is taken to have turned at its present speed for `time` [s].
  static double way(const Bodies<Real>& bodies, std::size_t b, const Place& seen, double time) {
    const double shift = (bodies.position(b) - to_eigen(seen.position)).norm();
    const double angle = bodies.kind(b) == BodyKind::lone
                             ? bodies.angular_velocity(b).norm() * time
                             : bodies.orientation(b).angularDistance(to_eigen(seen.orientation));
    return shift + angle * bodies.bounding_radius(b);
  }

  /// Whether contacts and gravity balance to a share of what presses the body.
  static bool balanced(const Bodies<Real>& bodies, std::size_t b, const Vector& gravity, double share) {
    const Vector centre = bodies.position(b);
    Vector force = bodies.mass(b) * gravity, moment = Vector::Zero();
    double pressed = 0.0;
    for (std::size_t s = bodies.first_sphere(b); s < bodies.first_sphere(b + 1); ++s) {
      const ForceRecord<Real>& on = bodies.forces()[s];
      const Vector f = to_eigen(on.force);
      force += f;
      moment += to_eigen(on.torque) + (to_eigen(bodies.spheres()[s].position) - centre).cross(f);
      pressed += static_cast<double>(on.pressed);
    }
    return force.norm() < share * pressed && moment.norm() < share * pressed * bodies.bounding_radius(b);
  }

  RestingRegions rule_;
  std::vector<Place> seen_; // at the begin of the window, by the bodies' ids
  std::size_t window_begun_ = 0;
  std::size_t count_ = 0;
  double taken_ = 0.0;
};

/// Follows nothing.
template <class Real>
struct NoRest {
  explicit NoRest(const AllAwake&) {}
  static void set_rule(const AllAwake&) {}
  [[nodiscard]] static std::size_t count() { return 0; }
  static void wake_all(const Bodies<Real>&) {}
  template <class Self, class Archive>
  static void fields(Self&, Archive&) {}
};

template <class Real>
RestKeeper<Real> keeper_of(const RestingRegions&);
template <class Real>
NoRest<Real> keeper_of(const AllAwake&);

} // namespace detail

} // namespace scree
