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
                  const Law& law, double top_speed, std::span<const std::size_t> near_walls)
      : walls_{walls},
        materials_{materials},
        law_{law},
        top_speed_{top_speed},
        near_walls_{near_walls},
        softest_(materials.size()) {
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
    for (std::size_t w = 0; w < walls_.size(); ++w) {
      const AnyWall& wall = walls_[w];
      for (const WallSurface& surface : wall.surfaces) {
        for (std::size_t a = 0; a < softest_.size(); ++a) {
          by_grain_on(surface.material(), a);
        }
      }
      std::visit(
          [&](const auto& dynamics) { by_wall(wall, w < near_walls_.size() ? near_walls_[w] : 0, dynamics); },
          wall.dynamics);
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
                 p.mobility + q.mobility, p.normal_mobility + q.normal_mobility, [&] {
                   return message("a contact of body ", p.body, " ('", name(a), "', ", p.mass,
                                  " kg) with body ", q.body, " ('", name(b), "', ", q.mass, " kg)");
                 });
    }
  }

  void by_grain_on(MaterialId wall, std::size_t a) {
    const Softest& p = softest_[a];
    if (p.mobility > 0.0) {
      by_contact(a, wall, p.radius, p.mass, p.mobility, p.normal_mobility, [&] {
        return message("a contact of body ", p.body, " ('", name(a), "', ", p.mass, " kg) with a wall of '",
                       name(wall), "'");
      });
    }
  }

  void by_contact(std::size_t a, std::size_t b, double radius, double mass, double mobility,
                  double normal_mobility, const auto& who) {
    const auto pair = materials_.pair(id(a), id(b));
    law_.check(pair, message("'", name(a), "' and '", name(b), "'"));
    const ContactStiffness k = law_.stiffness(pair, radius, mass, top_speed_);
    const auto lower_by = [&](double stiffness, double own_ratio, double rate, double softness) {
      const double ratio = own_ratio + (stiffness > 0.0 ? 0.5 * rate * std::sqrt(mass / stiffness) : 0.0);
      limit_.lower_to(critical_step(softness * stiffness, ratio * std::sqrt(softness * mass)),
                      [&] { return message(who(), " of ", stiffness, " N/m"); });
    };
    lower_by(std::max(k.normal, k.shear), pair.shear_damping_ratio,
             std::max(pair.normal_damping_rate, pair.shear_damping_rate), crowding * mobility);
    lower_by(k.normal, pair.damping_ratio, pair.normal_damping_rate,
             crowding_along_normals * normal_mobility);
  }

  /// A wall that gives way is held by its ropes and by the `near` spheres that touch it or may soon.
  template <class Dynamics>
  void by_wall(const AnyWall& wall, std::size_t near, const Dynamics& dynamics) {
    double squared_frequency = 0.0, damping_rate = 0.0; // rad2/s2, 1/s
    std::string cause;
    if constexpr (IsHeld<Dynamics>) {
      squared_frequency += dynamics.squared_frequency();
      cause = dynamics.holder();
      if constexpr (requires { dynamics.damping_rate(); }) {
        damping_rate += dynamics.damping_rate();
      }
    }
    if constexpr (GivesWay<Dynamics>) {
      if (near > 0) {
        const double mobility = dynamics.mobility(std::isfinite(wall.extent()) ? wall.extent() : 0.0);
        const Grip grip = stiffest_on(wall);
        squared_frequency += static_cast<double>(near) * grip.stiffness * mobility;
        damping_rate += static_cast<double>(near) * grip.damping * mobility;
        cause += message(cause.empty() ? "" : " and ", near, " spheres that touch it or may soon");
      }
    }
    if (squared_frequency > 0.0) {
      limit_.lower_to(critical_step(squared_frequency, 0.5 * damping_rate / std::sqrt(squared_frequency)),
                      [&] { return message("wall '", wall.name, "': ", cause); });
    }
  }

  /// Of one contact of a grain with a wall.
  struct Grip {
    double stiffness = 0.0; ///< N/m
    double damping = 0.0;   ///< N s/m
  };

  [[nodiscard]] Grip stiffest_on(const AnyWall& wall) const {
    Grip most;
    for (const WallSurface& surface : wall.surfaces) {
      for (std::size_t m = 0; m < softest_.size(); ++m) {
        const Softest& body = softest_[m];
        if (body.mobility > 0.0) {
          const auto pair = materials_.pair(id(m), surface.material());
          const ContactStiffness k = law_.stiffness(pair, body.radius, body.mass, top_speed_);
          const auto dashpot = [&](double stiffness, double ratio, double rate) {
            return 2.0 * ratio * std::sqrt(stiffness * body.mass) + rate * body.mass;
          };
          most.stiffness = std::max({most.stiffness, k.normal, k.shear});
          most.damping =
              std::max({most.damping, dashpot(k.normal, pair.damping_ratio, pair.normal_damping_rate),
                        dashpot(k.shear, pair.shear_damping_ratio, pair.shear_damping_rate)});
        }
      }
    }
    return most;
  }

  std::span<const AnyWall> walls_;
  const MaterialTable& materials_;
  const Law& law_;
  double top_speed_;
  std::span<const std::size_t> near_walls_;
  std::vector<Softest> softest_;
  StepLimit limit_;
};

/// The critical step of bodies and walls under a law. `near_walls`: how many spheres are near each wall; none
/// if not yet known.
/// \throws Error where the law lacks a constant of a pair of materials that can touch.
template <ContactLaw Law, class Real, class AnyWall>
StepLimit step_limit(const Bodies<Real>& bodies, std::span<const AnyWall> walls,
                     const MaterialTable& materials, const Law& law, double top_speed,
                     std::span<const std::size_t> near_walls = {}) {
  return StepLimitSearch<Law, Real, AnyWall>{bodies, walls, materials, law, top_speed, near_walls}.find();
}

} // namespace scree
