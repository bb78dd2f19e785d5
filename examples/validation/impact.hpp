#pragma once
/// \file
/// A sphere that meets a plane or another sphere, from before the contact to after it.

#include "finding.hpp"
#include "law.hpp"

#include "scree/simulation/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace validation {

struct Ball {
  scree::Material material;
  double radius = 0.0;                                    ///< m
  scree::Vector velocity = scree::Vector::Zero();         ///< m/s; the plane's normal is +z
  scree::Vector angular_velocity = scree::Vector::Zero(); ///< rad/s
};

/// What a ball does after the contact.
struct Rebound {
  scree::Vector velocity, angular_velocity;
};

/// The contact as it goes.
struct ImpactRecord {
  std::vector<double> time, overlap, force; ///< s, m, N along the normal
  double duration = 0.0, greatest_overlap = 0.0, greatest_force = 0.0;
  std::vector<Rebound> after; ///< of each ball
  scree::Dissipation lost;    ///< J, as the laws account for it
};

/// A modulus that is a thousand times the ball's, for a plane that counts as rigid.
inline scree::Material rigid(scree::Material material) {
  material.youngs_modulus *= 1e3;
  material.normal_stiffness *= 1e3;
  material.shear_stiffness *= 1e3;
  return material;
}

/// One ball on a plane of `partner` at z = 0, or two balls of which the second lies below, both just apart at
/// the start.
/// \param steps about how many time steps the contact lasts
template <class Law>
ImpactRecord impact(const std::vector<Ball>& balls, const scree::Material* plane, double duration_guess,
                    int steps = 2000, scree::Stiffness stiffness = scree::Stiffness::of_particle) {
  const double dt = duration_guess / steps;
  scree::Simulation<With<Law>> sim{{.stiffness = stiffness,
                                    .gravity = scree::Vector::Zero(),
                                    .time_step = dt,
                                    .step_safety = 1.0,
                                    .top_speed = 100.0}};
  const auto shape = scree::make_clump("ball", std::vector<scree::Sphere>{{scree::Vector::Zero(), 1.0}});
  double height = 0.0;
  for (std::size_t k = 0; k < balls.size(); ++k) {
    const Ball& ball = balls[k];
    height = k == 0 ? ball.radius : -ball.radius;
    sim.add({.clump = &shape,
             .material = sim.add_material(ball.material),
             .position = {0.0, 0.0, height},
             .velocity = ball.velocity,
             .angular_velocity = ball.angular_velocity,
             .scale = ball.radius});
  }
  if (plane != nullptr) {
    const auto id = sim.add_material(*plane);
    sim.add_wall({.name = "plane", .surfaces = {{scree::Plane{}, id}}, .dynamics = scree::Fixed{}});
  }
  ImpactRecord record;
  bool met = false;
  while (true) {
    sim.step();
    double overlap = 0.0, force = 0.0;
    sim.visit_contacts([&](const scree::ContactView& c) {
      overlap = c.overlap;
      force = c.force.dot(c.normal);
    });
    met = met || overlap > 0.0;
    if (overlap > 0.0) {
      record.time.push_back(sim.time());
      record.overlap.push_back(overlap);
      record.force.push_back(force);
    } else if (met || sim.time() > 20.0 * duration_guess) {
      break;
    }
  }
  if (!record.time.empty()) {
    record.duration = record.time.back() - record.time.front() + dt;
    record.greatest_overlap = *std::max_element(record.overlap.begin(), record.overlap.end());
    record.greatest_force = *std::max_element(record.force.begin(), record.force.end());
  }
  for (std::size_t b = 0; b < sim.bodies().size(); ++b) {
    record.after.push_back({sim.bodies().velocity(b), sim.bodies().angular_velocity(b)});
  }
  record.lost = sim.dissipation();
  return record;
}

/// kg
inline double mass_of(const Ball& ball) {
  return 4.0 / 3.0 * std::numbers::pi * std::pow(ball.radius, 3) * ball.material.density;
}

/// E* of Hertz [Pa].
inline double effective_modulus(const scree::Material& a, const scree::Material& b) {
  const auto part = [](const scree::Material& m) {
    return (1.0 - m.poisson_ratio * m.poisson_ratio) / m.youngs_modulus;
  };
  return 1.0 / (part(a) + part(b));
}

/// Hertz's closed form of an elastic normal impact.
struct HertzImpact {
  double greatest_overlap, greatest_force, duration;

  /// \param modulus Pa, effective; \param radius m, reduced; \param mass kg, reduced; \param speed m/s
  HertzImpact(double modulus, double radius, double mass, double speed)
      : greatest_overlap{std::pow(15.0 / 16.0 * mass * speed * speed / (modulus * std::sqrt(radius)), 0.4)},
        greatest_force{4.0 / 3.0 * modulus * std::sqrt(radius) * std::pow(greatest_overlap, 1.5)},
        // 4/5 B(2/5, 1/2) U / v
        duration{2.943275 * greatest_overlap / speed} {}
};

/// Of what rigid bodies say of an impact that slides throughout.
/// \param arm share by which friction's arm is shorter at the deepest: half the overlap over the radius
inline Tolerance sliding_tolerance(double arm = 0.0) {
  return {1e-3 + arm, true,
          arm > 0.0
              ? "stretch of the tangential spring before it slides, 1/1000 (ours), and half the overlap "
                "off friction's arm"
              : "stretch of the tangential spring before it slides, 1/1000 (ours)"};
}

} // namespace validation
