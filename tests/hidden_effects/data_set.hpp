#pragma once
/// \file
/// What is hidden in made data: effects, none, or what no cause can explain.

#include "make_measured/laboratory.hpp"

#include "scree/core/error.hpp"
#include "scree/core/random.hpp"
#include "scree/io/number_text.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace hidden {

/// Causes whose traces the experiments of the plan "micro" show.
inline constexpr std::array effects{"rolling_resistance", "normal_law", "normal_hysteresis",
                                    "wall_friction",      "damping",    "initial_packing",
                                    "shape_fraction",     "size_scale"};

/// Other forms of them, which a third of their sets have: the diagnosis knows the cause, but not so.
inline constexpr std::array other_forms{"rolling_resistance:dashpot", "damping:local",
                                        "shape_fraction:third_shape"};

/// Pairs of them that do not speak through the same observables only.
inline constexpr std::array pairs{
    std::array{"rolling_resistance", "damping"}, std::array{"normal_hysteresis", "shape_fraction"},
    std::array{"normal_law", "initial_packing"}, std::array{"wall_friction", "size_scale"}};

/// What a laboratory reads off wrong, by how much; as large as these experiments can show. Not among them is
/// what causes mimic: too low a bulk density is taken for one of several that make a bed looser.
inline std::vector<make_measured::Order> faults(scree::Random& size) {
  const auto misread = [&](double least, double most, const std::vector<std::string>& what) {
    const std::string factor = "=" + scree::number_text(size.uniform(least, most));
    make_measured::Order order;
    for (const std::string& observable : what) {
      order.misread += (order.misread.empty() ? "" : ",") + observable + factor;
    }
    return order;
  };
  return {misread(1.3, 1.4, {"bulk_density.bulk_density_kg_m3"}),
          misread(1.25, 1.35, {"tamped.bulk_density_kg_m3"}),
          misread(2.5, 3.5, {"tilt_test.angle_deg", "tilt_test.failure_angle_deg"}),
          misread(0.75, 0.85, {"drop_fast.restitution", "drop_fast.energy_restitution"}),
          misread(1.25, 1.35, {"drop_slowly.restitution", "drop_slowly.energy_restitution"}),
          misread(0.7, 0.76, {"tamped.bulk_density_kg_m3"})};
}

enum class Kind { nothing, one, two, outside };

struct DataSet {
  Kind kind;
  make_measured::Order order;
};

/// 24 sets with one effect, some in another form, 12 with nothing, 6 with what is none of the causes and 4
/// with two effects, all that `times`; sizes and rocks are drawn.
inline std::vector<DataSet> data_sets(std::uint64_t seed, std::size_t times) {
  std::vector<DataSet> out;
  scree::Random random{seed, "hidden effects"};
  scree::Random forms{seed, "hidden effects, forms"};
  const auto form_of = [&](const std::string& effect) {
    const auto other = std::find_if(other_forms.begin(), other_forms.end(),
                                    [&](const std::string& form) { return form.starts_with(effect + ":"); });
    return other != other_forms.end() && forms.uniform() < 1.0 / 3.0 ? std::string{*other} : effect;
  };
  const auto add = [&](Kind kind, make_measured::Order order) {
    order.plan = "micro";
    order.replicates = 4;
    order.seed = random.index(std::size_t{1} << 53U);
    out.push_back({kind, std::move(order)});
  };
  for (std::size_t k = 0; k < times; ++k) {
    for (std::size_t of_each = 0; of_each < 3; ++of_each) {
      for (const char* effect : effects) {
        add(Kind::one, {.effects = form_of(effect) + "=auto"});
      }
    }
    for (std::size_t n = 0; n < 12; ++n) {
      add(Kind::nothing, {});
    }
    for (make_measured::Order& fault : faults(random)) {
      add(Kind::outside, std::move(fault));
    }
    for (const auto& pair : pairs) {
      add(Kind::two, {.effects = scree::message(pair[0], "=auto,", pair[1], "=auto")});
    }
  }
  return out;
}

} // namespace hidden
