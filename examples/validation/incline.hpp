#pragma once
/// \file
/// Bodies on an incline: a plane and gravity that is tilted to it.

#include "impact.hpp"
#include "law.hpp"

#include "scree/simulation/simulation.hpp"

#include <cmath>
#include <vector>

namespace validation {

/// What cases of an incline share.
namespace incline {

inline constexpr double radius = 0.01, g = 9.81;

/// Ours, as the results do not depend on it but by the overlap, 1e-4 r by both laws.
inline scree::Material stone(double friction, double rolling_friction = 0.0) {
  return {.density = 2650,
          .normal_stiffness = 1e5,
          .shear_stiffness = 8e4,
          .youngs_modulus = 2e9,
          .poisson_ratio = 0.25,
          .friction = friction,
          .restitution = 0.3, // the springs come to rest within some 10 ms
          .rolling_friction = rolling_friction};
}

/// Bodies on the plane z = 0, whose slope is in the direction of gravity.
template <class Law>
struct Incline {
  scree::Simulation<With<Law>> sim;
  scree::Clump shape;

  Incline(const scree::Material& material, const std::vector<scree::Sphere>& spheres, const Law& law = {})
      : sim{{.contact = law,
             .stiffness = scree::Stiffness::of_contact,
             .gravity = {0.0, 0.0, -g},
             .time_step = 1e-5,
             .top_speed = 0.05}},
        shape{scree::make_clump("body", spheres)} {
    const auto id = sim.add_material(material);
    sim.add_wall({.name = "incline", .surfaces = {{scree::Plane{}, id}}, .dynamics = scree::Fixed{}});
    const double depth = overlap(material, 0.0);
    sim.add({.clump = &shape, .material = id, .position = {0.0, 0.0, radius - depth}});
  }

  /// m, of each sphere at rest, where the normal is turned by `angle` from gravity.
  [[nodiscard]] double overlap(const scree::Material& material, double angle) const {
    const double load =
        material.density * shape.volume * g * std::cos(angle) / static_cast<double>(shape.spheres.size());
    if constexpr (!is_hertz<Law>) {
      return load / material.normal_stiffness;
    }
    return std::pow(0.75 * load / (effective_modulus(material, material) * std::sqrt(radius)), 2.0 / 3.0);
  }

  void tilt(double angle) { sim.set_gravity(g * scree::Vector{std::sin(angle), 0.0, -std::cos(angle)}); }
  /// Tilts without a jerk in 0.3 s, so that springs and friction carry what they can carry at rest.
  void raise(double angle) {
    constexpr double duration = 0.3;
    const double begin = sim.time();
    while (sim.time() < begin + duration) {
      const double s = (sim.time() - begin) / duration;
      tilt(angle * s * s * s * (10.0 - 15.0 * s + 6.0 * s * s));
      sim.step();
    }
    tilt(angle);
  }
  void run(double duration) {
    const double end = sim.time() + duration;
    while (sim.time() < end) {
      sim.step();
    }
  }
  [[nodiscard]] double speed() const { return sim.bodies().velocity(0).x(); }
  [[nodiscard]] double spin() const { return sim.bodies().angular_velocity(0).y(); }
};

inline const std::vector<scree::Sphere> ball{{scree::Vector::Zero(), radius}};

/// How a body is sped up once its springs are at rest.
struct Speeding {
  double linear, angular; ///< m/s2, rad/s2
  double rolling;         ///< r w / v at the end
};

template <class Law>
Speeding speed_up(Incline<Law>& incline, double settling = 0.1, double duration = 0.1) {
  incline.run(settling);
  const double time = incline.sim.time(), v = incline.speed(), w = incline.spin();
  incline.run(duration);
  const double passed = incline.sim.time() - time;
  return {(incline.speed() - v) / passed, (incline.spin() - w) / passed,
          radius * incline.spin() / incline.speed()};
}

/// The place between `low` and `high` where `above` begins to hold.
template <class Predicate>
double threshold(double low, double high, Predicate above) {
  for (int k = 0; k < 12; ++k) {
    const double middle = 0.5 * (low + high);
    (above(middle) ? high : low) = middle;
  }
  return 0.5 * (low + high);
}

} // namespace incline

} // namespace validation
