#pragma once
/// \file
/// The constants of a contact between two materials.

#include "scree/material/material.hpp"
#include "scree/material/restitution.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace scree {

/// Constants of a contact, in the number type of the contact law.
template <class T>
struct PairMaterial {
  T normal_stiffness{};        ///< N/m, of the contact
  T shear_stiffness{};         ///< N/m, of the contact
  T inverse_shear_stiffness{}; ///< m/N; 0 where there is no shear stiffness
  T youngs_modulus{};          ///< Pa, E* of Hertz
  T shear_modulus{};           ///< Pa, G* of Mindlin
  T friction{};
  T rolling_friction{};
  T damping_ratio{};              ///< of critical, along the normal, from the restitution
  T shear_damping_ratio{};        ///< of critical, in shear, from the restitution
  T normal_damping_coefficient{}; ///< sqrt(kg/m) s^-1: 2 ratio sqrt(k_n), times sqrt(m*) gives N s/m
  T shear_damping_coefficient{};  ///< the same in shear
  T normal_damping_rate{};        ///< 1/s, times m* gives N s/m
  T shear_damping_rate{};         ///< 1/s

  template <class U>
  [[nodiscard]] PairMaterial<U> as() const {
    const auto c = [](T value) { return static_cast<U>(value); };
    return {c(normal_stiffness),
            c(shear_stiffness),
            c(inverse_shear_stiffness),
            c(youngs_modulus),
            c(shear_modulus),
            c(friction),
            c(rolling_friction),
            c(damping_ratio),
            c(shear_damping_ratio),
            c(normal_damping_coefficient),
            c(shear_damping_coefficient),
            c(normal_damping_rate),
            c(shear_damping_rate)};
  }
};

/// Values of a pair of materials that were measured for the pair, in place of the mixed ones.
struct PairOverride {
  std::optional<double> friction{};
  std::optional<double> restitution{};
  std::optional<double> rolling_friction{};

  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {
    archive(self.friction, self.restitution, self.rolling_friction);
  }
};

/// Mixes two materials: stiffness as `convention` says; E* and G* of Hertz and Mindlin; the smaller friction,
/// rolling friction and restitution; the mean damping rates.
inline PairMaterial<double> mix(const Material& a, const Material& b, Stiffness convention,
                                const PairOverride& given = {}) {
  const auto stiffness = [convention](double p, double q) {
    if (convention == Stiffness::of_contact) {
      return std::min(p, q);
    }
    return p + q > 0.0 ? p * q / (p + q) : 0.0;
  };
  const auto series = [](double p, double q) { return p > 0.0 && q > 0.0 ? 1.0 / (1.0 / p + 1.0 / q) : 0.0; };
  const auto plane = [](const Material& m) {
    return m.youngs_modulus / (1.0 - m.poisson_ratio * m.poisson_ratio);
  };
  const auto shear = [](const Material& m) {
    return m.youngs_modulus / (2.0 * (1.0 + m.poisson_ratio) * (2.0 - m.poisson_ratio));
  };
  PairMaterial<double> p;
  p.normal_stiffness = stiffness(a.normal_stiffness, b.normal_stiffness);
  p.shear_stiffness = stiffness(a.shear_stiffness, b.shear_stiffness);
  p.inverse_shear_stiffness = p.shear_stiffness > 0.0 ? 1.0 / p.shear_stiffness : 0.0;
  p.youngs_modulus = series(plane(a), plane(b));
  p.shear_modulus = series(shear(a), shear(b));
  p.friction = given.friction.value_or(std::min(a.friction, b.friction));
  p.rolling_friction = given.rolling_friction.value_or(std::min(a.rolling_friction, b.rolling_friction));
  const double e = given.restitution.value_or(std::min(a.restitution, b.restitution));
  p.damping_ratio = damping_ratio(e);
  p.shear_damping_ratio = half_oscillation_ratio(e);
  p.normal_damping_coefficient = 2.0 * p.damping_ratio * std::sqrt(p.normal_stiffness);
  p.shear_damping_coefficient = 2.0 * p.shear_damping_ratio * std::sqrt(p.shear_stiffness);
  p.normal_damping_rate = 0.5 * (a.normal_damping_rate + b.normal_damping_rate);
  p.shear_damping_rate = 0.5 * (a.shear_damping_rate + b.shear_damping_rate);
  return p;
}

/// The materials of a simulation and what was measured of their pairs.
class MaterialTable {
public:
  explicit MaterialTable(Stiffness convention = Stiffness::of_particle) : convention_{convention} {}

  /// \throws Error for a parameter out of range.
  MaterialId add(Material material) {
    validate(material);
    materials_.push_back(std::move(material));
    return static_cast<MaterialId>(materials_.size() - 1);
  }

  /// Puts another material in the place of one.
  /// \throws Error for a parameter out of range or an unknown material.
  void replace(MaterialId id, const Material& material) {
    validate(material);
    (void)at(id);
    materials_[id] = material;
  }

  /// \throws Error for a parameter out of range or an unknown material.
  void set_pair(MaterialId a, MaterialId b, const PairOverride& given) {
    check_pair(a, b, given);
    overrides_[std::minmax(a, b)] = given;
  }

  [[nodiscard]] const Material& at(MaterialId id) const {
    if (id >= materials_.size()) {
      throw Error(message("material number ", id, " is unknown: the table holds ", materials_.size()));
    }
    return materials_[id];
  }
  [[nodiscard]] std::size_t size() const { return materials_.size(); }
  [[nodiscard]] Stiffness convention() const { return convention_; }

  [[nodiscard]] PairMaterial<double> pair(MaterialId a, MaterialId b) const {
    const auto found = overrides_.find(std::minmax(a, b));
    return mix(at(a), at(b), convention_, found != overrides_.end() ? found->second : PairOverride{});
  }

  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {
    [[maybe_unused]] const std::size_t count = self.materials_.size();
    archive(self.materials_, self.overrides_);
    if constexpr (Archive::reading) {
      try {
        if (self.materials_.size() != count) {
          throw Error(message(self.materials_.size(), " materials where ", count, " are"));
        }
        for (const Material& material : self.materials_) {
          validate(material);
        }
        for (const auto& [pair, given] : self.overrides_) {
          self.check_pair(pair.first, pair.second, given);
        }
      } catch (const Error& error) {
        archive.fail(printable(error.what()));
      }
    }
  }

private:
  void check_pair(MaterialId a, MaterialId b, const PairOverride& given) const {
    const auto name = [&](const char* parameter) {
      return message("pair '", at(a).name, "'-'", at(b).name, "': ", parameter);
    };
    constexpr double most = std::numeric_limits<double>::max();
    require(name("friction"), given.friction.value_or(0.0), {0.0, most});
    require(name("rolling_friction"), given.rolling_friction.value_or(0.0), {0.0, most});
    require(name("restitution"), given.restitution.value_or(1.0), {1e-6, 1.0});
  }

  Stiffness convention_;
  std::vector<Material> materials_;
  std::map<std::pair<MaterialId, MaterialId>, PairOverride> overrides_;
};

} // namespace scree
