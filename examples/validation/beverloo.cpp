/// \file
/// Beverloo, Leniger & van de Velde (1961): how fast balls run out of a circular orifice in a flat bottom.

#include "ball_bed.hpp"
#include "cases.hpp"
#include "fits.hpp"

#include "scree/measure/porosity.hpp"
#include "scree/measure/surface_height.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
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

Filled fill(const Balls& balls, double radius, std::size_t count, std::uint64_t seed, unsigned threads) {
  Silo silo{setup_of(balls, threads, 0.3)};
  const auto glass = silo.add_material(balls.material());
  add_mantle(silo, radius, glass);
  silo.add_wall({.name = "bottom", .surfaces = {{scree::Plane{}, glass}}, .dynamics = scree::Fixed{}});
  scree::Random random{seed, "beverloo"};
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
  double orifice = 0.0; ///< in mean diameters of the balls
  double rate = 0.0;    ///< in rho_b sqrt(g) d^(5/2)
  double change = 0.0;  ///< of the rate, over the time by its mean
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
                 .surfaces = {{ring(0.5 * orifice * balls.diameter, 1.1 * radius), glass}},
                 .dynamics = scree::Fixed{}});
  silo.add(filled.packing);
  const double d = balls.diameter, tau = balls.time();
  const double all = mass_where(silo, [](const scree::Vector&) { return true; });
  Series emptied{fmt::format("D / d = {:g}", orifice), Origin::code, {}, {}};
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
  const double start = 1.5 * (std::sqrt(2.0 * orifice) + 1.0) * tau;
  const double first = run_out(start);
  double before = first, then = silo.time();
  std::vector<double> rates;
  for (int k = 1; k <= blocks; ++k) {
    const double after = run_out(start + duration * k / blocks);
    rates.push_back((after - before) / (silo.time() - then));
    before = after;
    then = silo.time();
  }
  const double mean = (before - first) / (silo.time() - start);
  const double unit = filled.bulk_density * std::sqrt(balls.g) * std::pow(d, 2.5);
  return {orifice, mean / unit, Trend{rates}.slope / mean, (before - first) / all, emptied};
}

/// ln W over ln(D - k d): the exponent is the slope.
Fit power_law(const std::vector<Discharge>& flows, double k) {
  std::vector<double> x, y, doubt;
  for (const Discharge& flow : flows) {
    x.push_back(std::log(flow.orifice - k));
    y.push_back(std::log(flow.rate));
    doubt.push_back(1.0);
  }
  return {x, y, doubt};
}

/// W^(2/5) over D: a line of slope C^(2/5) that meets 0 at k.
Fit two_fifths(const std::vector<Discharge>& flows) {
  std::vector<double> x, y;
  for (const Discharge& flow : flows) {
    x.push_back(flow.orifice);
    y.push_back(std::pow(flow.rate, 0.4));
  }
  return {x, y, y};
}

/// W / (D - k d)^(5/2): C, for a k that is given.
Mean coefficient(const std::vector<Discharge>& flows, double k) {
  std::vector<double> values;
  for (const Discharge& flow : flows) {
    values.push_back(flow.rate / std::pow(flow.orifice - k, 2.5));
  }
  return Mean{values};
}

} // namespace

Outcome beverloo(const Inputs& inputs) {
  const char* name = "Beverloo";
  constexpr double level = 0.999; // of Student's t, as for Janssen
  const Balls balls{.stiffness = 3e3};
  const double d = balls.diameter, tau = balls.time();
  // 2.5 of the widest orifice; at full size also 30 d more than it, as Nedderman asks
  const double radius = (inputs.full ? 23.0 : 10.0) * d;
  const std::size_t count = inputs.full ? 40000 : 4500;
  const std::vector<double> orifices = inputs.full ? std::vector<double>{8.0, 9.5, 11.0, 13.0, 16.0}
                                                   : std::vector<double>{5.0, 5.75, 6.5, 7.25, 8.0};
  const auto run_out = [&](const Balls& of, const Filled& filled, std::vector<Discharge>& flows) {
    for (const double orifice : orifices) {
      // As long as the narrower let as many balls out, and the wider do not empty the silo; ours.
      const double duration = 20.0 * tau * std::pow(orifices.front() / orifice, 1.5);
      flows.push_back(discharge(of, filled, radius, orifice, duration, inputs.threads));
    }
  };
  constexpr std::uint64_t fillings = 4;
  std::vector<Discharge> flows, smoother_flows;
  Filled filled;
  for (std::uint64_t seed = 1; seed <= fillings; ++seed) {
    filled = fill(balls, radius, count, seed, inputs.threads);
    run_out(balls, filled, flows);
  }
  const Balls smoother{.friction = 0.2, .stiffness = balls.stiffness};
  run_out(smoother, fill(smoother, radius, count, 1, inputs.threads), smoother_flows);

  Outcome out;
  const std::string grounds =
      fmt::format("Student's t at 99.9 % times the standard error over {} runs", flows.size());
  const Source law{Origin::experiment,
                   "W = C rho_b sqrt(g) (D - k d)^(5/2), Beverloo et al., Chem. Eng. Sci. 15:260 (1961)"};
  const Source head{Origin::experiment, "the rate does not depend on the head, Hagen (1852)"};
  const Source spread{Origin::experiment, "spread of measurements, Nedderman (1992)"};
  Series rates{"scree", Origin::code, {}, {}};
  Chart emptying{"beverloo_emptying", "Balls run out", "time, s", "mass that has run out, g", {}, {}};
  std::vector<double> changes;
  for (const Discharge& flow : flows) {
    changes.push_back(flow.change);
    rates.x.push_back(flow.orifice);
    rates.y.push_back(flow.rate);
  }
  for (std::size_t k = 0; k < orifices.size(); ++k) {
    emptying.simulated.push_back(flows[k].emptied);
  }
  const Mean change{changes};
  out.add(name,
          fmt::format("change of the rate while {:.0f} to {:.0f} % run out", 100.0 * flows.front().run_out,
                      100.0 * flows.back().run_out),
          "1", 0.0, head, change.value, {change.margin(level), false, grounds});
  constexpr double k_low = 1.4, k_high = 1.6, c_low = 0.55, c_high = 0.65;
  const Fit power = power_law(flows, k_low);
  const double of_k = std::abs(power_law(flows, k_high).slope - power.slope);
  out.add(name, "exponent of D - 1.4 d", "1", 2.5, law, power.slope,
          {power.slope_margin(level) + of_k, false,
           fmt::format("{} ({:.3f}), and what k = {:g} changes ({:.3f})", grounds, power.slope_error, k_high,
                       of_k)});
  const Fit line = two_fifths(flows);
  out.add(name, "k", "1", 0.5 * (k_low + k_high), spread, line.root,
          {0.5 * (k_high - k_low) + line.root_margin(level), false,
           fmt::format("{:g} to {:g} of spheres, and {} ({:.3f})", k_low, k_high, grounds, line.root_error)});
  // Fitted together, C and k make up for each other.
  const Mean c = coefficient(flows, 0.5 * (k_low + k_high));
  const double of_other_k = 0.5 * (coefficient(flows, k_high).value - coefficient(flows, k_low).value);
  out.add(name, "C with k = 1.5", "1", 0.5 * (c_low + c_high), spread, c.value,
          {0.5 * (c_high - c_low) + of_other_k + c.margin(level), false,
           fmt::format("{:g} to {:g}, what {:g} to {:g} of k changes ({:.3f}), and {} ({:.3f})", c_low,
                       c_high, k_low, k_high, of_other_k, grounds, c.error)});
  Series expected{"C = 0.58, k = 1.4", Origin::experiment, {}, {}};
  for (const double orifice : orifices) {
    expected.x.push_back(orifice);
    expected.y.push_back(0.58 * std::pow(orifice - 1.4, 2.5));
  }
  out.draw({"beverloo", name, "D / d", "W / (rho_b g^(1/2) d^(5/2))", {expected}, {rates}});
  out.draw(emptying);
  const Mean smoother_c = coefficient(smoother_flows, 0.5 * (k_low + k_high));
  out.notes.push_back(fmt::format(
      "Beverloo: {} fillings of {:.0f} d in a silo {:g} d wide, all ours; at rest the balls fill {:.3f} of "
      "the bed. There is no air. Nedderman asks for a silo of 2.5 D and of D + 30 d; at the small size "
      "only the first holds. Fitted together, k = {:.2f} +- {:.2f} and C = {:.3f} +- {:.3f}. The rates fall "
      "with friction: {:g} in place of {:g} gives C = {:.3f} +- {:.3f} with k = 1.5, from one filling. With "
      "the friction of clean glass, 0.1, balls as soft as these run out the slower the lower the head, as "
      "Pongo et al. (2021, arXiv:2104.08186) found of soft balls with little friction, so that Beverloo's "
      "law is not a test there.",
      fillings, filled.top / d, 2.0 * radius / d, filled.bulk_density / balls.density, line.root,
      line.root_error, std::pow(line.slope, 2.5), 2.5 * std::pow(line.slope, 1.5) * line.slope_error,
      smoother.friction, balls.friction, smoother_c.value, smoother_c.error));
  return out;
}

} // namespace validation
