#include "make_measured/effects.hpp"

#include "scree/core/error.hpp"
#include "scree/io/number_text.hpp"
#include "scree/laboratory/rock_parameters.hpp"
#include "support/comma_list.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

namespace make_measured {

using namespace scree;
namespace ex = scree::examples;

namespace {

/// How large one parameter of an effect may be.
struct Size {
  std::string_view parameter{};
  double least = 0.0, most = 0.0;           ///< that make sense
  double auto_least = 0.0, auto_most = 0.0; ///< that are drawn, times the null value where `times_null`
  bool times_null = false;
};
/// One that there is. Typed in here, not taken from the catalogue of the diagnosis, so that a mistake there
/// is not made here too. All ranges of "auto" are ours: what experiments at desk fidelity can show.
struct Known {
  std::string_view name;
  std::array<Size, 2> sizes;    ///< the second may have no parameter
  std::string_view only_with{}; ///< the one kind of experiment that shows it; empty: any may
  std::string_view form{};      ///< other than that of the causes; empty: as those
};
constexpr std::array known{
    Known{"rolling_resistance", {Size{"rolling_friction", 0.0, 2.0, 0.08, 0.3}}},
    Known{"rolling_resistance", // overdamped, so that rocks creep where they would rock
          {Size{"rolling_friction", 0.0, 2.0, 0.08, 0.3}, Size{"rolling_damping", 0.0, 1e3, 2.0, 4.0}},
          "",
          "dashpot"},
    Known{"adhesion", {Size{"adhesion", 0.0, 1e3, 0.6, 2.5}}},
    Known{"normal_law", {Size{"normal_exponent", 1.0, 2.0, 1.2, 1.5}}},
    Known{"normal_hysteresis", {Size{"unloading_ratio", 1.0, 100.0, 1.3, 2.2}}},
    Known{"wall_friction", {Size{"rig_friction", 1e-3, 2.0, 0.05, 0.18}}},
    Known{"damping", {Size{"restitution", 0.01, 1.0, 0.25, 0.45}}},
    // Of every force, not of contacts alone (Cundall).
    Known{"damping", {Size{"local_damping", 0.0, 0.999, 0.25, 0.5}}, "", "local"},
    Known{"initial_packing", {Size{"packing_friction", 1e-3, 1e3, 0.2, 0.5}}},
    Known{"particle_density", {Size{"particle_density", 1.0, 2e4, 1.1, 1.3, true}}},
    // The first is the share before the second takes its own.
    Known{"shape_fraction",
          {Size{"first_shape_share", 0.0, 1.0, 0.6, 0.9}, Size{"second_shape_share", 0.0, 1.0, 0.0, 0.8}}},
    Known{"shape_fraction", {Size{"third_shape_share", 0.0, 1.0, 0.5, 0.8}}, "", "third_shape"},
    Known{"size_scale", {Size{"size_factor", 0.05, 50.0, 1.15, 1.35, true}}},
    Known{"rate_friction", {Size{"friction_rate", -1e3, 1e3, 0.5, 2.0}}},
    Known{"attrition", {Size{"attrition", 0.0, 1e9, 30.0, 200.0}}},
    Known{"rope_stiffness", {Size{"rope_stiffness", 1e-3, 1e3, 0.15, 0.4}}, "drag"},
    Known{"load_cell",
          {Size{"load_cell_gain", 0.1, 10.0, 1.15, 1.35}, Size{"load_cell_offset", -1e4, 1e4, -15.0, 15.0}},
          "drag"},
    Known{"bucket_inertia",
          {Size{"bucket_mass", 0.1, 10.0, 1.3, 1.6}, Size{"bucket_inertia", 0.1, 10.0, 0.7, 1.5}},
          "drag"},
    Known{"bed_floor", {Size{"floor_depth", 0.1, 10.0, 0.65, 0.8}}, "drag"}};

/// As it is called: "NAME" or "NAME:FORM".
std::string called(const Known& effect) {
  return effect.form.empty() ? std::string{effect.name} : message(effect.name, ":", effect.form);
}

/// \throws Error for a name that is none, or whose effect no experiment of the plan shows.
const Known& effect_of(const std::string& one, const std::string& name, const ex::Plan& plan) {
  const auto found =
      std::find_if(known.begin(), known.end(), [&](const Known& k) { return called(k) == name; });
  if (found == known.end()) {
    std::string names;
    for (const Known& k : known) {
      names += message(names.empty() ? "" : ", ", called(k));
    }
    throw Error(message("effect = ", one, ": there is no effect '", name, "'; there are ", names));
  }
  const bool shown = std::any_of(plan.experiments.begin(), plan.experiments.end(),
                                 [&](const auto& e) { return e.kind == found->only_with; });
  if (!found->only_with.empty() && !shown) {
    throw Error(message("effect = ", one, ": only experiments of the kind ", found->only_with,
                        " show it, and this plan has none"));
  }
  return *found;
}

/// "VALUE" or "VALUE:VALUE" as its parts; "auto" is for all parameters at once.
std::vector<std::string> values_in(const std::string& text, std::size_t parameters) {
  if (text == "auto") {
    return std::vector<std::string>(parameters, text);
  }
  const std::size_t colon = text.find(':');
  std::vector<std::string> out{text.substr(0, colon)};
  if (colon != std::string::npos) {
    out.push_back(text.substr(colon + 1));
  }
  return out;
}

double value_of(const std::string& one, const std::string& name, const Size& size, const std::string& text,
                double null, std::string_view unit, Random& sizes) {
  if (text == "auto") {
    return sizes.uniform(size.auto_least, size.auto_most) * (size.times_null ? null : 1.0);
  }
  const auto number = parse_number(text);
  if (!number) {
    throw Error(message("effect = ", one, ": '", text, "' is neither a number nor auto"));
  }
  return require(message("effect ", name), *number, {size.least, size.most, unit});
}

} // namespace

std::vector<Effect> effects_in(const std::string& text, const ex::Plan& plan, Random& sizes) {
  std::vector<Effect> out;
  for (const std::string& one : ex::comma_list(text)) {
    const std::size_t equals = one.find('=');
    const std::string name = one.substr(0, equals);
    const Known& effect = effect_of(one, name, plan);
    const std::size_t parameters = effect.sizes[1].parameter.empty() ? 1 : 2;
    const auto values = values_in(equals == std::string::npos ? "" : one.substr(equals + 1), parameters);
    if (values.size() > parameters) {
      throw Error(message("effect = ", one, ": ", name, " has one parameter, ", effect.sizes[0].parameter));
    }
    for (std::size_t k = 0; k < values.size(); ++k) {
      const Size& size = effect.sizes.at(k);
      const RockParameter& parameter = rock_parameter(size.parameter);
      const bool looked_for = std::any_of(plan.space.begin(), plan.space.end(),
                                          [&](const Parameter& p) { return p.name == parameter.name; });
      if (looked_for) {
        throw Error(message("effect = ", one, ": ", parameter.name, " is a base parameter of this plan"));
      }
      out.push_back({std::string{effect.name},
                     std::string{effect.form},
                     {.name = std::string{parameter.name},
                      .unit = std::string{parameter.unit},
                      .least = size.least,
                      .most = size.most,
                      .logarithmic = parameter.logarithmic},
                     value_of(one, name, size, values[k], parameter.get(plan.model), parameter.unit, sizes)});
    }
  }
  return out;
}

} // namespace make_measured
