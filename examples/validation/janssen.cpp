/// \file
/// Janssen (1895): the wall of a tube carries part of the weight of what fills it.

#include "cases.hpp"
#include "filled_tube.hpp"
#include "fits.hpp"

#include <boost/math/tools/minima.hpp>
#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace validation {

namespace {

/// kg, the saturation with which Janssen's law is nearest to the fillings.
double fitted_saturation(const std::vector<Filling>& fillings) {
  const auto misfit = [&](double saturation) {
    double sum = 0.0;
    for (const Filling& f : fillings) {
      const double off = f.apparent - janssen_mass(f.mass, saturation);
      sum += off * off;
    }
    return sum;
  };
  const double mass = fillings.front().mass;
  constexpr int bits = std::numeric_limits<double>::digits / 2;
  return boost::math::tools::brent_find_minima(misfit, 0.01 * mass, 10.0 * mass, bits).first;
}

} // namespace

Outcome janssen(const Inputs& inputs) {
  const char* name = "Janssen";
  constexpr double level = 0.999; // of Student's t: there are ten quantities
  const Balls balls;
  const double diameter = (inputs.full ? 16.0 : 8.0) * balls.diameter;
  const std::size_t count = inputs.full ? 11200 : 1400; // to about three diameters
  const std::uint64_t seeds = inputs.full ? 8 : 6;
  std::vector<Tube> tubes;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    tubes.push_back(Column{balls, diameter, count, seed, inputs.threads}.measure());
  }
  const auto over_tubes = [&](auto value) {
    std::vector<double> values;
    for (const Tube& tube : tubes) {
      values.push_back(value(tube));
    }
    return Mean{values};
  };
  const std::string grounds =
      fmt::format("Student's t at 99.9 % times the standard error over {} tubes", tubes.size());
  Outcome out;
  const Filling& whole = tubes.front().fillings.front();
  out.add(name, "what bottom and side carry over weight, less the gain in momentum", "1", 1.0,
          {Origin::theory, "momentum of all balls"},
          (whole.apparent + whole.side - whole.gained) / whole.mass, {1e-9, true, "rounding of sums"});

  Series found{"scree", Origin::code, {}, {}};
  Series expected{"Janssen with K and friction as measured", Origin::theory, {}, {}};
  Series weight{"all of it", Origin::theory, {}, {}};
  const double kg = 1e3; // g
  for (std::size_t k = 0; k < shares.size(); ++k) {
    const Mean ratio = over_tubes([k](const Tube& tube) {
      const Filling& f = tube.fillings[k];
      return f.apparent / janssen_mass(f.mass, tube.saturation());
    });
    const Mean mass = over_tubes([k](const Tube& tube) { return tube.fillings[k].mass; });
    const Mean apparent = over_tubes([k](const Tube& tube) { return tube.fillings[k].apparent; });
    const Mean theory =
        over_tubes([k](const Tube& tube) { return janssen_mass(tube.fillings[k].mass, tube.saturation()); });
    // Only the eight wide tubes tell this from their scatter.
    const bool shallow = inputs.full && k + 1 == shares.size();
    out.add(name, fmt::format("apparent over Janssen's mass, filled to {:g}", shares[k]), "1", 1.0,
            {Origin::theory, "M_inf (1 - exp(-M / M_inf)), M_inf from K and wall friction as measured"},
            ratio.value, {ratio.margin(level), true, grounds},
            shallow
                ? "Janssen's K times friction is not one constant: in a filling 7 balls high it was 0.25 (K "
                  "0.87, friction 0.287 of at most 0.3), in taller ones 0.22 (0.96, 0.23), which makes "
                  "0.975 of this ratio; means of four tubes"
                : "");
    found.x.push_back(kg * mass.value);
    found.y.push_back(kg * apparent.value);
    expected.x.push_back(kg * mass.value);
    expected.y.push_back(kg * theory.value);
    weight.x.push_back(kg * mass.value);
    weight.y.push_back(kg * mass.value);
  }
  const Mean growth =
      over_tubes([](const Tube& tube) { return tube.fillings[0].apparent / tube.fillings[1].apparent; });
  const Mean left =
      over_tubes([](const Tube& tube) { return std::exp(-tube.fillings[1].mass / tube.saturation()); });
  out.add(name, "apparent mass, filled to 1 over filled to 0.75", "1", 1.0, {Origin::theory, "saturation"},
          growth.value, {growth.margin(level) + left.value, true, grounds + ", and exp(-M / M_inf)"});
  const Mean fit =
      over_tubes([](const Tube& tube) { return fitted_saturation(tube.fillings) / tube.saturation(); });
  out.add(name, "saturation mass, fitted to the fillings over that from K and friction", "1", 1.0,
          {Origin::theory, "M_inf = bulk density pi D^3 / (16 K mu)"}, fit.value,
          {fit.margin(level), true, grounds});
  const Mean k = over_tubes([](const Tube& tube) { return tube.middle.radial / tube.middle.vertical; });
  const Mean mu = over_tubes([](const Tube& tube) { return tube.middle.shear / tube.middle.radial; });
  const Mean foot =
      over_tubes([](const Tube& tube) { return tube.saturation(tube.foot) / tube.saturation(); });
  out.notes.push_back(fmt::format("Janssen: M_inf from K and friction of the lowest quarter is {:.3f} +- "
                                  "{:.3f} of that of the middle half, which is taken.",
                                  foot.value, foot.error));
  out.notes.push_back(fmt::format("Janssen: the tube is {:g} balls wide; in the middle of the tallest "
                                  "filling K = radial at the wall over "
                                  "vertical stress = {:.3f} +- {:.3f} and the wall friction that holds is "
                                  "{:.3f} +- {:.3f} of {:g} that it "
                                  "could be. All numbers of the set-up are ours.",
                                  diameter / balls.diameter, k.value, k.error, mu.value, mu.error,
                                  balls.friction));
  out.draw({"janssen",
            name,
            "mass of the filling, g",
            "mass that the bottom feels, g",
            {expected, weight},
            {found}});
  return out;
}

} // namespace validation
