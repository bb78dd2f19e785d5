#pragma once
/// \file
/// The loop over bodies: from forces to motion.

#include "scree/core/pack_rows.hpp"
#include "scree/integrators/concept.hpp"
#include "scree/simulation/tally.hpp"
#include "scree/state/blocks.hpp"
#include "scree/state/placement.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

namespace scree {

/// Fetches the forces that earlier blocks laid down for spheres of this one.
template <class Real>
void fetch_forces(const Block& block, std::span<const ForceRecord<Real>> slots, Bodies<Real>& bodies) {
  const auto forces = bodies.forces();
  for (const Block::Incoming& in : block.incoming) {
    forces[in.sphere] += slots[in.slot];
  }
}

namespace detail {

/// Local non-viscous damping of one force or moment component, F_d = -alpha |F| sign(v) (Itasca's PFC
/// manual): takes the component down where it drives the motion and up where it opposes it.
template <class T>
class LocalDamping {
public:
  LocalDamping(double alpha, double kick) : alpha_(alpha), kick_(kick), on_{alpha > 0.0} {}

  [[nodiscard]] bool on() const { return on_; }
  void damp(Vec3<T>& force, const Vec3<T>& velocity) {
    force = {along(force.x, velocity.x), along(force.y, velocity.y), along(force.z, velocity.z)};
  }
  /// J, taken out of the motion since the last call.
  T taken() { return std::exchange(work_, T(0)); }

private:
  T along(const T& f, const T& v) {
    const T d = alpha_ * larger(f, -f);
    work_ += d * larger(v, -v) * kick_;
    return select(v > T(0), f - d, select(v < T(0), f + d, f));
  }

  T alpha_, kick_, work_ = T(0);
  bool on_;
};

/// Moves bodies by one step, as many at a time as T has lanes.
template <class T, class Integrator, class Real>
class MotionLoop {
  static constexpr std::size_t width = Lanes<T>::width;

public:
  MotionLoop(const TimeStep& step, double local_damping, Bodies<Real>& bodies)
      : step_{step},
        gravity_{to_vec3(step.gravity)},
        lone_damping_{local_damping, step.kick},
        damping_{local_damping, step.kick},
        bodies_{bodies} {}

  void move(const Block& block) {
    Batch clumps;
    for (std::size_t b = block.first_body; b < block.end_body; ++b) {
      if (at_rest(bodies_.activity(b))) {
        continue;
      }
      switch (bodies_.kind(b)) {
      case BodyKind::lone:
        move_lone(b);
        break;
      case BodyKind::clump:
        clumps.add(bodies_, b);
        if (clumps.size == width) {
          move_clumps(std::exchange(clumps, {}));
        }
        break;
      case BodyKind::fixed:
        break;
      }
    }
    if (clumps.size > 0) {
      clumps.fill();
      move_clumps(clumps);
    }
  }

  /// m/s, the largest speed of a sphere; not a number where one of them is not.
  [[nodiscard]] double fastest() const {
    const auto most_of = numbers(speeds_.most), poison_of = numbers(speeds_.poison);
    double most = lone_speeds_.most, poison = lone_speeds_.poison;
    for (std::size_t lane = 0; lane < width; ++lane) {
      most = std::max(most, most_of[lane]);
      poison += poison_of[lane];
    }
    return std::sqrt(most) + poison;
  }
  /// J, that local damping took.
  [[nodiscard]] double damped() const { return damped_; }

private:
  /// Clumps that are moved together. Lanes left over hold the last of them once more.
  struct Batch {
    std::array<std::size_t, width> body{}, first{}, count{}; // spheres
    std::size_t size = 0, most = 0;

    void add(const Bodies<Real>& bodies, std::size_t b) {
      body[size] = b;
      first[size] = bodies.first_sphere(b);
      count[size] = bodies.first_sphere(b + 1) - first[size];
      most = std::max(most, count[size]);
      ++size;
    }
    void fill() {
      for (std::size_t lane = size; lane < width; ++lane) {
        body[lane] = body[size - 1];
        first[lane] = first[size - 1];
        count[lane] = count[size - 1];
      }
    }
    /// k, or 0 where a clump has no such sphere.
    [[nodiscard]] std::size_t member(std::size_t lane, std::size_t k) const {
      return k < count[lane] ? k : 0;
    }
    [[nodiscard]] std::size_t sphere(std::size_t lane, std::size_t k) const {
      return first[lane] + member(lane, k);
    }
  };

  template <class Number>
  struct Speeds {
    Number most = Number(0), poison = Number(0); // m2/s2
    void add(const Vec3<Number>& velocity) {
      const Number v2 = squared_norm(velocity);
      most = larger(v2, most);
      poison += Number(0) * v2; // the larger one would lose what is not a number
    }
  };

  static RowsOfFour<T> rows(const Vec3<T>& v) { return RowsOfFour<T>{{v.x, v.y, v.z, T(0)}}; }

  static std::array<double, width> numbers(const T& value) {
    std::array<double, width> lanes;
    Lanes<T>::store(value, lanes.data());
    return lanes;
  }

  void move_lone(std::size_t b) {
    const std::size_t s = bodies_.first_sphere(b);
    SphereRecord<Real>& sphere = bodies_.spheres()[s];
    const ForceRecord<Real>& load = std::as_const(bodies_).forces()[s];
    const auto inverse_mass = static_cast<double>(sphere.inverse_mass);
    Vec3<double> velocity = sphere.velocity.template as<double>();
    Vec3<double> spin = sphere.angular_velocity.template as<double>();
    Vec3<double> force = multiply_add(gravity_, 1.0 / inverse_mass, load.force.template as<double>());
    Vec3<double> torque = load.torque.template as<double>();
    if (lone_damping_.on()) {
      lone_damping_.damp(force, velocity);
      lone_damping_.damp(torque, spin);
      damped_ += lone_damping_.taken();
    }
    spin = multiply_add(torque, 2.5 * inverse_mass / (sphere.radius * sphere.radius) * step_.kick, spin);
    Integrator::translate(sphere.position, velocity, force * inverse_mass, step_);
    sphere.velocity = velocity.template as<Real>();
    sphere.angular_velocity = spin.template as<Real>();
    lone_speeds_.add(velocity);
  }

  /// All that it calls is to be inlined: packs that cross a call go through memory.
  [[gnu::flatten]] void move_clumps(const Batch& batch) {
    const auto row = [&](auto field) {
      return fields_of<T>([&](std::size_t lane) { return field(bodies_.record(batch.body[lane])); });
    };
    const auto vector = [](const Fields<T>& f) { return Vec3<T>{f[0], f[1], f[2]}; };
    Vec3<T> position = vector(row([](auto& body) { return &body.position.x; }));
    const Fields<T> turn = row([](auto& body) { return &body.orientation.x; });
    const Fields<T> moving = row([](auto& body) { return &body.velocity.x; });
    Vec3<T> w = vector(row([](auto& body) { return &body.angular_velocity.x; }));
    const Vec3<T> inertia = vector(row([](auto& body) { return &body.inertia.x; }));
    Quat<T> orientation{turn[0], turn[1], turn[2], turn[3]};
    Vec3<T> velocity = vector(moving);
    const T mass = moving[3];

    auto [force, torque] = load(batch, position);
    force = multiply_add(Vec3<T>{T(gravity_.x), T(gravity_.y), T(gravity_.z)}, mass, force);
    const Axes<T> before = axes_of(orientation);
    if (damping_.on()) {
      damping_.damp(force, velocity);
      damping_.damp(torque, before.to_space(w));
      add_damped(damping_.taken(), batch.size);
    }
    Integrator::rotate(orientation, w, before.to_frame(torque), inertia, step_);
    Integrator::translate(position, velocity, force * (T(1) / mass), step_);

    const RowsOfFour<T> positions = rows(position), velocities = rows(velocity), spins = rows(w);
    const RowsOfFour<T> orientations{{orientation.x, orientation.y, orientation.z, orientation.w}};
    for_each_lane<T>([&](auto lane) {
      if (lane < batch.size) {
        BodyRecord<Real>& body = bodies_.record(batch.body[lane]);
        positions.template store_three<lane>(&body.position.x);
        orientations.template store<lane>(&body.orientation.x);
        velocities.template store_three<lane>(&body.velocity.x);
        spins.template store_three<lane>(&body.angular_velocity.x);
      }
    });
    place(batch, position, velocity, axes_of(orientation), w);
  }

  struct Load {
    Vec3<T> force{T(0), T(0), T(0)}, torque{T(0), T(0), T(0)};
  };

  /// Of all members, about the centre of mass.
  Load load(const Batch& batch, const Vec3<T>& centre) const {
    const auto spheres = std::as_const(bodies_).spheres();
    const auto forces = std::as_const(bodies_).forces();
    Load sum;
    for (std::size_t k = 0; k < batch.most; ++k) {
      const auto own =
          Lanes<T>::generated([&](std::size_t lane) { return k < batch.count[lane] ? 1.0 : 0.0; });
      const auto kept = [&, is = own > T(0)](const Fields<T>& f) {
        return Vec3<T>{select(is, f[0], T(0)), select(is, f[1], T(0)), select(is, f[2], T(0))};
      };
      const auto x =
          fields_of<T>([&](std::size_t lane) { return &spheres[batch.sphere(lane, k)].position.x; });
      const Vec3<T> f =
          kept(fields_of<T>([&](std::size_t lane) { return &forces[batch.sphere(lane, k)].force.x; }));
      const Vec3<T> m =
          kept(fields_of<T>([&](std::size_t lane) { return &forces[batch.sphere(lane, k)].torque.x; }));
      sum.force += f;
      sum.torque += m + cross(Vec3<T>{x[0], x[1], x[2]} - centre, f);
    }
    return sum;
  }

  void place(const Batch& batch, const Vec3<T>& centre, const Vec3<T>& velocity, const Axes<T>& axes,
             const Vec3<T>& spin_in_frame) {
    const auto spheres = bodies_.spheres();
    const Vec3<T> w = axes.to_space(spin_in_frame);
    const RowsOfFour<T> spins = rows(w);
    for (std::size_t k = 0; k < batch.most; ++k) {
      const auto offset = fields_of<T>([&](std::size_t lane) {
        return &bodies_.member(batch.body[lane], batch.member(lane, k)).offset.x;
      });
      const Placed<T> at = placed({offset[0], offset[1], offset[2]}, axes, w, step_.dt);
      const Vec3<T> sphere_velocity = velocity + at.velocity;
      speeds_.add(sphere_velocity);
      const RowsOfFour<T> positions = rows(centre + at.arm), velocities = rows(sphere_velocity);
      for_each_lane<T>([&](auto lane) {
        if (lane < batch.size && k < batch.count[lane]) {
          SphereRecord<Real>& sphere = spheres[batch.first[lane] + k];
          positions.template store_three<lane>(&sphere.position.x);
          velocities.template store_three<lane>(&sphere.velocity.x);
          spins.template store_three<lane>(&sphere.angular_velocity.x);
        }
      });
    }
  }

  /// Of the first `size` lanes.
  void add_damped(const T& work, std::size_t size) {
    const auto lanes = numbers(work);
    for (std::size_t lane = 0; lane < size; ++lane) {
      damped_ += lanes[lane];
    }
  }

  const TimeStep& step_;
  Vec3<double> gravity_; // m/s2
  LocalDamping<double> lone_damping_;
  LocalDamping<T> damping_;
  Bodies<Real>& bodies_;
  Speeds<double> lone_speeds_;
  Speeds<T> speeds_;
  double damped_ = 0.0;
};

} // namespace detail

/// Moves the bodies of a block by one step. Returns the largest speed of a member sphere [m/s]; not a number
/// where one of them is not.
template <class Integrator, bool audit, class Real>
double move_bodies(const Block& block, const TimeStep& step, double local_damping, Bodies<Real>& bodies,
                   Dissipation& lost) {
  detail::MotionLoop<MotionNumber<Integrator>, Integrator, Real> loop{step, local_damping, bodies};
  loop.move(block);
  if constexpr (audit) {
    lost.local_damping += loop.damped();
  }
  return loop.fastest();
}

} // namespace scree
