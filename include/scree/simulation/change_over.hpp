#pragma once
/// \file
/// What happens to forces when bodies go to rest or wake.

#include "scree/simulation/domain.hpp"
#include "scree/simulation/touch.hpp"
#include "scree/state/bodies.hpp"
#include "scree/walls/fixed.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace scree::detail {

/// For each body, whether it touches a wall that may move; empty where none does.
template <class Real, class WallBlocks, class AnyWall>
std::vector<std::uint8_t> disturbed_by_walls(const WallBlocks& blocks, std::span<const AnyWall> walls,
                                             const Bodies<Real>& bodies) {
  std::vector<std::uint8_t> disturbed;
  for (const auto& block : blocks) {
    for (const auto& contact : block.contacts) {
      if (!stands_still(walls[contact.wall].dynamics)) {
        disturbed.resize(bodies.size());
        disturbed[bodies.body_of(contact.sphere)] = 1;
      }
    }
  }
  return disturbed;
}

/// Adds the forces of pairs that are held from now on to what is held, and takes those of the others away.
/// Nothing has moved while they were held, so both are the same to the bit.
template <class Real, class Law, class PairMaterials>
class HeldForces {
public:
  HeldForces(const Law& law, const PairMaterials& pair_material, const Domain& domain, Real dt,
             Bodies<Real>& bodies)
      : law_{law}, pair_material_{pair_material}, domain_{domain}, dt_{dt}, bodies_{bodies} {}

  /// \param blocks with the pairs that change, of the list `pairs`
  template <class BlocksOfPairs, class Pairs>
  void change(const BlocksOfPairs& blocks, const Pairs& pairs) {
    const auto held = bodies_.held_forces();
    for (const auto& block : blocks) {
      for (const auto& pair : block.changed) {
        change(pair.i, pair.j, pairs.history(pair.number), held);
      }
    }
    // All pairs of what is awake are computed.
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      if (bodies_.activity(b) == Activity::waking) {
        std::fill(held.begin() + static_cast<std::ptrdiff_t>(bodies_.first_sphere(b)),
                  held.begin() + static_cast<std::ptrdiff_t>(bodies_.first_sphere(b + 1)),
                  ForceRecord<Real>{});
      }
    }
  }

private:
  template <class History>
  void change(std::size_t i, Partner partner, History history, std::span<ForceRecord<Real>> held) const {
    const std::size_t j = partner.sphere;
    const auto &own = std::as_const(bodies_).spheres()[i], &other = std::as_const(bodies_).spheres()[j];
    const Vec3<double> apart = own.position - other.position - domain_.shift(partner.image);
    const double d2 = squared_norm(apart), reach = own.radius + other.radius;
    if (d2 >= reach * reach) {
      return;
    }
    const Touch<Real> touch = touch_of(own, other, apart, d2, dt_);
    const ContactForce<Real> f =
        law_.evaluate(pair_material_(own.material, other.material), touch.kinematics, history);
    const Vec3<Real> turn = cross(touch.kinematics.normal, f.tangential);
    const Real sign =
        at_rest(bodies_.activity(bodies_.body_of(i))) && at_rest(bodies_.activity(bodies_.body_of(j)))
            ? Real{1}
            : Real{-1};
    const Vec3<Real> force = (touch.kinematics.normal * f.normal + f.tangential) * sign;
    const Real pressed = sign * std::abs(f.normal);
    held[i] += {.force = force, .pressed = pressed, .torque = (f.couple - turn * touch.arm_i) * sign};
    held[j] += {.force = -force, .pressed = pressed, .torque = (f.couple + turn * touch.arm_j) * -sign};
  }

  const Law& law_;
  PairMaterials pair_material_;
  const Domain& domain_;
  Real dt_;
  Bodies<Real>& bodies_;
};

} // namespace scree::detail
