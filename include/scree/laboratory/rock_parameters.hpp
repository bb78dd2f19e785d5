#pragma once
/// \file
/// The numbers of a rock sample that a calibration may look for, by name.

#include "scree/core/error.hpp"
#include "scree/laboratory/rock_sample.hpp"

#include <array>
#include <string>
#include <string_view>

namespace scree {

struct RockParameter {
  std::string_view name;
  std::string_view unit;
  bool logarithmic; ///< whether its effect goes by its proportion
  double (*get)(const RockSample&);
  void (*set)(RockSample&, double);
};

/// The stiffness of the rock takes its shear stiffness along, and that of the rig, in proportion.
inline constexpr std::array rock_parameters{
    RockParameter{"particle_density", "kg/m3", true, [](const RockSample& s) { return s.rock.density; },
                  [](RockSample& s, double value) { s.rock.density = value; }},
    RockParameter{"normal_stiffness", "N/m", true,
                  [](const RockSample& s) { return s.rock.normal_stiffness; },
                  [](RockSample& s, double value) {
                    const double factor = value / s.rock.normal_stiffness;
                    for (Material* m : {&s.rock, &s.rig}) {
                      m->normal_stiffness *= factor;
                      m->shear_stiffness *= factor;
                    }
                  }},
    RockParameter{"shear_ratio", "", false,
                  [](const RockSample& s) { return s.rock.shear_stiffness / s.rock.normal_stiffness; },
                  [](RockSample& s, double value) {
                    for (Material* m : {&s.rock, &s.rig}) {
                      m->shear_stiffness = value * m->normal_stiffness;
                    }
                  }},
    RockParameter{"friction", "", false, [](const RockSample& s) { return s.rock.friction; },
                  [](RockSample& s, double value) { s.rock.friction = value; }},
    RockParameter{"rig_friction", "", false, [](const RockSample& s) { return s.rig.friction; },
                  [](RockSample& s, double value) { s.rig.friction = value; }},
    RockParameter{"restitution", "", false, [](const RockSample& s) { return s.rock.restitution; },
                  [](RockSample& s, double value) { s.rock.restitution = s.rig.restitution = value; }},
};

/// \throws Error for a name that is none of them.
inline const RockParameter& rock_parameter(std::string_view name) {
  std::string known;
  for (const RockParameter& p : rock_parameters) {
    if (p.name == name) {
      return p;
    }
    known += message(known.empty() ? "" : ", ", p.name);
  }
  throw Error(message("there is no parameter '", name, "' of rock; there are ", known));
}

} // namespace scree
