/// \file
/// Beverloo, Leniger & van de Velde (1961): how fast balls run out of a circular orifice in a flat bottom.

#include "ball_bed.hpp"
#include "cases.hpp"

#include "scree/contact/linear_spring.hpp"
#include "scree/measure/porosity.hpp"
#include "scree/measure/surface_height.hpp"

#include <fmt/format.h>

#include <array>
#include <chrono>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace validation {

namespace {

struct Quiet : scree::DefaultModel {
  static constexpr bool energy_audit = false;
};
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
  double orifice = 0.0;        ///< m
  std::vector<double> rates{}; ///< kg/s, of equal parts of the time
  double head_lost = 0.0;      ///< share of the balls that run out in that time
  double seconds = 0.0;        ///< of that time
  Series emptied{};            ///< s, g

  [[nodiscard]] Mean rate() const { return Mean{rates}; }
};

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
  Discharge out;
  out.orifice = orifice;
  out.emptied.label = fmt::format("D / d = {:g}", orifice / d);
  out.emptied.origin = Origin::code;
  double start = 0.0;
  const auto run_out = [&](double until) {
    while (silo.time() < until) {
      scree::run_for(silo, 0.2 * tau);
      silo.remove_bodies(
          [d](const auto& bodies, std::size_t b) { return bodies.position(b).z() < -2.0 * d; });
      out.emptied.x.push_back(silo.time());
    }
    return all - mass_where(silo, [d](const scree::Vector& at) { return at.z() >= -d; });
  };
  // Balls fall from half an orifice above and to a diameter below before the flow is steady; ours: thrice.
  start = 3.0 * (std::sqrt(orifice / balls.g) + tau);
  double before = run_out(start), then = silo.time();
  const double first = before;
  for (int k = 1; k <= blocks; ++k) {
    const double after = run_out(start + duration * k / blocks);
    out.rates.push_back((after - before) / (silo.time() - then));
    before = after;
    then = silo.time();
  }
  out.head_lost = (before - first) / all;
  out.seconds = duration;
  return out;
}

} // namespace

Outcome beverloo(const Inputs& inputs) {
  Balls balls;
  const double d = balls.diameter, radius = 10.0 * d;
  const auto t0 = std::chrono::steady_clock::now();
  const Filled filled = fill(balls, radius, 5000, inputs.threads);
  const auto el = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - t0).count();
  };
  fmt::print("filled {} top {} d, density {} at {} s\n", filled.packing.bodies.size(), filled.top / d,
             filled.bulk_density, el());
  for (double q : {5.0, 5.75, 6.5, 7.25, 8.0}) {
    const auto x = discharge(balls, filled, radius, q * d, 30.0 * balls.time(), inputs.threads);
    const Mean r = x.rate();
    const double unit = filled.bulk_density * std::sqrt(balls.g) * std::pow(d, 2.5);
    fmt::print("{} rate {} +- {} lost {} t {}: ", q, r.value / unit, r.standard_error / unit, x.head_lost,
               el());
    for (double v : x.rates)
      fmt::print("{:.2f} ", v / unit);
    fmt::print("  C {}\n", r.value / unit / std::pow(q - 1.4, 2.5));
  }
  return {};
}

} // namespace validation
