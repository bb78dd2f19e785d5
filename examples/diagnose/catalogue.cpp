#include "diagnose/catalogue.hpp"

#include "scree/core/error.hpp"
#include "scree/laboratory/rock_parameters.hpp"
#include "support/comma_list.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <set>
#include <string_view>

namespace diagnose {

using namespace scree;
namespace ex = scree::examples;

namespace {

/// A cause with one parameter of the rock. Ranges are what rock and rigs have, at most; all are ours.
struct Entry {
  std::string_view name, parameter;
  double least, most; ///< times the null value where `times_null`
  bool times_null;
  std::string_view extension, separated_by;
};
constexpr std::array entries{
    Entry{"rolling_resistance", "rolling_friction", 0.0, 0.5, false,
          "Contact = LinearSpring<RollingResistance>, Material::rolling_friction",
          "tilt_test of single rocks; bulk_density at another packing_friction"},
    Entry{"adhesion", "adhesion", 0.0, 4.0, false, "Contact = LinearSpring<Adhesion>",
          "angle_of_repose of two sizes"},
    Entry{"normal_law", "normal_exponent", 1.0, 1.6, false, "Contact = LinearSpring<NormalExponent>",
          "oedometer between other loads"},
    Entry{"normal_hysteresis", "unloading_ratio", 1.0, 3.0, false, "Contact = LinearSpring<NormalHysteresis>",
          "drop_test at two heights"},
    Entry{"wall_friction", "rig_friction", 0.02, 0.9, false, "Material::friction of the rig",
          "oedometer with the force on its base"},
    Entry{"damping", "restitution", 0.15, 0.95, false, "Material::restitution", "drop_test at two heights"},
    Entry{"initial_packing", "packing_friction", 0.1, 2.0, false, "FillRecipe::packing_friction",
          "immersion; bulk_density at another packing_friction"},
    Entry{"particle_density", "particle_density", 0.7, 1.4, true, "Material::density", "immersion"},
    Entry{"shape_fraction", "first_shape_share", 0.02, 0.95, false,
          "ShapeFraction::fraction of the first shape", "bulk_density at another packing_friction"},
    Entry{"size_scale", "size_factor", 0.7, 1.5, true, "Assembly(shapes, size_factor)",
          "immersion, whose grains are counted"},
    Entry{"rate_friction", "friction_rate", -1.0, 3.0, false, "Contact = LinearSpring<RateFriction>",
          "angle_of_repose with another height of fall"},
    Entry{"attrition", "attrition", 0.0, 300.0, false, "Contact = LinearSpring<Attrition>",
          "oedometer over more cycles"}};

} // namespace

std::vector<Cause> catalogue(const ex::Plan& plan, const std::string& only) {
  const std::vector<std::string> listed = ex::comma_list(only);
  std::set<std::string> wanted{listed.begin(), listed.end()};
  std::vector<Cause> out;
  std::string known;
  for (const Entry& e : entries) {
    known += message(known.empty() ? "" : ", ", e.name);
    const std::string name{e.name};
    if (!only.empty() && wanted.erase(name) == 0) {
      continue;
    }
    const bool looked_for = std::any_of(plan.space.begin(), plan.space.end(),
                                        [&](const Parameter& p) { return p.name == e.parameter; });
    if (looked_for) {
      continue;
    }
    const RockParameter& parameter = rock_parameter(e.parameter);
    const double null = parameter.get(plan.model), factor = e.times_null ? null : 1.0;
    out.push_back({.name = name,
                   .parameters = {{std::string{e.parameter}, std::string{parameter.unit}, e.least * factor,
                                   e.most * factor, parameter.logarithmic}},
                   .null = {null},
                   .extension = std::string{e.extension},
                   .separated_by = {std::string{e.separated_by}}});
  }
  if (!wanted.empty()) {
    throw Error(message("causes: there is no '", *wanted.begin(), "'; there are ", known));
  }
  return out;
}

} // namespace diagnose
