#pragma once
/// \file
/// The loop over pairs of grains: where the time goes.

#include "scree/contact/concept.hpp"
#include "scree/core/numeric.hpp"
#include "scree/simulation/domain.hpp"
#include "scree/simulation/tally.hpp"
#include "scree/state/blocks.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

namespace scree {

/// A touching pair as its law sees it, and the levers of the contact point.
template <class Real>
struct Touch {
  Kinematics<Real> kinematics;
  Real arm_i, arm_j; ///< m, from the centres to the contact point, in the middle of the overlap
};

/// The kinematics of two spheres whose centres are `apart` (i minus j) at a distance below the sum of the
/// radii.
///
/// One contact fills the window in which a processor looks ahead, so it takes as long as its longest chain of
/// dependent operations. What can start from the squared distance therefore does not wait for the root.
template <class Real>
[[gnu::always_inline]] inline Touch<Real> touch_of(const SphereRecord<Real>& i, const SphereRecord<Real>& j,
                                                   const Vec3<double>& apart, double squared_distance,
                                                   Real dt) {
  const double inverse_square = 1.0 / squared_distance;
  const double distance = std::sqrt(squared_distance);
  const double difference = i.radius - j.radius;
  Touch<Real> out;
  Kinematics<Real>& k = out.kinematics;
  k.normal = (apart * (distance * inverse_square)).template as<Real>();
  k.overlap = static_cast<Real>(i.radius + j.radius - distance);
  out.arm_i = static_cast<Real>(0.5 * (distance + difference));
  out.arm_j = static_cast<Real>(0.5 * (distance - difference));
  k.spin_i = i.angular_velocity;
  k.spin_j = j.angular_velocity;
  const Vec3<Real> velocity = i.velocity - j.velocity;
  const Vec3<Real> spins = k.spin_i + k.spin_j;
  // spin_i arm_i + spin_j arm_j
  const Vec3<Real> rim =
      (k.spin_i - k.spin_j) * static_cast<Real>(0.5 * difference) + spins * static_cast<Real>(0.5 * distance);
  k.velocity = velocity - cross(rim, k.normal);
  // The normal tilts as the centres pass each other; about it the contact turns with the mean spin.
  const auto line = apart.template as<Real>();
  k.turn = (cross(line, velocity) + line * (Real(0.5) * dot(spins, line))) *
           (static_cast<Real>(inverse_square) * dt);
  k.reduced_radius = static_cast<Real>(i.radius * j.radius / (i.radius + j.radius));
  k.reduced_mass = Real{1} / (i.inverse_mass + j.inverse_mass);
  k.dt = dt;
  return out;
}

/// Begins to load a record that will be read soon.
template <class Record>
void prefetch(const Record& record) {
#if defined(__GNUC__)
  const auto* begin = reinterpret_cast<const char*>(&record);
  for (std::size_t line = 0; line < sizeof(Record); line += 64) {
    __builtin_prefetch(begin + line);
  }
#else
  (void)record;
#endif
}

/// Adds the forces of all pairs whose first sphere is in `block` to the spheres of the block; those on
/// spheres of later blocks go to `slots`. `pair_material(a, b)` gives the constants of two materials.
template <bool periodic, bool audit, ContactLaw Law, class Real, class PairMaterials>
void add_pair_forces(const Block& block, const Law& law, const PairMaterials& pair_material,
                     const Domain& domain, Real dt, Bodies<Real>& bodies,
                     PairList<Real, Law::history_size>& pairs, std::span<ForceRecord<Real>> slots,
                     Dissipation& lost) {
  const std::span<const SphereRecord<Real>> spheres = std::as_const(bodies).spheres();
  const std::span<ForceRecord<Real>> forces = bodies.forces();
  constexpr std::size_t look_ahead = 6; // pairs; 4 to 10 do equally well
  const std::size_t last = pairs.size() - 1;
  std::size_t slot = block.first_slot;
  Real friction = 0, viscous = 0;
  for (std::size_t i = block.first_sphere; i < block.end_sphere; ++i) {
    const SphereRecord<Real> own =
        spheres[i]; // a copy: the compiler cannot know that no force is stored there
    ForceRecord<Real> sum = forces[i];
    const std::size_t end = pairs.begin_of(i + 1);
    for (std::size_t pair = pairs.begin_of(i); pair < end; ++pair) {
      prefetch(spheres[pairs.partner(std::min(pair + look_ahead, last)).sphere]);
      const Partner partner = pairs.partner(pair);
      const std::size_t j = partner.sphere;
      const SphereRecord<Real>& other = spheres[j];
      const bool crosses = j >= block.end_sphere;
      Vec3<double> apart = own.position - other.position;
      if constexpr (periodic) {
        apart -= domain.shift(partner.image);
      }
      const double d2 = squared_norm(apart);
      const double reach = own.radius + other.radius;
      if (d2 >= reach * reach) {
        pairs.history(pair) = {};
        if (crosses) {
          slots[slot++] = {};
        }
        continue;
      }
      const Touch<Real> touch = touch_of(own, other, apart, d2, dt);
      const Kinematics<Real>& k = touch.kinematics;
      const ContactForce<Real> f =
          law.evaluate(pair_material(own.material, other.material), k, pairs.history(pair));
      const Vec3<Real> force = k.normal * f.normal + f.tangential;
      const Vec3<Real> turn = cross(k.normal, f.tangential);
      sum.force += force;
      sum.torque += f.couple - turn * touch.arm_i;
      const Vec3<Real> moment = f.couple + turn * touch.arm_j;
      if (crosses) {
        slots[slot++] = {-force, -moment};
      } else {
        forces[j].force -= force;
        forces[j].torque -= moment;
      }
      if constexpr (audit) {
        friction += f.frictional_work;
        viscous += f.viscous_work;
      }
    }
    forces[i] = sum;
  }
  if constexpr (audit) {
    lost.friction += static_cast<double>(friction);
    lost.viscous += static_cast<double>(viscous);
  }
}

} // namespace scree
