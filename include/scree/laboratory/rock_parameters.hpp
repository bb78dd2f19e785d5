#pragma once
/// \file
/// The numbers of a rock model that may be looked for, by name.

#include "scree/core/error.hpp"
#include "scree/laboratory/rock_model.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace scree {

/// What a parameter is a parameter of. Each kind of experiment has all of these up to one that is its last:
/// grains that are counted and weighed touch nothing, those that are dropped are no bed.
enum class ExperimentPart { grains, contacts, bed, dragline };

struct RockParameter {
  std::string_view name;
  std::string_view unit;
  ExperimentPart of;
  bool logarithmic; ///< whether its effect goes by its proportion
  double (*get)(const RockModel&);
  void (*set)(RockModel&, double);
};

namespace detail {

/// \throws Error for rock without others
inline double share_of(const Assembly& assembly, std::size_t shape) {
  if (assembly.shapes().size() < std::max<std::size_t>(2, shape + 1)) {
    throw Error(message("rock of ", assembly.shapes().size(), " shapes has no share of shape ", shape + 1));
  }
  return assembly.shapes()[shape].fraction;
}
/// The share of one shape, at the cost of all others in proportion.
inline void set_share(Assembly& assembly, std::size_t shape, double share) {
  const double others = 1.0 - share_of(assembly, shape);
  std::vector<ShapeFraction> shapes = assembly.shapes();
  for (ShapeFraction& one : shapes) {
    one.fraction *= (1.0 - share) / others;
  }
  shapes[shape].fraction = share;
  assembly = Assembly{std::move(shapes), assembly.size_factor()};
}

} // namespace detail

/// Those of the gear are factors on what is stated of it, but for the offset of the load cell. The stiffness
/// of the rock takes its shear stiffness along, and that of the rig, in proportion. Porosity and angle go
/// nearly by the logarithm of friction (desk fidelity, 0.15 to 0.7), which few runs follow best.
inline constexpr std::array rock_parameters{
    RockParameter{"particle_density", "kg/m3", ExperimentPart::grains, true,
                  [](const RockModel& m) { return m.sample.rock.density; },
                  [](RockModel& m, double value) { m.sample.rock.density = value; }},
    RockParameter{"normal_stiffness", "N/m", ExperimentPart::contacts, true,
                  [](const RockModel& m) { return m.sample.rock.normal_stiffness; },
                  [](RockModel& m, double value) {
                    const double factor = value / m.sample.rock.normal_stiffness;
                    for (Material* material : {&m.sample.rock, &m.sample.rig}) {
                      material->normal_stiffness *= factor;
                      material->shear_stiffness *= factor;
                    }
                  }},
    RockParameter{
        "shear_ratio", "", ExperimentPart::contacts, false,
        [](const RockModel& m) { return m.sample.rock.shear_stiffness / m.sample.rock.normal_stiffness; },
        [](RockModel& m, double value) {
          for (Material* material : {&m.sample.rock, &m.sample.rig}) {
            material->shear_stiffness = value * material->normal_stiffness;
          }
        }},
    RockParameter{"friction", "", ExperimentPart::contacts, true,
                  [](const RockModel& m) { return m.sample.rock.friction; },
                  [](RockModel& m, double value) { m.sample.rock.friction = value; }},
    RockParameter{"rig_friction", "", ExperimentPart::contacts, true,
                  [](const RockModel& m) { return m.sample.rig.friction; },
                  [](RockModel& m, double value) { m.sample.rig.friction = value; }},
    RockParameter{
        "restitution", "", ExperimentPart::contacts, false,
        [](const RockModel& m) { return m.sample.rock.restitution; },
        [](RockModel& m, double value) { m.sample.rock.restitution = m.sample.rig.restitution = value; }},
    RockParameter{"rolling_friction", "", ExperimentPart::contacts, false,
                  [](const RockModel& m) { return m.sample.rock.rolling_friction; },
                  [](RockModel& m, double value) {
                    m.sample.rock.rolling_friction = m.sample.rig.rolling_friction = value;
                  }},
    RockParameter{"rolling_damping", "", ExperimentPart::contacts, false,
                  [](const RockModel& m) { return m.law.extension<RollingResistance>().damping; },
                  [](RockModel& m, double value) { m.law.extension<RollingResistance>().damping = value; }},
    RockParameter{"local_damping", "", ExperimentPart::contacts, false,
                  [](const RockModel& m) { return m.local_damping; },
                  [](RockModel& m, double value) { m.local_damping = value; }},
    RockParameter{"adhesion", "J/m2", ExperimentPart::contacts, false,
                  [](const RockModel& m) { return m.law.extension<Adhesion>().work; },
                  [](RockModel& m, double value) { m.law.extension<Adhesion>().work = value; }},
    RockParameter{"normal_exponent", "", ExperimentPart::contacts, false,
                  [](const RockModel& m) { return m.law.extension<NormalExponent>().exponent; },
                  [](RockModel& m, double value) { m.law.extension<NormalExponent>().exponent = value; }},
    RockParameter{"unloading_ratio", "", ExperimentPart::contacts, false,
                  [](const RockModel& m) { return m.law.extension<NormalHysteresis>().ratio; },
                  [](RockModel& m, double value) { m.law.extension<NormalHysteresis>().ratio = value; }},
    RockParameter{"friction_rate", "s/m", ExperimentPart::contacts, false,
                  [](const RockModel& m) { return m.law.extension<RateFriction>().slope; },
                  [](RockModel& m, double value) { m.law.extension<RateFriction>().slope = value; }},
    RockParameter{"attrition", "1/J", ExperimentPart::contacts, false,
                  [](const RockModel& m) { return m.law.extension<Attrition>().rate; },
                  [](RockModel& m, double value) { m.law.extension<Attrition>().rate = value; }},
    RockParameter{"packing_friction", "", ExperimentPart::bed, false,
                  [](const RockModel& m) { return m.packing_friction; },
                  [](RockModel& m, double value) { m.packing_friction = value; }},
    RockParameter{"size_factor", "", ExperimentPart::grains, true,
                  [](const RockModel& m) { return m.sample.assembly.size_factor(); },
                  [](RockModel& m, double value) {
                    m.sample.assembly = Assembly{m.sample.assembly.shapes(), value};
                  }},
    RockParameter{"first_shape_share", "", ExperimentPart::grains, false,
                  [](const RockModel& m) { return m.sample.assembly.shapes().front().fraction; },
                  [](RockModel& m, double value) { detail::set_share(m.sample.assembly, 0, value); }},
    RockParameter{"second_shape_share", "", ExperimentPart::grains, false,
                  [](const RockModel& m) { return detail::share_of(m.sample.assembly, 1); },
                  [](RockModel& m, double value) { detail::set_share(m.sample.assembly, 1, value); }},
    RockParameter{"third_shape_share", "", ExperimentPart::grains, false,
                  [](const RockModel& m) { return detail::share_of(m.sample.assembly, 2); },
                  [](RockModel& m, double value) { detail::set_share(m.sample.assembly, 2, value); }},
    RockParameter{"rope_stiffness", "", ExperimentPart::dragline, true,
                  [](const RockModel& m) { return m.gear.rope_stiffness; },
                  [](RockModel& m, double value) { m.gear.rope_stiffness = value; }},
    RockParameter{"load_cell_gain", "", ExperimentPart::dragline, false,
                  [](const RockModel& m) { return m.gear.load_cell_gain; },
                  [](RockModel& m, double value) { m.gear.load_cell_gain = value; }},
    RockParameter{"load_cell_offset", "N", ExperimentPart::dragline, false,
                  [](const RockModel& m) { return m.gear.load_cell_offset; },
                  [](RockModel& m, double value) { m.gear.load_cell_offset = value; }},
    RockParameter{"bucket_mass", "", ExperimentPart::dragline, true,
                  [](const RockModel& m) { return m.gear.bucket_mass; },
                  [](RockModel& m, double value) { m.gear.bucket_mass = value; }},
    RockParameter{"bucket_inertia", "", ExperimentPart::dragline, true,
                  [](const RockModel& m) { return m.gear.bucket_inertia; },
                  [](RockModel& m, double value) { m.gear.bucket_inertia = value; }},
    RockParameter{"floor_depth", "", ExperimentPart::dragline, false,
                  [](const RockModel& m) { return m.gear.floor_depth; },
                  [](RockModel& m, double value) { m.gear.floor_depth = value; }},
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
