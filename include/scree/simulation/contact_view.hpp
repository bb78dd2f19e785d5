#pragma once
/// \file
/// Contacts as observers see them.

#include "scree/material/pair.hpp"
#include "scree/simulation/domain.hpp"
#include "scree/simulation/touch.hpp"
#include "scree/state/bodies.hpp"
#include "scree/state/pair_list.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

namespace scree {

/// A contact as observers see it. `second` is the number of a body, or of a wall where `with_wall` is set.
struct ContactView {
  std::size_t first, second;
  bool with_wall;
  Vector point;          ///< m
  Vector normal;         ///< unit vector from the second to the first
  double overlap;        ///< m
  Vector force;          ///< N, on the first
  double elastic_energy; ///< J, in its springs
};

namespace detail {

/// Looks at contacts without changing them.
template <class Law, class Real>
class ContactViewer {
public:
  ContactViewer(const Law& law, const MaterialTable& materials, const Domain& domain,
                const Bodies<Real>& bodies)
      : law_{law}, materials_{materials}, domain_{domain}, bodies_{bodies} {}

  /// Of all pairs on the list, with a history for each, those that touch: as the law gives them for the
  /// present positions.
  template <class Pairs, class Histories, class Visit>
  void visit_pairs(const Pairs& pairs, const Histories& histories, Visit& visit) {
    for (std::size_t i = 0; i < pairs.row_count(); ++i) {
      for (std::size_t pair = pairs.begin_of(i); pair < pairs.begin_of(i + 1); ++pair) {
        visit_pair(i, pairs.partner(pair), histories[pair], visit);
      }
    }
  }

  /// As they were in the last step.
  template <class WallContacts, class AnyWall, class Visit>
  void visit_wall_contacts(const WallContacts& contacts, std::span<const AnyWall> walls, Visit& visit) {
    for (const auto& c : contacts) {
      const auto& sphere = bodies_.spheres()[c.sphere];
      const auto& pair = pair_of(sphere.material, walls[c.wall].surfaces[c.surface].material());
      visit(ContactView{bodies_.body_of(c.sphere), c.wall, true, c.point, c.normal, c.overlap, c.force,
                        energy_of(pair, sphere.radius, c.overlap, c.history)});
    }
  }

private:
  /// Most contacts are of the materials of the one before, and to mix two means to look for a root.
  const PairMaterial<double>& pair_of(std::uint32_t a, std::uint32_t b) {
    if (!known_ || a != a_ || b != b_) {
      pair_ = materials_.pair(static_cast<MaterialId>(a), static_cast<MaterialId>(b));
      known_ = true;
      a_ = a;
      b_ = b;
    }
    return pair_;
  }

  template <class History>
  [[nodiscard]] double energy_of(const PairMaterial<double>& pair, double reduced_radius, double overlap,
                                 const History& history) const {
    std::array<double, static_cast<std::size_t>(Law::history_size)> h{};
    std::copy(history.begin(), history.end(), h.begin());
    return law_.elastic_energy(pair, reduced_radius, overlap, h);
  }

  template <class History, class Visit>
  void visit_pair(std::size_t i, Partner partner, History history, Visit& visit) {
    const auto &own = bodies_.spheres()[i], &other = bodies_.spheres()[partner.sphere];
    const Vec3<double> apart = own.position - other.position - domain_.shift(partner.image);
    const double d2 = squared_norm(apart), reach = own.radius + other.radius;
    if (d2 >= reach * reach) {
      return;
    }
    const Touch<Real> touch = touch_of(own, other, apart, d2, Real{0});
    const auto& pair = pair_of(own.material, other.material);
    const ContactForce<Real> f = law_.evaluate(pair.template as<Real>(), touch.kinematics, history);
    const Vector normal = to_eigen(touch.kinematics.normal);
    const auto overlap = static_cast<double>(touch.kinematics.overlap);
    const double energy =
        energy_of(pair, static_cast<double>(touch.kinematics.reduced_radius), overlap, history);
    visit(ContactView{bodies_.body_of(i), bodies_.body_of(partner.sphere), false,
                      to_eigen(own.position) - static_cast<double>(touch.arm_i) * normal, normal, overlap,
                      to_eigen(touch.kinematics.normal * f.normal + f.tangential), energy});
  }

  const Law& law_;
  const MaterialTable& materials_;
  const Domain& domain_;
  const Bodies<Real>& bodies_;
  PairMaterial<double> pair_{};
  std::uint32_t a_ = 0, b_ = 0;
  bool known_ = false;
};

} // namespace detail

} // namespace scree
