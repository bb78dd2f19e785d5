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

/// One that there is. Typed in here, not taken from the catalogue of the diagnosis, so that a mistake there
/// is not made here too. All ranges of "auto" are ours: what experiments at desk fidelity can show.
struct Known {
  std::string_view name, parameter;
  double least, most;           ///< that make sense
  double auto_least, auto_most; ///< of the sizes that are drawn, times the null value where `times_null`
  bool times_null = false;
};
constexpr std::array known{Known{"rolling_resistance", "rolling_friction", 0.0, 2.0, 0.08, 0.3},
                           Known{"adhesion", "adhesion", 0.0, 1e3, 0.6, 2.5},
                           Known{"normal_law", "normal_exponent", 1.0, 2.0, 1.2, 1.5},
                           Known{"normal_hysteresis", "unloading_ratio", 1.0, 100.0, 1.3, 2.2},
                           Known{"wall_friction", "rig_friction", 1e-3, 2.0, 0.05, 0.18},
                           Known{"damping", "restitution", 0.01, 1.0, 0.25, 0.45},
                           Known{"initial_packing", "packing_friction", 1e-3, 1e3, 0.2, 0.5},
                           Known{"particle_density", "particle_density", 1.0, 2e4, 1.1, 1.3, true},
                           Known{"shape_fraction", "first_shape_share", 0.0, 1.0, 0.6, 0.9},
                           Known{"size_scale", "size_factor", 0.05, 50.0, 1.15, 1.35, true},
                           Known{"rate_friction", "friction_rate", -1e3, 1e3, 0.5, 2.0},
                           Known{"attrition", "attrition", 0.0, 1e9, 30.0, 200.0},
                           Known{"rope_stiffness", "rope_stiffness", 1e-3, 1e3, 0.15, 0.4},
                           Known{"load_cell", "load_cell_gain", 0.1, 10.0, 1.15, 1.35},
                           Known{"bucket_inertia", "bucket_mass", 0.1, 10.0, 1.3, 1.6},
                           Known{"bed_floor", "floor_depth", 0.1, 10.0, 0.65, 0.8}};

} // namespace

std::vector<Effect> effects_in(const std::string& text, const ex::Plan& plan, Random& sizes) {
  std::vector<Effect> out;
  for (const std::string& one : ex::comma_list(text)) {
    const std::size_t equals = one.find('=');
    const std::string name = one.substr(0, equals);
    const auto found =
        std::find_if(known.begin(), known.end(), [&](const Known& k) { return k.name == name; });
    if (found == known.end()) {
      std::string names;
      for (const Known& k : known) {
        names += message(names.empty() ? "" : ", ", k.name);
      }
      throw Error(message("effect = ", one, ": there is no effect '", name, "'; there are ", names));
    }
    const RockParameter& parameter = rock_parameter(found->parameter);
    const bool looked_for = std::any_of(plan.space.begin(), plan.space.end(),
                                        [&](const Parameter& p) { return p.name == parameter.name; });
    if (looked_for) {
      throw Error(message("effect = ", one, ": ", parameter.name, " is a base parameter of this plan"));
    }
    Effect effect{name,
                  {.name = std::string{parameter.name},
                   .unit = std::string{parameter.unit},
                   .least = found->least,
                   .most = found->most,
                   .logarithmic = parameter.logarithmic},
                  0.0};
    const std::string value = equals == std::string::npos ? "" : one.substr(equals + 1);
    if (value == "auto") {
      effect.value = sizes.uniform(found->auto_least, found->auto_most) *
                     (found->times_null ? parameter.get(plan.model) : 1.0);
    } else {
      const auto number = parse_number(value);
      if (!number) {
        throw Error(message("effect = ", one, ": '", value, "' is neither a number nor auto"));
      }
      effect.value = require(message("effect ", name), *number, {found->least, found->most, parameter.unit});
    }
    out.push_back(std::move(effect));
  }
  return out;
}

} // namespace make_measured
