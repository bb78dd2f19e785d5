#pragma once
/// \file
/// The loop over pairs of grains: where the time goes.

#include "scree/contact/concept.hpp"
#include "scree/core/pack.hpp"
#include "scree/simulation/domain.hpp"
#include "scree/simulation/pair_batch.hpp"
#include "scree/simulation/tally.hpp"
#include "scree/simulation/touch.hpp"
#include "scree/state/blocks.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>

namespace scree {

namespace detail {

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

/// `vector(lane)` of all lanes.
template <class T, class VectorOf>
Vec3<T> gathered(VectorOf vector) {
  return {Lanes<T>::generated([&](std::size_t lane) { return vector(lane).x; }),
          Lanes<T>::generated([&](std::size_t lane) { return vector(lane).y; }),
          Lanes<T>::generated([&](std::size_t lane) { return vector(lane).z; })};
}

/// The pairs of one block, batch by batch: first those that touch are sorted out, then the law is evaluated
/// over T, a plain number or a pack. Forces are added in the order of the list whatever T is, so that only
/// the rounding of fused multiply-adds can tell the two apart.
template <bool periodic, bool audit, class T, class Law, class Real, class PairMaterials>
class PairLoop {
public:
  PairLoop(const Block& block, const Law& law, const PairMaterials& pair_material, const Domain& domain,
           Real dt, Bodies<Real>& bodies, PairList<Real, Law::history_size>& pairs,
           std::span<ForceRecord<Real>> slots)
      : block_{block},
        law_{law},
        pair_material_{pair_material},
        domain_{domain},
        dt_{dt},
        spheres_{std::as_const(bodies).spheres()},
        forces_{bodies.forces()},
        slots_{slots},
        pairs_{pairs} {}

  void run(Dissipation& lost) {
    constexpr std::size_t look_ahead = 12; // pairs; the time hardly depends on it
    const std::size_t last = std::max<std::size_t>(pairs_.size(), 1) - 1;
    std::size_t slot = block_.first_slot, cleared = slot;
    const auto finish_batch = [&] {
      for (; cleared < slot; ++cleared) {
        slots_[cleared] = {};
      }
      add_batch();
    };
    for (std::size_t i = block_.first_sphere; i < block_.end_sphere; ++i) {
      const Vec3<double> centre = spheres_[i].position;
      const double radius = spheres_[i].radius;
      const std::size_t end = pairs_.begin_of(i + 1);
      for (std::size_t pair = pairs_.begin_of(i); pair < end; ++pair) {
        prefetch(spheres_[pairs_.partner(std::min(pair + look_ahead, last)).sphere]);
        const Partner partner = pairs_.partner(pair);
        const SphereRecord<Real>& other = spheres_[partner.sphere];
        Vec3<double> apart = centre - other.position;
        if constexpr (periodic) {
          apart -= domain_.shift(partner.image);
        }
        batch_.add({number(pair), number(i), partner.sphere, number(slot)}, apart, radius, other.radius);
        slot += in_later_block(partner.sphere) ? 1 : 0;
        if (batch_.full()) {
          finish_batch();
        }
      }
    }
    finish_batch();
    if constexpr (audit) {
      lost.friction += static_cast<double>(friction_);
      lost.viscous += static_cast<double>(viscous_);
    }
  }

private:
  static constexpr std::size_t width = Lanes<T>::width;
  static constexpr std::size_t history_size = static_cast<std::size_t>(Law::history_size);
  using Place = typename PairBatch<Real>::Place;

  static std::uint32_t number(std::size_t n) { return static_cast<std::uint32_t>(n); }
  [[nodiscard]] bool in_later_block(std::size_t sphere) const { return sphere >= block_.end_sphere; }

  void add_batch() {
    for (const std::uint32_t pair : batch_.parted()) {
      pairs_.history(pair) = {};
    }
    for (std::size_t k = 0; k < batch_.touching(); k += width) {
      add_contacts(k, std::min(width, batch_.touching() - k));
    }
    batch_.clear();
  }

  /// Of the touching pairs of the batch, `count` from number `first` on; at most `width`. All that it calls
  /// is to be inlined: packs that cross a call go through memory.
  [[gnu::flatten]] void add_contacts(std::size_t first, std::size_t count) {
    const auto place = [&](std::size_t lane) -> const Place& { return batch_.place(first + lane); };
    const auto i = [&](std::size_t lane) -> const SphereRecord<Real>& { return spheres_[place(lane).i]; };
    const auto j = [&](std::size_t lane) -> const SphereRecord<Real>& { return spheres_[place(lane).j]; };
    SpherePair<T> pair;
    batch_.read(first, pair);
    pair.velocity_i = gathered<T>([&](std::size_t lane) { return i(lane).velocity; });
    pair.velocity_j = gathered<T>([&](std::size_t lane) { return j(lane).velocity; });
    pair.spin_i = gathered<T>([&](std::size_t lane) { return i(lane).angular_velocity; });
    pair.spin_j = gathered<T>([&](std::size_t lane) { return j(lane).angular_velocity; });
    pair.inverse_mass_i = Lanes<T>::generated([&](std::size_t lane) { return i(lane).inverse_mass; });
    pair.inverse_mass_j = Lanes<T>::generated([&](std::size_t lane) { return j(lane).inverse_mass; });
    std::array<T, history_size> history;
    for (std::size_t h = 0; h < history_size; ++h) {
      history[h] = Lanes<T>::generated([&](std::size_t lane) { return pairs_.history(place(lane).pair)[h]; });
    }

    const Touch<T> touch = touch_of(pair, T(dt_));
    const Vec3<T>& normal = touch.kinematics.normal;
    const ContactForce<T> f = law_.evaluate(materials(i, j), touch.kinematics, history);
    const Vec3<T> force = normal * f.normal + f.tangential;
    const Vec3<T> turn = cross(normal, f.tangential);
    const Vec3<T> on_i = f.couple - turn * touch.arm_i, on_j = f.couple + turn * touch.arm_j;

    const Columns<3> forces = columns<3>({force.x, force.y, force.z});
    const Columns<3> torques_i = columns<3>({on_i.x, on_i.y, on_i.z});
    const Columns<3> torques_j = columns<3>({on_j.x, on_j.y, on_j.z});
    const Columns<history_size> histories = columns<history_size>(history);
    const Columns<2> work = columns<2>({f.frictional_work, f.viscous_work});
    const auto vector = [](const Columns<3>& c, std::size_t lane) {
      return Vec3<Real>{c[0][lane], c[1][lane], c[2][lane]};
    };
    for (std::size_t lane = 0; lane < count; ++lane) {
      const Place& at = place(lane);
      for (std::size_t h = 0; h < history_size; ++h) {
        pairs_.history(at.pair)[h] = histories[h][lane];
      }
      ForceRecord<Real>& own = forces_[at.i];
      own.force += vector(forces, lane);
      own.torque += vector(torques_i, lane);
      ForceRecord<Real>& other = in_later_block(at.j) ? slots_[at.slot] : forces_[at.j];
      other.force -= vector(forces, lane);
      other.torque -= vector(torques_j, lane);
      if constexpr (audit) {
        friction_ += work[0][lane];
        viscous_ += work[1][lane];
      }
    }
  }

  /// Packs taken apart: a column of lanes for each.
  template <std::size_t n>
  using Columns = std::array<std::array<Real, width>, n>;
  template <std::size_t n>
  static Columns<n> columns(const std::array<T, n>& values) {
    Columns<n> out;
    for (std::size_t k = 0; k < n; ++k) {
      Lanes<T>::store(values[k], out[k].data());
    }
    return out;
  }

  template <class I, class J>
  PairMaterial<T> materials(I i, J j) const {
    const auto of = [&](std::size_t lane) { return &pair_material_(i(lane).material, j(lane).material); };
    const PairMaterial<Real>* const first = of(0);
    bool alike = true;
    for (std::size_t lane = 1; lane < width; ++lane) {
      alike = alike && of(lane) == first;
    }
    if (alike) {
      return first->template as<T>();
    }
    constexpr std::size_t size = sizeof(PairMaterial<Real>) / sizeof(Real);
    using Numbers = std::array<Real, size>;
    std::array<T, size> numbers;
    for (std::size_t n = 0; n < size; ++n) {
      numbers[n] =
          Lanes<T>::generated([&](std::size_t lane) { return std::bit_cast<Numbers>(*of(lane))[n]; });
    }
    return std::bit_cast<PairMaterial<T>>(numbers);
  }

  const Block& block_;
  const Law& law_;
  const PairMaterials& pair_material_;
  const Domain& domain_;
  Real dt_;
  std::span<const SphereRecord<Real>> spheres_;
  std::span<ForceRecord<Real>> forces_, slots_;
  PairList<Real, Law::history_size>& pairs_;
  PairBatch<Real> batch_;
  Real friction_ = 0, viscous_ = 0;
};

} // namespace detail

/// Adds the forces of all pairs whose first sphere is in `block` to the spheres of the block; those on
/// spheres of later blocks go to `slots`. `pair_material(a, b)` gives the constants of two materials. A law
/// that can be evaluated over packs is.
template <bool periodic, bool audit, ContactLaw Law, class Real, class PairMaterials>
void add_pair_forces(const Block& block, const Law& law, const PairMaterials& pair_material,
                     const Domain& domain, Real dt, Bodies<Real>& bodies,
                     PairList<Real, Law::history_size>& pairs, std::span<ForceRecord<Real>> slots,
                     Dissipation& lost) {
  using T = std::conditional_t<EvaluatesForce<Law, Pack<Real>>, Pack<Real>, Real>;
  detail::PairLoop<periodic, audit, T, Law, Real, PairMaterials> loop{block, law,    pair_material, domain,
                                                                      dt,    bodies, pairs,         slots};
  loop.run(lost);
}

} // namespace scree
