/// \file
/// A sphere with rolling resistance on an incline: what holds it, and how it rolls.

#include "cases.hpp"
#include "incline.hpp"

#include "scree/contact/rolling_resistance.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace validation {

namespace {

using namespace incline;

template <class Law>
void resisted_by(Outcome& out) {
  for (const double mu_r : {0.02, 0.1, 0.3}) {
    const scree::Material material = stone(0.9, mu_r);
    const std::string name =
        fmt::format("sphere on an incline, rolling resistance {:g}, {}", mu_r, law_name<Law>);
    const Law law{scree::RollingResistance{.damping = 0.3}};
    const double most = Incline<Law>{material, ball, law}.overlap(material, 0.0) / radius;
    const double slope = threshold(0.95 * mu_r, 1.05 * mu_r, [&](double tangent) {
      Incline<Law> incline{material, ball, law};
      incline.raise(std::atan(tangent));
      incline.run(0.3);
      return incline.speed() > 1e-4 * g * tangent * 0.3;
    });
    out.add(name, "slope at which it begins to roll", "1", mu_r,
            {Origin::theory, "m g r sin = mu_r r m g cos"}, slope,
            {1e-4 * 1.4 + 0.1 / (1 << 12) + most, true,
             "speed looked for, 1e-4 of g tan t (ours); bisection; half the overlap off friction's arm"});
    for (const double share : {1.1, 1.5, 2.0}) {
      const double angle = std::atan(share * mu_r);
      Incline<Law> incline{material, ball, law};
      incline.raise(angle);
      const Speeding s = speed_up(incline);
      const double a = 5.0 / 7.0 * g * (std::sin(angle) - mu_r * std::cos(angle));
      out.add(name, fmt::format("acceleration at a slope of {:g} mu_r", share), "m/s2", a,
              {Origin::theory, "rolling against a couple: 5/7 g (sin - mu_r cos)"}, s.linear,
              {most * share / (share - 1.0), true,
               "half the overlap off friction's arm, over the share of the slope that is left"});
    }
    Incline<Law> rests{material, ball, law};
    rests.raise(std::atan(0.98 * mu_r));
    rests.run(0.5);
    const double before = rests.sim.bodies().position(0).x();
    rests.run(0.5);
    out.add(name, "creep at a slope of 0.98 mu_r, over r", "1", 0.0, {Origin::theory, "rests below mu_r"},
            (rests.sim.bodies().position(0).x() - before) / radius,
            {1e-6, false, "the rolling spring and its dashpot have come to rest (ours)"});
  }
}

} // namespace

/// A sphere with rolling resistance on an incline raised slowly.
Outcome resisted_rolling(const Inputs& /*inputs*/) {
  Outcome out;
  resisted_by<scree::LinearSpring<scree::RollingResistance>>(out);
  resisted_by<scree::HertzMindlin<scree::RollingResistance>>(out);
  return out;
}

} // namespace validation
