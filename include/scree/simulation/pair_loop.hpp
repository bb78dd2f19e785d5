#pragma once
/// \file
/// The loop over pairs of grains: where the time goes.

#include "scree/contact/concept.hpp"
#include "scree/core/twin.hpp"
#include "scree/simulation/domain.hpp"
#include "scree/simulation/tally.hpp"
#include "scree/simulation/touch.hpp"
#include "scree/state/contact_packs.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <type_traits>
#include <utility>

namespace scree {

/// What the pairs of a model are computed on: packs, for a law that can be evaluated over them.
template <class Law, class Real>
using KernelNumber = std::conditional_t<EvaluatesForce<Law, Twin<Pack<Real>>>, Twin<Pack<Real>>, Real>;

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

/// The forces of pairs, pack by pack. T is a plain number or a pack; forces are added in the order of the
/// pairs whatever T is.
template <bool periodic, bool audit, class T, class Law, class Real, class PairMaterials>
class PairLoop {
  static constexpr std::size_t width = Lanes<T>::width;
  static constexpr std::size_t history_size = static_cast<std::size_t>(Law::history_size);

public:
  using Packs = ContactPacks<Real, Law::history_size, width>;

  PairLoop(const Law& law, const PairMaterials& pair_material, const Domain& domain, Real dt,
           Bodies<Real>& bodies)
      : law_{law},
        pair_material_{pair_material},
        domain_{domain},
        dt_{dt},
        spheres_{reinterpret_cast<const std::byte*>(std::as_const(bodies).spheres().data())},
        forces_{reinterpret_cast<std::byte*>(bodies.forces().data())} {}

  /// Adds the forces of `packs` to both spheres of each pair.
  void add_all(Packs& packs, Dissipation& lost) {
    run(packs, lost, [this](std::size_t, const OnePack& pack, auto lane, const Loads& on_j) {
      on_j.template apply<lane>(force_at(pack.force_j[lane]), std::minus<>{});
    });
  }

  /// Adds the forces of `packs` to the first sphere of each pair and lays that on the second down in `slots`,
  /// one for each lane.
  void add_to_first(Packs& packs, std::span<ForceRecord<Real>> slots, Dissipation& lost) {
    run(packs, lost, [slots](std::size_t p, const OnePack&, auto lane, const Loads& on_j) {
      on_j.template apply<lane>(&slots[p * width + lane].force.x,
                                [](const auto&, const auto& row) { return -row; });
    });
  }

private:
  using OnePack = typename Packs::OnePack;
  using Loads = RowsOfEight<T>; // forces and torques

  [[nodiscard]] Real* force_at(std::uint32_t bytes) const {
    return &reinterpret_cast<ForceRecord<Real>*>(forces_ + bytes)->force.x;
  }
  [[nodiscard]] const SphereRecord<Real>& sphere_at(std::uint32_t bytes) const {
    return *reinterpret_cast<const SphereRecord<Real>*>(spheres_ + bytes);
  }

  template <class AddToSecond>
  void run(Packs& packs, Dissipation& lost, AddToSecond add_to_second) {
    constexpr std::size_t look_ahead = 2; // packs; the time hardly depends on it
    friction_ = viscous_ = 0;
    known_ = false;
    for (std::size_t p = 0; p < packs.pack_count(); ++p) {
      if (p + look_ahead < packs.pack_count()) {
        const OnePack& later = packs.pack(p + look_ahead);
        for (std::size_t lane = 0; lane < width; ++lane) {
          prefetch(sphere_at(later.sphere_j[lane]));
        }
      }
      add_pack(packs, p, add_to_second);
    }
    if constexpr (audit) {
      lost.friction += static_cast<double>(friction_);
      lost.viscous += static_cast<double>(viscous_);
    }
  }

  /// All that it calls is to be inlined: packs that cross a call go through memory.
  template <class AddToSecond>
  [[gnu::flatten]] void add_pack(Packs& packs, std::size_t p, const AddToSecond& add_to_second) {
    OnePack& pack = packs.pack(p);
    SpherePair<T> pair;
    const auto touching = set_apart(packs, p, pair) && Lanes<T>::below(packs.size() - p * width);
    const Fields<T> velocity =
        differences_of<T>([&](std::size_t lane) { return &sphere_at(pack.sphere_i[lane]).velocity.x; },
                          [&](std::size_t lane) { return &sphere_at(pack.sphere_j[lane]).velocity.x; });
    const auto spins = [&](const auto& of) {
      return fields_of<T>([&](std::size_t lane) { return &sphere_at(of[lane]).angular_velocity.x; });
    };
    const Fields<T> spin_i = spins(pack.sphere_i), spin_j = spins(pack.sphere_j);
    pair.velocity = {velocity[0], velocity[1], velocity[2]};
    pair.spin_i = {spin_i[0], spin_i[1], spin_i[2]};
    pair.spin_j = {spin_j[0], spin_j[1], spin_j[2]};
    pair.root_mass = Lanes<T>::loaded(pack.root_mass.data());
    // Where spheres do not touch, what comes out is thrown away; it only must not be slow.
    pair.squared_distance = select(touching, pair.squared_distance, T(1));
    pair.closeness = select(touching, pair.closeness, T(0));

    std::array<T, history_size> history;
    for (std::size_t h = 0; h < history_size; ++h) {
      history[h] = Lanes<T>::loaded(pack.history[h].data());
    }
    const Touch<T> touch = touch_of(pair, T(dt_));
    const Vec3<T>& normal = touch.kinematics.normal;
    const ContactForce<T> f = law_.evaluate(materials(packs, p), touch.kinematics, history);
    const auto kept = [&](const T& value) { return select(touching, value, T(0)); };
    for (std::size_t h = 0; h < history_size; ++h) {
      Lanes<T>::store(kept(history[h]), pack.history[h].data());
    }
    const Vec3<T> tangential{kept(f.tangential.x), kept(f.tangential.y), kept(f.tangential.z)};
    const Vec3<T> couple{kept(f.couple.x), kept(f.couple.y), kept(f.couple.z)};
    const Vec3<T> force = multiply_add(normal, kept(f.normal), tangential);
    const Vec3<T> turn = cross(normal, tangential);
    const Vec3<T> on_i = negated_multiply_add(turn, touch.arm_i, couple),
                  on_j = multiply_add(turn, touch.arm_j, couple);
    const T pressed = larger(kept(f.normal), -kept(f.normal));
    const Loads loads_i{{force.x, force.y, force.z, pressed}, {on_i.x, on_i.y, on_i.z, T(0)}};
    // To be taken from the second sphere.
    const Loads loads_j{{force.x, force.y, force.z, -pressed}, {on_j.x, on_j.y, on_j.z, T(0)}};
    // Pair after pair, so that sums do not depend on which pairs make a pack.
    for_each_lane<T>([&](auto lane) {
      loads_i.template apply<lane>(force_at(pack.force_i[lane]), std::plus<>{});
      add_to_second(p, pack, lane, loads_j);
    });
    if constexpr (audit) {
      add_in_order(kept(f.frictional_work), friction_);
      add_in_order(kept(f.viscous_work), viscous_);
    }
  }

  /// In the order of the pairs, so that the sum does not depend on which pairs make a pack.
  static void add_in_order(const T& values, Real& sum) {
    std::array<Real, width> lanes;
    Lanes<T>::store(values, lanes.data());
    for (const Real value : lanes) {
      sum += value;
    }
  }

  /// Sets what differences of positions give, and returns where spheres touch.
  auto set_apart(const Packs& packs, std::size_t p, SpherePair<T>& pair) const {
    const Apart<T> found = apart<T>(packs, p, 0);
    pair.apart = {found[0], found[1], found[2]};
    pair.squared_distance = found[3];
    pair.closeness = found[4];
    pair.reach = found[5];
    pair.difference = found[6];
    return pair.closeness > T(0);
  }

  /// Components of the distance [m], its square, closeness, reach and difference (`SpherePair`).
  template <class Number>
  using Apart = std::array<Number, 7>;

  /// Of pack p from lane `first` on. Differences are taken in double, whatever Number is.
  template <class Number>
  Apart<Number> apart(const Packs& packs, std::size_t p, std::size_t first) const {
    const auto each = [](const auto& a, const auto& b, auto combine) {
      Apart<Number> out;
      for (std::size_t n = 0; n < out.size(); ++n) {
        out[n] = combine(a[n], b[n]);
      }
      return out;
    };
    if constexpr (std::is_same_v<Number, Twin<Pack<Real>>>) {
      using Half = Pack<Real>;
      return each(apart<Half>(packs, p, first), apart<Half>(packs, p, first + Half::width),
                  [](const Half& a, const Half& b) {
                    return Number{a, b};
                  });
    } else if constexpr (std::is_same_v<Number, Pack<float>>) {
      using Half = Pack<double>;
      return each(apart<Half>(packs, p, first), apart<Half>(packs, p, first + Half::width),
                  [](const Half& a, const Half& b) { return narrowed(a, b); });
    } else if constexpr (std::is_same_v<Number, float>) {
      const Apart<double> wide = apart<double>(packs, p, first);
      return each(wide, wide, [](double a, double) { return static_cast<float>(a); });
    } else {
      const OnePack& pack = packs.pack(p);
      const Fields<Number> between = differences_of<Number>(
          [&](std::size_t lane) { return &sphere_at(pack.sphere_i[first + lane]).position.x; },
          [&](std::size_t lane) { return &sphere_at(pack.sphere_j[first + lane]).position.x; });
      Vec3<Number> apart{between[0], between[1], between[2]};
      if constexpr (periodic) {
        apart -= shift<Number>(packs, p * width + first);
      }
      const Number reach = Lanes<Number>::loaded(&pack.reach[first]), distance2 = squared_norm(apart);
      return {apart.x, apart.y,   apart.z, distance2, multiply_subtract(reach, reach, distance2),
              reach,   between[3]};
    }
  }

  /// m, of the periodic images of the second spheres from number k on.
  template <class Wide>
  Vec3<Wide> shift(const Packs& packs, std::size_t k) const {
    const auto along = [&](auto component) {
      return Lanes<Wide>::generated(
          [&](std::size_t lane) { return component(domain_.shift(packs.pair(k + lane).image)); });
    };
    return {along([](const Vec3<double>& v) { return v.x; }),
            along([](const Vec3<double>& v) { return v.y; }),
            along([](const Vec3<double>& v) { return v.z; })};
  }

  /// Most packs are of the materials of the pack before.
  const PairMaterial<T>& materials(const Packs& packs, std::size_t p) {
    const auto& of = packs.materials(p);
    if (of.alike && known_ && of.i == material_i_ && of.j == material_j_) {
      return constants_;
    }
    known_ = of.alike;
    material_i_ = of.i;
    material_j_ = of.j;
    const auto sphere = [&](std::uint32_t k) -> const auto& {
      return reinterpret_cast<const SphereRecord<Real>*>(spheres_)[k];
    };
    constexpr std::size_t size = sizeof(PairMaterial<Real>) / sizeof(Real);
    using Numbers = std::array<Real, size>;
    std::array<T, size> numbers;
    for (std::size_t n = 0; n < size; ++n) {
      numbers[n] = Lanes<T>::generated([&](std::size_t lane) {
        const auto& pair = packs.pair(p * width + lane);
        return std::bit_cast<Numbers>(pair_material_(sphere(pair.i).material, sphere(pair.j).material))[n];
      });
    }
    constants_ = std::bit_cast<PairMaterial<T>>(numbers);
    return constants_;
  }

  const Law& law_;
  PairMaterials pair_material_;
  const Domain& domain_;
  Real dt_;
  const std::byte* spheres_; // the records, from the first
  std::byte* forces_;
  PairMaterial<T> constants_{};
  std::uint32_t material_i_ = 0, material_j_ = 0;
  bool known_ = false;
  Real friction_ = 0, viscous_ = 0;
};

} // namespace detail

} // namespace scree
