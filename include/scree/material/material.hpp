#pragma once
/// \file
/// What a grain or a wall is made of, in SI units.

#include "scree/core/error.hpp"

#include <cstdint>
#include <limits>
#include <string>

namespace scree {

/// Number of a material in the table of a simulation.
using MaterialId = std::uint16_t;

/// One material. A contact law reads the fields that it needs and refuses a material that lacks them.
struct Material {
  std::string name = "rock";
  double density = 2650.0; ///< kg/m3, of the solid as counted by the clump's mass convention, above 0

  /// Of a particle or of a contact, as `Stiffness` says.
  double normal_stiffness = 0.0; ///< N/m, above 0 for the linear laws
  double shear_stiffness = 0.0;  ///< N/m, 0 or above

  double youngs_modulus = 0.0; ///< Pa, above 0 for the Hertzian laws
  double poisson_ratio = 0.25; ///< in [0, 0.5]

  double friction = 0.5;         ///< Coulomb coefficient, 0 or above
  double restitution = 1.0;      ///< of a normal impact, in (0, 1]
  double rolling_friction = 0.0; ///< read by RollingResistance, 0 or above

  /// Dashpots in proportion to the reduced mass of the pair, as some codes define them; added to what
  /// `restitution` gives.
  double normal_damping_rate = 0.0; ///< 1/s, 0 or above
  double shear_damping_rate = 0.0;  ///< 1/s, 0 or above

  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {
    archive(self.name, self.density, self.normal_stiffness, self.shear_stiffness, self.youngs_modulus,
            self.poisson_ratio, self.friction, self.restitution, self.rolling_friction,
            self.normal_damping_rate, self.shear_damping_rate);
  }
};

/// What the stiffness of a material stands for.
enum class Stiffness {
  of_particle, ///< two particles touch through their springs in series, k = k1 k2 / (k1 + k2): the paper's
               ///< (PFC)
  of_contact   ///< the value is that of the contact; unlike materials take the smaller
};

/// \throws Error naming the material, the parameter, its value and its range.
inline void validate(const Material& m) {
  constexpr double most = std::numeric_limits<double>::max();
  const auto of = [&m](const char* parameter) { return message("material '", m.name, "': ", parameter); };
  require_positive(of("density"), m.density, "kg/m3");
  require(of("normal_stiffness"), m.normal_stiffness, {0.0, most, "N/m"});
  require(of("shear_stiffness"), m.shear_stiffness, {0.0, most, "N/m"});
  require(of("youngs_modulus"), m.youngs_modulus, {0.0, most, "Pa"});
  require(of("poisson_ratio"), m.poisson_ratio, {0.0, 0.5});
  require(of("friction"), m.friction, {0.0, most});
  require(of("restitution"), m.restitution, {1e-6, 1.0});
  require(of("rolling_friction"), m.rolling_friction, {0.0, most});
  require(of("normal_damping_rate"), m.normal_damping_rate, {0.0, most, "1/s"});
  require(of("shear_damping_rate"), m.shear_damping_rate, {0.0, most, "1/s"});
}

} // namespace scree
