#pragma once
/// \file
/// The loop over contacts with walls: first where they are, one by one, then their forces, many at a time.

#include "scree/contact/concept.hpp"
#include "scree/core/pack.hpp"
#include "scree/simulation/tally.hpp"
#include "scree/simulation/wall_contacts.hpp"

#include <boost/container/small_vector.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <tuple>
#include <type_traits>
#include <utility>

namespace scree {

/// What the contacts with walls are computed on: packs, for a law that can be evaluated over them.
template <class Law, class Real>
using WallNumber = std::conditional_t<EvaluatesForce<Law, Pack<Real>>, Pack<Real>, Real>;

namespace detail {

/// A sphere and a wall at their contact.
template <class T>
struct WallTouch {
  Vec3<T> normal;          ///< from the wall to the sphere
  Vec3<T> tilt;            ///< rad, by which it turned in the step
  Vec3<T> between;         ///< m/s, of the sphere's centre less that of the wall's origin
  Vec3<T> spin, wall_spin; ///< rad/s
  Vec3<T> lever;           ///< m, from the wall's origin to the sphere's centre
  T arm;                   ///< m, from the centre of the sphere to the contact point
};

/// m/s, of the sphere relative to the wall at their contact. Velocities stand half a step behind, so slip is
/// the mean of that at the place where the contact is and at the one that it came from. (Not that at a place
/// halfway: from facet to facet there is none.)
template <class T>
[[gnu::always_inline]] inline Vec3<T> slip_velocity(const WallTouch<T>& c, const T& dt) {
  const auto at = [&](const Vec3<T>& n, const Vec3<T>& lever) {
    const Vec3<T> of_grain = negated_multiply_add(cross(c.spin, n), c.arm, c.between);
    return of_grain - cross(c.wall_spin, negated_multiply_add(n, c.arm, lever));
  };
  const Vec3<T> now = at(c.normal, c.lever);
  if (!any(squared_norm(c.tilt) + squared_norm(c.wall_spin) > T(0))) {
    return now;
  }
  const auto along = [](const Vec3<T>& velocity, const Vec3<T>& n) {
    return negated_multiply_add(n, dot(n, velocity), velocity);
  };
  const Vec3<T> past_normal = c.normal - cross(c.tilt, c.normal);
  const Vec3<T> before = along(at(past_normal, negated_multiply_add(c.between, dt, c.lever)), past_normal);
  return multiply_add(before + cross(c.tilt, before) - along(now, c.normal), T(0.5), now);
}

/// The forces of the walls on the spheres of a block. T is a plain number or a pack; forces are added in the
/// order of the contacts whatever T is.
template <bool audit, class T, class Law, class Real, class AnyWall, class PairMaterials>
class WallLoop {
  static constexpr std::size_t width = Lanes<T>::width;
  static constexpr std::size_t history_size = static_cast<std::size_t>(Law::history_size);
  using Contact = WallContact<Real, Law::history_size>;

public:
  using OneBlock = WallBlock<Real, Law::history_size>;

  WallLoop(const Law& law, const PairMaterials& pair_material, std::span<const AnyWall> walls, Real dt,
           Bodies<Real>& bodies)
      : law_{law}, pair_material_{pair_material}, walls_{walls}, dt_{dt}, bodies_{bodies} {
    for (const AnyWall& wall : walls) {
      in_step_.emplace_back(wall);
    }
  }

  /// Adds the forces to the spheres, and what the walls feel to `sums` (one for each wall).
  void add_all(OneBlock& block, std::span<WallSum> sums, Dissipation& lost) const {
    find(block);
    for (std::size_t first = 0; first < block.contacts.size(); first += width) {
      feel(block, first, sums, lost);
    }
  }

private:
  /// What the contacts of a step ask of a wall again and again.
  struct InStep {
    Matrix axes; ///< of the wall's frame, in space
    Vector position;
    double inverse_mass; ///< 1/kg, as a contact sees it
    bool still;

    explicit InStep(const AnyWall& wall)
        : axes{wall.motion.orientation.toRotationMatrix()},
          position{wall.motion.position},
          inverse_mass{wall.inverse_mass()},
          still{stands_still(wall.dynamics)} {}
  };

  /// Makes the list of contacts anew; those that were there keep their histories.
  void find(OneBlock& block) const {
    std::swap(block.contacts, block.before);
    block.contacts.clear();
    block.tilts.clear();
    auto old = block.before.begin();
    SurfaceContacts found;
    for (WallCandidate& candidate : block.candidates) {
      const InStep& wall = in_step_[candidate.wall];
      const SphereRecord<Real>& sphere = std::as_const(bodies_).spheres()[candidate.sphere];
      if (wall.still && squared_norm(sphere.position - candidate.seen) < candidate.gap * candidate.gap) {
        continue; // it cannot have closed the gap
      }
      const auto key = std::tuple{candidate.sphere, candidate.wall, candidate.surface};
      if (wall.still && sphere.position == candidate.seen) {
        for (; old != block.before.end() && old->key() <= key; ++old) {
          if (old->key() == key) {
            block.contacts.push_back(*old);
            block.tilts.emplace_back(Vector::Zero());
          }
        }
        continue;
      }
      candidate.seen = sphere.position;
      const Vector centre = to_eigen(sphere.position);
      found.clear();
      const double gap = walls_[candidate.wall].surfaces[candidate.surface].touch(
          {block.facets.data() + candidate.first_facet, candidate.facet_count},
          wall.axes.transpose() * (centre - wall.position), sphere.radius, found);
      candidate.gap = std::max(0.0, gap * (1.0 - 1e-9)); // off by a hair, as it is rounded
      if (found.empty()) {
        continue;
      }
      while (old != block.before.end() && old->key() < key) {
        ++old;
      }
      auto old_end = old;
      while (old_end != block.before.end() && old_end->key() == key) {
        ++old_end;
      }
      for (const SurfaceContact& contact : found) {
        const Vector normal = wall.axes * contact.normal;
        Contact& now = block.contacts.emplace_back();
        Vector& tilt = block.tilts.emplace_back(Vector::Zero());
        now.sphere = candidate.sphere;
        now.wall = candidate.wall;
        now.surface = candidate.surface;
        now.at = contact.point;
        now.normal = normal;
        now.overlap = contact.overlap;
        now.point = centre - (sphere.radius - 0.5 * contact.overlap) * normal;
        now.history = {};
        // A contact moves by far less than this in one step, and two contacts of a sphere lie further apart.
        const double reach = 0.2 * sphere.radius;
        auto match = old_end;
        double nearest = reach * reach;
        for (auto before = old; before != old_end; ++before) {
          if (const double d2 = (before->at - contact.point).squaredNorm(); d2 < nearest) {
            nearest = d2;
            match = before;
          }
        }
        if (match != old_end) {
          now.history = match->history;
          if (match->normal != normal) { // on one facet it stays the same to the bit
            tilt = match->normal.cross(normal);
          }
          match->at.setConstant(std::numeric_limits<double>::infinity()); // taken
        }
      }
    }
  }

  /// The forces of one pack of contacts. Lanes left over hold the last contact once more.
  /// All that it calls is to be inlined: packs that cross a call go through memory.
  [[gnu::flatten]] void feel(OneBlock& block, std::size_t first, std::span<WallSum> sums,
                             Dissipation& lost) const {
    const std::size_t count = std::min(width, block.contacts.size() - first);
    const auto spheres = std::as_const(bodies_).spheres();
    const auto each = [&](auto value) {
      return Lanes<T>::generated(
          [&](std::size_t lane) { return static_cast<Real>(value(first + std::min(lane, count - 1))); });
    };
    const auto contact = [&](std::size_t n) -> const Contact& { return block.contacts[n]; };
    const auto sphere = [&](std::size_t n) -> const SphereRecord<Real>& {
      return spheres[contact(n).sphere];
    };
    const auto motion = [&](std::size_t n) -> const WallMotion& { return walls_[contact(n).wall].motion; };
    const auto material = [&](std::size_t n) -> const PairMaterial<Real>& {
      return pair_material_(sphere(n).material,
                            walls_[contact(n).wall].surfaces[contact(n).surface].material());
    };
    const auto vector = [&](auto value) {
      return Vec3<T>{each([&](std::size_t n) { return value(n)[0]; }),
                     each([&](std::size_t n) { return value(n)[1]; }),
                     each([&](std::size_t n) { return value(n)[2]; })};
    };
    WallTouch<T> touch;
    touch.normal = vector([&](std::size_t n) -> const Vector& { return contact(n).normal; });
    touch.tilt = vector([&](std::size_t n) -> const Vector& { return block.tilts[n]; });
    touch.between =
        vector([&](std::size_t n) { return Vector(to_eigen(sphere(n).velocity) - motion(n).velocity); });
    touch.spin = vector([&](std::size_t n) { return to_eigen(sphere(n).angular_velocity); });
    touch.wall_spin = vector([&](std::size_t n) -> const Vector& { return motion(n).angular_velocity; });
    touch.lever =
        vector([&](std::size_t n) { return Vector(to_eigen(sphere(n).position) - motion(n).position); });
    touch.arm = each([&](std::size_t n) { return sphere(n).radius - 0.5 * contact(n).overlap; });

    Kinematics<T> k;
    k.normal = touch.normal;
    k.overlap = each([&](std::size_t n) { return contact(n).overlap; });
    k.velocity = slip_velocity(touch, T(dt_));
    k.spin_i = touch.spin;
    k.spin_j = touch.wall_spin;
    k.turn = multiply_add(k.normal, T(0.5) * dot(k.spin_i + k.spin_j, k.normal) * T(dt_), touch.tilt);
    k.reduced_radius = each([&](std::size_t n) { return sphere(n).radius; });
    k.reduced_mass = each([&](std::size_t n) {
      return 1.0 / (static_cast<double>(sphere(n).inverse_mass) + in_step_[contact(n).wall].inverse_mass);
    });
    k.root_mass = square_root(k.reduced_mass);
    k.dt = T(dt_);
    std::array<T, history_size> history;
    for (std::size_t h = 0; h < history_size; ++h) {
      history[h] = each([&](std::size_t n) { return contact(n).history[h]; });
    }
    const ContactForce<T> f = law_.evaluate(materials(each, material, first, count), k, history);
    const Vec3<T> force = multiply_add(k.normal, f.normal, f.tangential);
    const Vec3<T> torque = negated_multiply_add(cross(k.normal, f.tangential), touch.arm, f.couple);

    const auto forces_of = stored(force), torques = stored(torque), couples = stored(f.couple);
    std::array<Real, width> pressed;
    Lanes<T>::store(larger(f.normal, -f.normal), pressed.data());
    std::array<std::array<Real, width>, history_size> histories;
    for (std::size_t h = 0; h < history_size; ++h) {
      Lanes<T>::store(history[h], histories[h].data());
    }
    std::array<Real, width> friction, viscous;
    Lanes<T>::store(f.frictional_work, friction.data());
    Lanes<T>::store(f.viscous_work, viscous.data());
    const auto forces = bodies_.forces();
    for (std::size_t lane = 0; lane < count; ++lane) {
      Contact& c = block.contacts[first + lane];
      const auto of = [lane](const auto& v) { return Vec3<Real>{v[0][lane], v[1][lane], v[2][lane]}; };
      forces[c.sphere] += {.force = of(forces_of), .pressed = pressed[lane], .torque = of(torques)};
      c.force = to_eigen(of(forces_of));
      for (std::size_t h = 0; h < history_size; ++h) {
        c.history[h] = histories[h][lane];
      }
      WallSum& sum = sums[c.wall];
      sum.force -= c.force;
      sum.moment -= (c.point - in_step_[c.wall].position).cross(c.force) + to_eigen(of(couples));
      ++sum.contacts;
      if constexpr (audit) {
        lost.friction += static_cast<double>(friction[lane]);
        lost.viscous += static_cast<double>(viscous[lane]);
      }
    }
  }

  static std::array<std::array<Real, width>, 3> stored(const Vec3<T>& v) {
    std::array<std::array<Real, width>, 3> out;
    Lanes<T>::store(v.x, out[0].data());
    Lanes<T>::store(v.y, out[1].data());
    Lanes<T>::store(v.z, out[2].data());
    return out;
  }

  /// Of the pack that begins with contact `first`, mostly the same in all lanes.
  template <class Each, class Of>
  static PairMaterial<T> materials(const Each& each, const Of& of, std::size_t first, std::size_t count) {
    constexpr std::size_t size = sizeof(PairMaterial<Real>) / sizeof(Real);
    using Numbers = std::array<Real, size>;
    const PairMaterial<Real>& one = of(first);
    bool alike = true;
    for (std::size_t lane = 1; lane < count; ++lane) {
      alike = alike && &of(first + lane) == &one;
    }
    std::array<T, size> numbers;
    const auto same = std::bit_cast<Numbers>(one);
    for (std::size_t number = 0; number < size; ++number) {
      numbers[number] = alike ? T(same[number])
                              : each([&](std::size_t n) { return std::bit_cast<Numbers>(of(n))[number]; });
    }
    return std::bit_cast<PairMaterial<T>>(numbers);
  }

  const Law& law_;
  PairMaterials pair_material_;
  std::span<const AnyWall> walls_;
  Real dt_;
  Bodies<Real>& bodies_;
  boost::container::small_vector<InStep, 4> in_step_;
};

} // namespace detail

} // namespace scree
