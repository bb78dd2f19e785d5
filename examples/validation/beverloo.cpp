/// \file
/// Beverloo, Leniger & van de Velde (1961): how fast balls run out of a circular orifice in a flat bottom.

#include "ball_bed.hpp"
#include "cases.hpp"
#include "fits.hpp"

#include "scree/measure/porosity.hpp"
#include "scree/measure/surface_height.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace validation {

namespace {

using Silo = scree::Simulation<Quiet>;

/// A silo filled and at rest on a closed bottom.
struct Filled {
  scree::Packing packing;
  double bulk_density = 0.0; ///< kg/m3, away from walls and surface
  double top = 0.0;          ///< m
};

scree::Setup<Quiet> setup_of(const Balls& balls, unsigned threads, double damping) {
  return {.stiffness = scree::Stiffness::of_contact,
          .gravity = {0.0, 0.0, -balls.g},
          .local_damping = damping,
          .threads = threads};
}

void add_mantle(Silo& silo, double radius, scree::MaterialId glass) {
  silo.add_wall({.name = "mantle",
                 .surfaces = {{scree::Cylinder{.radius = radius}, glass}},
                 .dynamics = scree::Fixed{}});
}

Filled fill(const Balls& balls, double radius, std::size_t count, unsigned threads) {
  Silo silo{setup_of(balls, threads, 0.3)};
  const auto glass = silo.add_material(balls.material());
  add_mantle(silo, radius, glass);
  silo.add_wall({.name = "bottom", .surfaces = {{scree::Plane{}, glass}}, .dynamics = scree::Fixed{}});
  scree::Random random{1, "beverloo"};
  Filled out;
  out.packing = balls_in_tube(balls, count, radius, random, glass);
  silo.add(out.packing);
  scree::run_for(silo, 1.5 * std::sqrt(2.0 * out.packing.bodies.back().position.z() / balls.g));
  (void)come_to_rest(silo, 0.01, 100.0 * balls.time(), balls.time());
  for (std::size_t b = 0; b < silo.bodies().size(); ++b) {
    // Bodies keep their ids when they are sorted.
    out.packing.bodies[silo.bodies().id(b)].position = silo.bodies().position(b);
  }
  const double d = balls.diameter, reach = radius / std::numbers::sqrt2 - 2.0 * d;
  out.top =
      scree::highest_point(silo.bodies(), {Eigen::Vector2d{-reach, -reach}, Eigen::Vector2d{reach, reach}});
  out.bulk_density = balls.density *
                     (1.0 - scree::porosity(silo.bodies(), {scree::Vector{-reach, -reach, 2.0 * d},
                                                            scree::Vector{reach, reach, out.top - 3.0 * d}}));
  return out;
}

/// A flat ring that goes a little into the mantle. The hole has as many corners as make it nearly round, and
/// the area of the circle.
scree::TriangleMesh ring(double hole, double outside) {
  constexpr std::uint32_t corners = 48;
  const double step = 2.0 * std::numbers::pi / corners;
  const double inside = hole * std::sqrt(step / std::sin(step));
  scree::TriangleMesh mesh;
  for (std::uint32_t k = 0; k < corners; ++k) {
    const scree::Vector way{std::cos(k * step), std::sin(k * step), 0.0};
    mesh.vertices.emplace_back(inside * way);
    mesh.vertices.emplace_back(outside * way);
    const std::uint32_t a = 2 * k, b = 2 * ((k + 1) % corners);
    mesh.facets.push_back({a, a + 1, b});
    mesh.facets.push_back({b, a + 1, b + 1});
  }
  return mesh;
}

/// The steady discharge through one orifice.
struct Discharge {
  double orifice = 0.0; ///< m
  Mean rate;            ///< kg/s
  double slope = 0.0;   ///< of the rate, change over the time by its mean
  double slope_error = 0.0;
  double run_out = 0.0; ///< share of all balls, in that time
  Series emptied{};     ///< s, g
};

/// \param duration s, of the steady flow
Discharge discharge(const Balls& balls, const Filled& filled, double radius, double orifice, double duration,
                    unsigned threads) {
  constexpr int blocks = 10;
  Silo silo{setup_of(balls, threads, 0.0)};
  const auto glass = silo.add_material(balls.material());
  add_mantle(silo, radius, glass);
  silo.add_wall({.name = "bottom",
                 .surfaces = {{ring(0.5 * orifice, 1.1 * radius), glass}},
                 .dynamics = scree::Fixed{}});
  silo.add(filled.packing);
  const double d = balls.diameter, tau = balls.time();
  const double all = mass_where(silo, [](const scree::Vector&) { return true; });
  Series emptied{fmt::format("D / d = {:g}", orifice / d), Origin::code, {}, {}};
  const auto run_out = [&](double until) {
    double gone = 0.0;
    while (silo.time() < until) {
      scree::run_for(silo, 0.2 * tau);
      silo.remove_bodies(
          [d](const auto& bodies, std::size_t b) { return bodies.position(b).z() < -2.0 * d; });
      gone = all - mass_where(silo, [d](const scree::Vector& at) { return at.z() >= -d; });
      emptied.x.push_back(silo.time());
      emptied.y.push_back(1e3 * gone);
    }
    return gone;
  };
  // The flow is steady when balls have come through all of the zone that it loosens, an orifice high; ours:
  // half as long again.
  const double start = 1.5 * (std::sqrt(2.0 * orifice / balls.g) + tau);
  const double first = run_out(start);
  double before = first, then = silo.time();
  std::vector<double> rates;
  for (int k = 1; k <= blocks; ++k) {
    const double after = run_out(start + duration * k / blocks);
    rates.push_back((after - before) / (silo.time() - then));
    before = after;
    then = silo.time();
  }
  const Mean rate{rates};
  const Trend trend{rates};
  return {orifice, rate, trend.slope / rate.value, trend.error / rate.value, (before - first) / all, emptied};
}

/// ln W over ln(D - k d), lengths in balls.
Fit power_law(const std::vector<Discharge>& flows, double unit, double d, double k) {
  std::vector<double> x, y, error;
  for (const Discharge& flow : flows) {
    x.push_back(std::log(flow.orifice / d - k));
    y.push_back(std::log(flow.rate.value / unit));
    error.push_back(flow.rate.error / flow.rate.value);
  }
  return {x, y, error};
}

/// W^(2/5) over D, lengths in balls: a line of slope C^(2/5) that meets 0 at k.
Fit two_fifths(const std::vector<Discharge>& flows, double unit, double d) {
  std::vector<double> x, y, error;
  for (const Discharge& flow : flows) {
    const double root = std::pow(flow.rate.value / unit, 0.4);
    x.push_back(flow.orifice / d);
    y.push_back(root);
    error.push_back(0.4 * root * flow.rate.error / flow.rate.value);
  }
  return {x, y, error};
}

} // namespace

Outcome beverloo(const Inputs& inputs) {
  const char* name = "Beverloo";
  constexpr double sigmas = 3.0;
  const Balls balls{.stiffness = 3e3};
  const double d = balls.diameter, tau = balls.time();
  const double radius = (inputs.full ? 20.0 : 10.0) * d; // 2.5 of the widest orifice
  const std::vector<double> orifices = inputs.full ? std::vector<double>{8.0, 9.5, 11.0, 13.0, 16.0}
                                                   : std::vector<double>{5.0, 5.75, 6.5, 7.25, 8.0};
  const Filled filled = fill(balls, radius, inputs.full ? 30000 : 4500, inputs.threads);
  const double unit = filled.bulk_density * std::sqrt(balls.g) * std::pow(d, 2.5); // kg/s
  std::vector<Discharge> flows;
  for (const double orifice : orifices) {
    // As long as the narrower let enough balls out for a mean, and the wider do not empty the silo; ours.
    const double duration = 30.0 * tau * std::pow(orifices.front() / orifice, 1.5);
    flows.push_back(discharge(balls, filled, radius, orifice * d, duration, inputs.threads));
  }

  Outcome out;
  const Source law{Origin::experiment,
                   "W = C rho_b sqrt(g) (D - k d)^(5/2), Beverloo et al., Chem. Eng. Sci. 15:260 (1961)"};
  const Source head{Origin::experiment, "the rate does not depend on the head, Hagen (1852)"};
  const Source spread{Origin::experiment, "spread of measurements, Nedderman (1992)"};
  Series rates{"scree", Origin::code, {}, {}};
  Chart emptying{"beverloo_emptying", "Balls run out", "time, s", "mass that has run out, g", {}, {}};
  for (const Discharge& flow : flows) {
    out.add(name,
            fmt::format("change of the rate while {:.0f} % run out, D / d {:g}", 100.0 * flow.run_out,
                        flow.orifice / d),
            "1", 0.0, head, flow.slope,
            {sigmas * flow.slope_error, false,
             fmt::format("{:g} standard errors of the slope over 10 blocks", sigmas)});
    rates.x.push_back(flow.orifice / d);
    rates.y.push_back(flow.rate.value / unit);
    emptying.simulated.push_back(flow.emptied);
  }
  double weight = 0.0, slope = 0.0;
  for (const Discharge& flow : flows) {
    weight += std::pow(flow.slope_error, -2.0);
    slope += flow.slope * std::pow(flow.slope_error, -2.0);
  }
  out.add(name, "change of the rate, weighted mean of all orifices", "1", 0.0, head, slope / weight,
          {sigmas / std::sqrt(weight), false, fmt::format("{:g} standard errors of the mean", sigmas)});
  constexpr double k_low = 1.4, k_high = 1.6;
  const Fit power = power_law(flows, unit, d, 1.4);
  const double of_k = std::abs(power_law(flows, unit, d, k_high).slope - power.slope);
  out.add(name, "exponent of D - 1.4 d", "1", 2.5, law, power.slope,
          {sigmas * power.slope_error + of_k, false,
           fmt::format("{:g} standard errors of the fit ({:.3f}), and what k = {:g} changes ({:.3f})", sigmas,
                       power.slope_error, k_high, of_k)});
  const Fit line = two_fifths(flows, unit, d);
  const double k = -line.intercept / line.slope;
  const double k_error = std::hypot(line.middle_error / line.slope,
                                    line.at_middle * line.slope_error / (line.slope * line.slope));
  out.add(
      name, "k", "1", 0.5 * (k_low + k_high), spread, k,
      {0.5 * (k_high - k_low) + sigmas * k_error, false,
       fmt::format("1.4 to 1.6 of spheres, and {:g} standard errors of the fit ({:.3f})", sigmas, k_error)});
  const double c = std::pow(line.slope, 2.5), c_error = 2.5 * c * line.slope_error / line.slope;
  out.add(name, "C", "1", 0.6, spread, c,
          {0.05 + sigmas * c_error, false,
           fmt::format("0.55 to 0.65, and {:g} standard errors of the fit ({:.3f})", sigmas, c_error)});
  Series expected{"C = 0.58, k = 1.4", Origin::experiment, {}, {}};
  for (const double orifice : orifices) {
    expected.x.push_back(orifice);
    expected.y.push_back(0.58 * std::pow(orifice - 1.4, 2.5));
  }
  out.draw({"beverloo", name, "D / d", "W / (rho_b g^(1/2) d^(5/2))", {expected}, {rates}});
  out.draw(emptying);
  out.notes.push_back(fmt::format(
      "Beverloo: the balls, the silo {:g} d wide and its filling of {:.0f} d are ours; at rest the balls "
      "fill "
      "{:.3f} of the bed. There is no air. With the friction of clean glass, 0.1, balls as soft as these run "
      "out the slower the lower the head, as Pongo et al. (2021, arXiv:2104.08186) found of soft balls "
      "with little friction, so that Beverloo's law is not a test there.",
      2.0 * radius / d, filled.top / d, filled.bulk_density / balls.density));
  return out;
}

} // namespace validation
