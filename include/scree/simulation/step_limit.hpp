#pragma once
/// \file
/// The critical time step of a whole simulation, and what sets it.

#include "scree/contact/concept.hpp"
#include "scree/material/pair.hpp"
#include "scree/simulation/stable_step.hpp"
#include "scree/walls/wall.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

namespace scree {

/// Looks at the softest body of each material against every other and against the walls, and at the walls
/// that give way.
template <ContactLaw Law, class Real, class AnyWall>
class StepLimitSearch {
public:
  StepLimitSearch(const Bodies<Real>& bodies, std::span<const AnyWall> walls, const MaterialTable& materials,
                  const Law& law, double top_speed)
      : walls_{walls}, materials_{materials}, law_{law}, top_speed_{top_speed}, softest_(materials.size()) {
    for (std::size_t m = 0; m < softest_.size(); ++m) {
      softest_[m] = softest(bodies, id(m));
    }
  }

  StepLimit find() {
    for (std::size_t a = 0; a < softest_.size(); ++a) {
      for (std::size_t b = a; b < softest_.size(); ++b) {
        by_grains(a, b);
      }
    }
    for (const AnyWall& wall : walls_) {
      for (const WallSurface& surface : wall.surfaces) {
        for (std::size_t a = 0; a < softest_.size(); ++a) {
          by_grain_on(surface.material(), a);
        }
      }
      std::visit([&](const auto& dynamics) { by_wall(wall, dynamics); }, wall.dynamics);
    }
    return limit_;
  }

private:
  static MaterialId id(std::size_t m) { return static_cast<MaterialId>(m); }
  [[nodiscard]] const std::string& name(std::size_t m) const { return materials_.at(id(m)).name; }

  void by_grains(std::size_t a, std::size_t b) {
    const Softest &p = softest_[a], &q = softest_[b];
    if (p.mobility > 0.0 && q.mobility > 0.0) {
      by_contact(a, b, p.radius * q.radius / (p.radius + q.radius), p.mass * q.mass / (p.mass + q.mass),
                 p.mobility + q.mobility, [&] {
                   return message("a contact of body ", p.body, " ('", name(a), "', ", p.mass,
                                  " kg) with body ", q.body, " ('", name(b), "', ", q.mass, " kg)");
                 });
    }
  }

  void by_grain_on(MaterialId wall, std::size_t a) {
    const Softest& p = softest_[a];
    if (p.mobility > 0.0) {
      by_contact(a, wall, p.radius, p.mass, p.mobility, [&] {
        return message("a contact of body ", p.body, " ('", name(a), "', ", p.mass, " kg) with a wall of '",
                       name(wall), "'");
      });
    }
  }

  void by_contact(std::size_t a, std::size_t b, double radius, double mass, double mobility,
                  const auto& who) {
    const auto pair = materials_.pair(id(a), id(b));
    law_.check(pair, message("'", name(a), "' and '", name(b), "'"));
    const ContactStiffness k = law_.stiffness(pair, radius, mass, top_speed_);
    const double stiffest = std::max(k.normal, k.shear);
    const double rate = std::max(pair.normal_damping_rate, pair.shear_damping_rate);
    const double rate_ratio = stiffest > 0.0 ? 0.5 * rate * std::sqrt(mass / stiffest) : 0.0;
    limit_.lower_to(critical_step(crowding * stiffest * mobility, pair.damping_ratio + rate_ratio),
                    [&] { return message(who(), " of ", stiffest, " N/m"); });
  }

  /// A wall that gives way is held by its ropes and by the grains that touch it now.
  template <class Dynamics>
  void by_wall(const AnyWall& wall, const Dynamics& dynamics) {
    double squared_frequency = 0.0;
    std::string cause;
    if constexpr (IsHeld<Dynamics>) {
      squared_frequency += dynamics.squared_frequency();
      cause = dynamics.holder();
    }
    if constexpr (GivesWay<Dynamics>) {
      if (const std::size_t touching = wall.load.contacts; touching > 0) {
        const double arm = std::isfinite(wall.extent()) ? wall.extent() : 0.0;
        squared_frequency += static_cast<double>(touching) * stiffest_on(wall) * dynamics.mobility(arm);
        cause += message(cause.empty() ? "" : " and ", touching, " contacts of grains");
      }
    }
    if (squared_frequency > 0.0) {
      limit_.lower_to(critical_step(squared_frequency, 0.0),
                      [&] { return message("wall '", wall.name, "': ", cause); });
    }
  }

  [[nodiscard]] double stiffest_on(const AnyWall& wall) const {
    double most = 0.0;
    for (const WallSurface& surface : wall.surfaces) {
      for (std::size_t m = 0; m < softest_.size(); ++m) {
        if (softest_[m].mobility > 0.0) {
          const ContactStiffness k = law_.stiffness(materials_.pair(id(m), surface.material()),
                                                    softest_[m].radius, softest_[m].mass, top_speed_);
          most = std::max({most, k.normal, k.shear});
        }
      }
    }
    return most;
  }

  std::span<const AnyWall> walls_;
  const MaterialTable& materials_;
  const Law& law_;
  double top_speed_;
  std::vector<Softest> softest_;
  StepLimit limit_;
};

/// The critical step of bodies and walls under a law.
/// \throws Error where the law lacks a constant of a pair of materials that can touch.
template <ContactLaw Law, class Real, class AnyWall>
StepLimit step_limit(const Bodies<Real>& bodies, std::span<const AnyWall> walls,
                     const MaterialTable& materials, const Law& law, double top_speed) {
  return StepLimitSearch<Law, Real, AnyWall>{bodies, walls, materials, law, top_speed}.find();
}

} // namespace scree
