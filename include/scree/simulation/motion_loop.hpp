#pragma once
/// \file
/// The loop over bodies: from forces to motion.

#include "scree/integrators/concept.hpp"
#include "scree/simulation/tally.hpp"
#include "scree/state/blocks.hpp"

#include <cmath>
#include <span>

namespace scree {

/// Fetches the forces that earlier blocks laid down for spheres of this one.
template <class Real>
void fetch_forces(const Block& block, std::span<const ForceRecord<Real>> slots, Bodies<Real>& bodies) {
  const auto forces = bodies.forces();
  for (const Block::Incoming& in : block.incoming) {
    forces[in.sphere].force += slots[in.slot].force;
    forces[in.sphere].torque += slots[in.slot].torque;
  }
}

/// Local non-viscous damping of one force or moment component, F_d = -alpha |F| sign(v) (Itasca's PFC
/// manual): takes the component down where it drives the motion and up where it opposes it. Adds the work
/// taken out to `work`.
template <class Real>
Vec3<Real> damped(const Vec3<Real>& force, const Vec3<Real>& velocity, Real alpha, Real kick, Real& work) {
  const auto along = [&](Real f, Real v) {
    const Real d = alpha * std::abs(f);
    work += d * std::abs(v) * kick;
    return v > 0 ? f - d : v < 0 ? f + d : f;
  };
  return {along(force.x, velocity.x), along(force.y, velocity.y), along(force.z, velocity.z)};
}

/// Moves the bodies of a block by one step. Returns the largest speed of a member sphere [m/s]; not a number
/// where one of them is not.
template <class Integrator, bool audit, class Real>
double move_bodies(const Block& block, const TimeStep& step, double local_damping, Bodies<Real>& bodies,
                   Dissipation& lost) {
  const auto spheres = bodies.spheres();
  const auto forces = std::as_const(bodies).forces();
  const Vec3<Real> gravity = to_vec3<Real>(step.gravity);
  const auto alpha = static_cast<Real>(local_damping);
  const auto kick = static_cast<Real>(step.kick);
  const bool damping = local_damping > 0.0;
  Real work = 0;
  double fastest2 = 0.0, poison = 0.0;
  const auto note = [&](const Vec3<Real>& velocity) {
    const auto v2 = static_cast<double>(squared_norm(velocity));
    fastest2 = std::max(fastest2, v2);
    poison += 0.0 * v2; // std::max would lose what is not a number
  };
  for (std::size_t b = block.first_body; b < block.end_body; ++b) {
    const std::size_t first = bodies.first_sphere(b);
    if (bodies.kind(b) == BodyKind::lone) {
      SphereRecord<Real>& sphere = spheres[first];
      Vec3<Real> force = forces[first].force + gravity * (Real{1} / sphere.inverse_mass);
      Vec3<Real> torque = forces[first].torque;
      if (damping) {
        force = damped(force, sphere.velocity, alpha, kick, work);
        torque = damped(torque, sphere.angular_velocity, alpha, kick, work);
      }
      const auto radius = static_cast<Real>(sphere.radius);
      const Real inverse_inertia = Real{2.5} * sphere.inverse_mass / (radius * radius);
      sphere.angular_velocity += torque * (inverse_inertia * kick);
      Integrator::translate(sphere.position, sphere.velocity, force * sphere.inverse_mass, step);
      note(sphere.velocity);
    } else if (bodies.kind(b) == BodyKind::clump) {
      BodyRecord<Real>& body = bodies.record(b);
      Vec3<Real> force = gravity * body.mass;
      Vec3<Real> torque{};
      for (std::size_t s = first; s < bodies.first_sphere(b + 1); ++s) {
        const Vec3<Real> arm = (spheres[s].position - body.position).template as<Real>();
        force += forces[s].force;
        torque += forces[s].torque + cross(arm, forces[s].force);
      }
      if (damping) {
        const Vec3<Real> spin = to_vec3<Real>(body.orientation * to_eigen(body.angular_velocity));
        force = damped(force, body.velocity, alpha, kick, work);
        torque = damped(torque, spin, alpha, kick, work);
      }
      Vector w = to_eigen(body.angular_velocity);
      Integrator::rotate(body.orientation, w, Vector(body.orientation.conjugate() * to_eigen(torque)),
                         to_eigen(body.inertia), step);
      body.angular_velocity = to_vec3<Real>(w);
      Integrator::translate(body.position, body.velocity, force * (Real{1} / body.mass), step);
      bodies.place_members(b, step.dt);
      for (std::size_t s = first; s < bodies.first_sphere(b + 1); ++s) {
        note(spheres[s].velocity);
      }
    }
  }
  if constexpr (audit) {
    lost.local_damping += static_cast<double>(work);
  }
  return std::sqrt(fastest2) + poison;
}

} // namespace scree
