/// \file
/// MFiX's verification case DEM05: oblique impacts on a plane by the linear law and by Hertz's, beside MFiX's
/// own results and the measurements of Kharaz, Gorham & Salman (2001).

#include "cases.hpp"
#include "law_name.hpp"
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

constexpr double radius = 0.0025, speed = 3.9, mu = 0.092;
constexpr double measured_restitution = 0.98; // Kharaz et al., of the same material; MFiX takes 1

/// What DEM05 compares.
struct Quantity {
  const char* file;
  const char* name;
  const char* unit;
  double (*of)(double angle, const scree::Vector& v, double w); ///< of what comes after, angle before
};

double rebound_angle(double, const scree::Vector& v, double) { return std::atan2(v.x(), v.z()) / degree; }
double restitution_of(double angle, const scree::Vector& v, double) {
  return v.x() / (speed * std::sin(angle * degree));
}
double spin_of(double, const scree::Vector&, double w) { return w; }

const std::vector<Quantity> quantities{{"ALPHA", "rebound angle", "degrees", rebound_angle},
                                       {"COEFF", "tangential restitution", "1", restitution_of},
                                       {"OMEGA", "spin", "rad/s", spin_of}};

/// Restitution e on glass, as DEM05 has both.
template <class Law>
double simulated(const Quantity& quantity, double angle, double e) {
  const scree::Material oxide{.density = 4000,
                              .normal_stiffness = 1.72e7,
                              .shear_stiffness = 1.48e7,
                              .youngs_modulus = 3.8e11,
                              .poisson_ratio = 0.23,
                              .friction = mu,
                              .restitution = e};
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

/// A rigid sphere that slides throughout, which no law of contact enters.
double slid(const Quantity& quantity, double angle, double e) {
  const double vn = speed * std::cos(angle * degree), gained = mu * (1.0 + e) * vn;
  return quantity.of(angle, {speed * std::sin(angle * degree) - gained, 0.0, e * vn}, 2.5 * gained / radius);
}

double rms(const std::vector<double>& differences) {
  double sum = 0.0;
  for (const double d : differences) {
    sum += d * d;
  }
  return std::sqrt(sum / static_cast<double>(differences.size()));
}

template <class Law>
void compare(const Inputs& inputs, const Quantity& quantity, Outcome& out) {
  const auto tables =
      mfix_tables(inputs.file(std::string{"mfix_dem/DEM05_POST_"} + quantity.file + ".dat"));
  const Rows &measured = tables.at(0), &mfix = tables.at(is_hertz<Law> ? 2 : 1);
  const std::string name = std::string{"MFiX DEM05, "} + law_name<Law>;
  Series code{"MFiX", Origin::code, {}, {}}, points{"Kharaz et al., measured", Origin::experiment, {}, {}},
      found{"scree", Origin::code, {}, {}};
  std::vector<double> all, sliding;
  double most = 0.0;
  for (const auto& row : mfix) {
    const double angle = row[0], value = row[2]; // on a wall
    if (angle == 0.0) {
      continue;
    }
    code.x.push_back(angle);
    code.y.push_back(value);
    const double ours = simulated<Law>(quantity, angle, 1.0);
    (angle > 32.0 ? sliding : all).push_back(ours - value);
    most = std::max(most, std::abs(value));
    fmt::print("{} {} {} mfix {} scree {}\n", name, quantity.name, angle, value, ours);
  }
  std::vector<double> ours_off, mfix_off, scatter;
  for (const auto& row : measured) {
    const double ours = simulated<Law>(quantity, row[0], measured_restitution);
    points.x.push_back(row[0]);
    points.y.push_back(row[1]);
    ours_off.push_back(ours - row[1]);
    mfix_off.push_back(value_at(code, row[0]) - row[1]);
    if (row[0] > 32.0) scatter.push_back(slid(quantity, row[0], measured_restitution) - row[1]);
  }
  fmt::print("{} {}: rms ours-mfix {} sliding {} most {}; rms ours-meas {} mfix-meas {} scatter {}\n", name, quantity.name, rms(all), rms(sliding), most, rms(ours_off), rms(mfix_off), rms(scatter));
  (void)out; (void)found;
}

} // namespace

Outcome oblique_impact_mfix(const Inputs& inputs) {
  Outcome out;
  for (const Quantity& quantity : quantities) {
    compare<scree::LinearSpring<>>(inputs, quantity, out);
    compare<scree::HertzMindlin<>>(inputs, quantity, out);
  }
  return out;
}

} // namespace validation
