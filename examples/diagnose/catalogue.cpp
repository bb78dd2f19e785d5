#include "diagnose/catalogue.hpp"

#include "scree/core/error.hpp"
#include "scree/laboratory/rock_parameters.hpp"
#include "support/comma_list.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <set>
#include <string_view>
#include <utility>

namespace diagnose {

using namespace scree;
namespace ex = scree::examples;

namespace {

/// What a parameter of the rock or the gear may be, at most.
struct Range {
  std::string_view parameter{};
  double least = 0.0, most = 0.0; ///< times the null value where `times_null`
  bool times_null = false;
  std::size_t shapes = 1; ///< that the rock must have, for the parameter to mean something
};
/// Ranges are what rock and rigs have; all are ours.
struct Entry {
  std::string_view name;
  std::array<Range, 2> ranges; ///< the second may have no parameter
  std::string_view extension, separated_by;
};
constexpr std::array entries{
    Entry{"rolling_resistance",
          {Range{"rolling_friction", 0.0, 0.5}},
          "Contact = LinearSpring<RollingResistance>, Material::rolling_friction",
          "tilt_test of single rocks; bulk_density at another packing_friction"},
    Entry{"adhesion",
          {Range{"adhesion", 0.0, 4.0}},
          "Contact = LinearSpring<Adhesion>",
          "angle_of_repose of two sizes"},
    Entry{"normal_law",
          {Range{"normal_exponent", 1.0, 1.6}},
          "Contact = LinearSpring<NormalExponent>",
          "oedometer between other loads"},
    Entry{"normal_hysteresis",
          {Range{"unloading_ratio", 1.0, 3.0}},
          "Contact = LinearSpring<NormalHysteresis>",
          "drop_test at two heights"},
    Entry{"wall_friction",
          {Range{"rig_friction", 0.02, 0.9}},
          "Material::friction of the rig",
          "oedometer with the force on its base"},
    Entry{"damping", {Range{"restitution", 0.15, 0.95}}, "Material::restitution", "drop_test at two heights"},
    Entry{"initial_packing",
          {Range{"packing_friction", 0.1, 2.0}},
          "FillRecipe::packing_friction",
          "immersion; bulk_density at another packing_friction"},
    Entry{"particle_density", {Range{"particle_density", 0.7, 1.4, true}}, "Material::density", "immersion"},
    Entry{
        "shape_fraction",
        {Range{"first_shape_share", 0.02, 0.95, false, 2}, Range{"second_shape_share", 0.0, 0.95, false, 3}},
        "ShapeFraction::fraction of the first and second shapes",
        "bulk_density at another packing_friction"},
    Entry{"size_scale",
          {Range{"size_factor", 0.7, 1.5, true}},
          "Assembly(shapes, size_factor)",
          "immersion, whose grains are counted"},
    Entry{"rate_friction",
          {Range{"friction_rate", -1.0, 3.0}},
          "Contact = LinearSpring<RateFriction>",
          "angle_of_repose with another height of fall"},
    Entry{"attrition",
          {Range{"attrition", 0.0, 300.0}},
          "Contact = LinearSpring<Attrition>",
          "oedometer over more cycles"},
    Entry{"rope_stiffness",
          {Range{"rope_stiffness", 0.1, 10.0, true}},
          "DragSetup::rope_stiffness",
          "drag with the rope wound in beside it (lag_m)"},
    Entry{"load_cell",
          {Range{"load_cell_gain", 0.7, 1.4}, Range{"load_cell_offset", -50.0, 50.0}},
          "nothing: the readings are to be mended, Gear::reading",
          "a dead weight on the rope"},
    Entry{"bucket_inertia",
          {Range{"bucket_mass", 0.6, 1.7}, Range{"bucket_inertia", 0.5, 2.0}},
          "BucketBody::body, mass and inertia",
          "the bucket hung up and weighed"},
    Entry{"bed_floor", {Range{"floor_depth", 0.6, 1.2}}, "DragSetup::bed_depth", "drag in a deeper bed"}};

/// \throws Error for a name that is none of the causes.
void refuse_unknown(const std::set<std::string>& names) {
  for (const std::string& name : names) {
    if (std::none_of(entries.begin(), entries.end(), [&](const Entry& e) { return e.name == name; })) {
      std::string known;
      for (const Entry& e : entries) {
        known += message(known.empty() ? "" : ", ", e.name);
      }
      throw Error(message("causes: there is no '", name, "'; there are ", known));
    }
  }
}

bool any_of_kinds(const ex::Plan& plan, const std::vector<std::string>& kinds) {
  return std::any_of(plan.experiments.begin(), plan.experiments.end(), [&](const ex::PlannedExperiment& e) {
    return std::find(kinds.begin(), kinds.end(), e.kind) != kinds.end();
  });
}

} // namespace

std::vector<Cause> catalogue(const ex::Plan& plan, const std::string& only) {
  const std::vector<std::string> listed = ex::comma_list(only);
  const std::set<std::string> wanted{listed.begin(), listed.end()};
  refuse_unknown(wanted);
  std::vector<Cause> out;
  for (const Entry& e : entries) {
    if (!wanted.empty() && !wanted.contains(std::string{e.name})) {
      continue;
    }
    Cause cause{.name = std::string{e.name},
                .parameters = {},
                .null = {},
                .extension = std::string{e.extension},
                .separated_by = {std::string{e.separated_by}}};
    for (const Range& range : e.ranges) {
      const bool looked_for = std::any_of(plan.space.begin(), plan.space.end(),
                                          [&](const Parameter& p) { return p.name == range.parameter; });
      if (range.parameter.empty() || looked_for ||
          plan.model.sample.assembly.shapes().size() < range.shapes) {
        continue;
      }
      const RockParameter& parameter = rock_parameter(range.parameter);
      std::vector<std::string> touches = ex::kinds_that_show(parameter);
      if (!any_of_kinds(plan, touches)) {
        continue;
      }
      const double null = parameter.get(plan.model), factor = range.times_null ? null : 1.0;
      cause.parameters.push_back({std::string{range.parameter}, std::string{parameter.unit},
                                  range.least * factor, range.most * factor, parameter.logarithmic,
                                  std::move(touches)});
      cause.null.push_back(null);
    }
    if (!cause.parameters.empty()) {
      out.push_back(std::move(cause));
    }
  }
  return out;
}

} // namespace diagnose
