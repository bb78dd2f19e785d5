/// \file
/// MFiX's verification case DEM05: oblique impacts on a plane by the linear law and by Hertz's, beside MFiX's
/// own results and the measurements of Kharaz, Gorham & Salman (2001).

#include "cases.hpp"
#include "law.hpp"
#include "mfix_output.hpp"
#include "oblique.hpp"
#include "reference_curve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace validation {

namespace {

using kharaz::radius, kharaz::speed;

/// What DEM05 compares: of what comes after, and as momentum alone has it from the tangential restitution,
/// whatever the law of contact.
struct Quantity {
  const char *file, *name, *unit;
  double (*of)(double angle, const scree::Vector& v, double w);
  double (*from_restitution)(double angle, double tangential);
};

double tangential_speed(double angle) {
  return speed * std::sin(angle * degree);
}
double rebound_angle(double, const scree::Vector& v, double) {
  return std::atan2(v.x(), v.z()) / degree;
}
double restitution_of(double angle, const scree::Vector& v, double) {
  return v.x() / tangential_speed(angle);
}
double spin_of(double, const scree::Vector&, double w) {
  return w;
}
double rebound_angle_from(double angle, double tangential) {
  return std::atan(tangential * std::tan(angle * degree) / kharaz::restitution) / degree;
}
double spin_from(double angle, double tangential) {
  return 2.5 * (1.0 - tangential) * tangential_speed(angle) / radius;
}

const std::vector<Quantity> quantities{
    {"ALPHA", "rebound angle", "degrees", rebound_angle, rebound_angle_from},
    {"COEFF", "tangential restitution", "1", restitution_of, nullptr},
    {"OMEGA", "spin", "rad/s", spin_of, spin_from}};

/// Restitution e on glass, as DEM05 has both.
template <class Law>
double simulated(const Quantity& quantity, double angle, double e) {
  const scree::Material oxide = kharaz::aluminium_oxide(e);
  scree::Material glass = oxide;
  glass.youngs_modulus = 7e10;
  glass.poisson_ratio = 0.25;
  const Ball ball{oxide, radius, {speed * std::sin(angle * degree), 0.0, -speed * std::cos(angle * degree)}};
  const double mass = mass_of(ball);
  const double duration =
      is_hertz<Law> ? HertzImpact{effective_modulus(oxide, glass), radius, mass, -ball.velocity.z()}.duration
                    : std::numbers::pi * std::sqrt(mass / oxide.normal_stiffness);
  const Rebound after = impact<Law>({ball}, &glass, duration, 2000, scree::Stiffness::of_contact).after[0];
  return quantity.of(angle, after.velocity, after.angular_velocity.y());
}

double rms(const std::vector<double>& differences) {
  double sum = 0.0;
  for (const double d : differences) {
    sum += d * d;
  }
  return std::sqrt(sum / static_cast<double>(differences.size()));
}

/// The first two columns of measurements.
Series measured(const Inputs& inputs, const std::string& file) {
  Series out{"Kharaz et al., measured", Origin::experiment, {}, {}};
  const auto tables = mfix_tables(inputs.file("mfix_dem/DEM05_POST_" + file + ".dat"));
  for (const auto& row : tables.at(0)) {
    out.x.push_back(row.at(0));
    out.y.push_back(row.at(1));
  }
  return out;
}

/// How far the measurements of one quantity are from what those of another say of it by momentum alone: rms.
double disagreement(const Inputs& inputs, const Quantity& quantity) {
  const Series restitution = measured(inputs, "COEFF");
  const bool own = quantity.from_restitution == nullptr;
  const Series points = measured(inputs, own ? "ALPHA" : quantity.file);
  std::vector<double> off;
  for (std::size_t k = 0; k < points.x.size(); ++k) {
    const double angle = points.x[k];
    if (angle < restitution.x.front()) {
      continue;
    }
    const double tangential = value_at(restitution, angle);
    off.push_back(own ? kharaz::restitution * std::tan(points.y[k] * degree) / std::tan(angle * degree) -
                            tangential
                      : quantity.from_restitution(angle, tangential) - points.y[k]);
  }
  return rms(off);
}

/// Beside MFiX's own results, which take a restitution of 1.
template <class Law>
void beside_code(const Inputs& inputs, const Quantity& quantity, Outcome& out, Chart& chart) {
  // No angle at which the sphere sticks is above this one.
  constexpr double slides_throughout = 32.0;
  const std::string name = std::string{"MFiX DEM05, "} + law_name<Law>;
  Series code{"MFiX", Origin::code, {}, {}}, found{"scree, e 1", Origin::code, {}, {}};
  std::vector<double> all, sliding;
  double most = 0.0;
  const auto tables = mfix_tables(inputs.file(std::string{"mfix_dem/DEM05_POST_"} + quantity.file + ".dat"));
  for (const auto& row : tables.at(is_hertz<Law> ? 2 : 1)) {
    const double angle = row.at(0), value = row.at(2); // on a wall
    if (angle > 0.0) {
      code.x.push_back(angle);
      code.y.push_back(value);
      found.x.push_back(angle);
      found.y.push_back(simulated<Law>(quantity, angle, 1.0));
      all.push_back(found.y.back() - value);
      most = std::max(most, std::abs(value));
      if (angle > slides_throughout) {
        sliding.push_back(all.back());
      }
    }
  }
  const Source source{Origin::code, "MFiX 21.3.2, stored results of DEM05, on a wall"};
  const bool restitution_by_hertz = is_hertz<Law> && quantity.from_restitution == nullptr;
  out.add(name, fmt::format("{}, rms difference from MFiX over the greatest", quantity.name), "1", 0.0,
          source, rms(all) / most, {1.0 / 50.0, false, "first order of MFiX's step, 1/50 of the contact"},
          restitution_by_hertz
              ? "below 10 degrees: MFiX's tangential force is the present stiffness times all "
                "the displacement, which gives back what scree's increments lose"
              : "");
  // Greatest overlap over r, half of which scree leaves on friction's arm.
  constexpr double arm = 0.006 / 2.0;
  const double of_step = std::pow(std::numbers::pi / 50.0, 2);
  out.add(name, fmt::format("{} where it slides throughout, rms difference over the greatest", quantity.name),
          "1", 0.0, source, rms(sliding) / most,
          {of_step + (quantity.of == spin_of ? arm : 0.0), false,
           quantity.of == spin_of
               ? "second order of MFiX's step, 1/50 of the contact, and friction's arm, in MFiX shorter by "
                 "half the overlap"
               : "second order of MFiX's step, 1/50 of the contact"});
  chart.references.push_back(code);
  chart.simulated.push_back(found);
}

/// Beside the measurements.
template <class Law>
void beside_experiment(const Inputs& inputs, const Quantity& quantity, Outcome& out, Chart& chart) {
  constexpr double small = 10.0; // degrees
  const std::string name = std::string{"Kharaz et al., "} + law_name<Law>;
  const Series points = measured(inputs, quantity.file);
  std::vector<double> off, off_small;
  for (std::size_t k = 0; k < points.x.size(); ++k) {
    off.push_back(simulated<Law>(quantity, points.x[k], kharaz::restitution) - points.y[k]);
    if (points.x[k] < small) {
      off_small.push_back(off.back());
    }
  }
  const Source source{Origin::experiment, "Kharaz, Gorham & Salman (2001), points as MFiX's DEM05 has them"};
  const Tolerance scatter{2.0 * disagreement(inputs, quantity), false,
                          "2 x the rms by which the measured restitution, rebound angle and spin miss what "
                          "momentum alone says of each other"};
  out.add(name, fmt::format("{}, rms misfit", quantity.name), quantity.unit, 0.0, source, rms(off), scatter);
  const bool outside = rms(off_small) > scatter.size;
  out.add(name, fmt::format("{}, rms misfit below {:g} degrees", quantity.name, small), quantity.unit, 0.0,
          source, rms(off_small), scatter,
          outside ? "loses too little where it sticks; probably as this law has no partial slip" : "");
  Series found{"scree, e 0.98", Origin::code, {}, {}};
  for (double angle = 0.5; angle <= 65.0; angle += 0.5) {
    found.x.push_back(angle);
    found.y.push_back(simulated<Law>(quantity, angle, kharaz::restitution));
  }
  chart.references.push_back(points);
  chart.simulated.push_back(found);
}

template <class Law>
void compare(const Inputs& inputs, const Quantity& quantity, Outcome& out) {
  Chart chart{fmt::format("dem05_{}_{}", quantity.file, law_name<Law>),
              std::string{"MFiX DEM05, "} + law_name<Law>,
              "incident angle, degrees from the normal",
              fmt::format("{}, {}", quantity.name, quantity.unit),
              {},
              {}};
  beside_code<Law>(inputs, quantity, out, chart);
  beside_experiment<Law>(inputs, quantity, out, chart);
  out.draw(chart);
}

} // namespace

/// 5 mm spheres of aluminium oxide at 3.9 m/s on glass.
Outcome oblique_impact_mfix(const Inputs& inputs) {
  Outcome out;
  if (inputs.reference.empty()) {
    out.notes.push_back("MFiX DEM05 needs the reference data");
    return out;
  }
  for (const Quantity& quantity : quantities) {
    compare<scree::LinearSpring<>>(inputs, quantity, out);
    compare<scree::HertzMindlin<>>(inputs, quantity, out);
  }
  const Series restitution = measured(inputs, "COEFF"), spin = measured(inputs, "OMEGA");
  const double a = restitution.x.front(), b = spin.x.front();
  out.notes.push_back(fmt::format(
      "Kharaz et al.: both laws give too much tangential restitution and too little spin where the sphere "
      "sticks. "
      "At {:.1f} degrees: measured restitution {:.3f}, linear {:.3f}, Hertz-Mindlin {:.3f}. At {:.1f} "
      "degrees: "
      "measured spin {:.0f} rad/s, linear {:.0f}, Hertz-Mindlin {:.0f}. That the linear law is nearer is "
      "owed to "
      "DEM05's k_t / k_n of 0.86. MFiX's Hertzian law, whose tangential force is the present stiffness times "
      "all the "
      "displacement, gives back all of it: restitution 0.997.",
      a, restitution.y.front(), simulated<scree::LinearSpring<>>(quantities[1], a, kharaz::restitution),
      simulated<scree::HertzMindlin<>>(quantities[1], a, kharaz::restitution), b, spin.y.front(),
      simulated<scree::LinearSpring<>>(quantities[2], b, kharaz::restitution),
      simulated<scree::HertzMindlin<>>(quantities[2], b, kharaz::restitution)));
  out.notes.push_back("MFiX DEM05: inputs are those of its mfix.dat (stiffnesses, moduli, e 1), the speed of "
                      "3.9 m/s follows from its "
                      "results; its collisions with a particle as wall are left out, as its particle moves.");
  return out;
}

} // namespace validation
