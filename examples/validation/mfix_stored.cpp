/// \file
/// MFiX's verification cases DEM02 to DEM04 with MFiX's inputs, beside MFiX's stored results. How far those
/// may be from scree's is how far they are themselves from the closed forms.

#include "bounce.hpp"
#include "cases.hpp"
#include "impact.hpp"
#include "mfix_output.hpp"

#include "scree/contact/linear_spring.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace validation {

namespace {

using Linear = With<scree::LinearSpring<>>;
constexpr double g = 9.80665; // MFiX's
const std::string version = "MFiX 21.3.2, stored results of ";

scree::Material spring(double density, double stiffness, double friction, double restitution) {
  return {.density = density,
          .normal_stiffness = stiffness,
          .shear_stiffness = stiffness,
          .friction = friction,
          .restitution = restitution};
}

/// A sphere of 0.2 m that falls from 0.5 m.
void bounces(const Inputs& inputs, Outcome& out) {
  constexpr double radius = 0.1, start = 0.5, density = 2600.0;
  constexpr int steps = 4000; // of a contact
  const auto tables = mfix_tables(inputs.file("mfix_dem/DEM02_POST_HEIGHT.dat"));
  const double mass = 4.0 / 3.0 * std::numbers::pi * std::pow(radius, 3) * density;
  std::size_t table = 0; // all restitutions of the softest spring first
  for (const double stiffness : {5e4, 5e5, 5e6}) {
    for (const double e : {1.0, 0.9, 0.8, 0.7, 0.6, 0.5}) {
      const std::string name = fmt::format("MFiX DEM02, k_n {:g} N/m, e {:g}", stiffness, e);
      const Rows& stored = tables.at(table++);
      const double frequency = std::sqrt(stiffness / mass);
      const double share = scree::damping_ratio(e);
      scree::Simulation<Linear> sim{{.stiffness = scree::Stiffness::of_contact,
                                     .gravity = {0.0, 0.0, -g},
                                     .time_step = std::numbers::pi / frequency / steps}};
      const auto id = sim.add_material(spring(density, stiffness, 0.0, e));
      const auto shape =
          scree::make_clump("ball", std::vector<scree::Sphere>{{scree::Vector::Zero(), radius}});
      sim.add({.clump = &shape, .material = id, .position = {0.0, 0.0, start}});
      sim.add_wall({.name = "floor", .surfaces = {{scree::Plane{}, id}}, .dynamics = scree::Fixed{}});
      Series code{"MFiX", Origin::code, {}, {}}, found{"scree", Origin::code, {}, {}};
      double speed = std::sqrt(2.0 * g * (start - radius));
      for (int bounce = 1; bounce <= 3; ++bounce) {
        const auto up = [&] { return sim.bodies().velocity(0).z() > 0.0; };
        while (!up()) {
          sim.step();
        }
        double highest = 0.0;
        while (up()) {
          sim.step();
          highest = std::max(highest, sim.bodies().position(0).z());
        }
        const BounceInTheory theory{g, frequency, share * frequency, speed};
        const double expected = radius + theory.top();
        speed = std::sqrt(2.0 * g * theory.top());
        const double ends = 2.0 * share * frequency + g / speed; // 1/s, change of the speed over it
        const double mfix = stored.at(static_cast<std::size_t>(bounce)).at(2);
        code.x.push_back(bounce);
        code.y.push_back(mfix);
        found.x.push_back(bounce);
        found.y.push_back(highest);
        if (bounce != 2) {
          out.add(
              name, fmt::format("height of bounce {}", bounce), "m", mfix, {Origin::code, version + "DEM02"},
              highest,
              {std::abs(mfix - expected) + 4.0 * bounce * (expected - radius) * ends * sim.time_step(), false,
               "MFiX's own distance from the closed form of a dashpot that never pulls; dashpot and weight "
               "over a step at each end of a contact"});
        }
      }
      out.draw({fmt::format("dem02_stored_{:g}_{:g}", stiffness, e),
                name,
                "bounce",
                "greatest height of the centre, m",
                {code},
                {found}});
    }
  }
}

/// Two spheres pressed between plates and let go.
void stack(const Inputs& inputs, Outcome& out) {
  constexpr double radius = 5e-4, stiffness = 1e3, top = 3.6 * radius;
  const std::vector<std::vector<Rows>> tables{mfix_tables(inputs.file("mfix_dem/DEM03_POST_POS1.dat")),
                                              mfix_tables(inputs.file("mfix_dem/DEM03_POST_POS2.dat"))};
  std::size_t table = 0;
  for (const double e : {1.0, 0.9, 0.8, 0.7, 0.6, 0.5}) {
    const std::string name = fmt::format("MFiX DEM03, e {:g}", e);
    // MFiX's dashpot, which may pull, gives e after half an oscillation. The same dashpot of scree's:
    const double own_restitution = scree::restitution(scree::half_oscillation_ratio(e));
    scree::Simulation<Linear> sim{
        {.stiffness = scree::Stiffness::of_contact, .gravity = {0.0, 0.0, -g}, .time_step = 2e-8}};
    const auto shape = scree::make_clump("ball", std::vector<scree::Sphere>{{scree::Vector::Zero(), radius}});
    for (int k = 0; k < 2; ++k) {
      sim.add(
          {.clump = &shape,
           .material = sim.add_material(spring(k == 0 ? 20000.0 : 10000.0, stiffness, 0.0, own_restitution)),
           .position = {0.0, 0.0, k == 0 ? 0.9 * radius : 2.7 * radius}});
    }
    sim.add_wall({.name = "floor", .surfaces = {{scree::Plane{}, 0}}, .dynamics = scree::Fixed{}});
    sim.add_wall({.name = "roof",
                  .surfaces = {{scree::Plane{{0.0, 0.0, top}, -scree::Vector::UnitZ()}, 1}},
                  .dynamics = scree::Fixed{}});
    std::vector<double> worst(2), own(2), off(2);
    std::vector<Series> code(2, {"MFiX", Origin::code, {}, {}}),
        found{{"lower sphere", Origin::code, {}, {}}, {"upper sphere", Origin::code, {}, {}}};
    for (std::size_t row = 1; row < tables[0].at(table).size(); ++row) {
      const double time = tables[0][table][row].at(0);
      std::vector<double> before(2);
      while (sim.time() < time) {
        before = {sim.bodies().position(0).z(), sim.bodies().position(1).z()};
        sim.step();
      }
      const double back = (sim.time() - time) / sim.time_step();
      for (std::size_t k = 0; k < 2; ++k) {
        const auto& stored = tables[k].at(table).at(row);
        const double now = sim.bodies().position(k).z(), at = now - back * (now - before[k]);
        worst[k] = std::max(worst[k], std::abs(at - stored.at(2)));
        off[k] = std::max(off[k], std::abs(at - stored.at(1)));
        own[k] = std::max(own[k], std::abs(stored.at(1) - stored.at(2)));
        code[k].x.push_back(1e6 * time);
        code[k].y.push_back(1e3 * stored.at(2));
        found[k].x.push_back(1e6 * time);
        found[k].y.push_back(1e3 * at);
      }
    }
    for (std::size_t k = 0; k < 2; ++k) {
      out.add(name, found[k].label + ": largest distance from MFiX in 1 ms", "m", 0.0,
              {Origin::code, version + "DEM03"}, worst[k],
              {own[k] + 1e-8, false, "MFiX's own distance from the solution it states, and its last digit"});
      out.add(name, found[k].label + ": largest distance from the solution in 1 ms", "m", 0.0,
              {Origin::theory, "two masses, springs and dashpots, as MFiX's DEM03 states it"}, off[k],
              {1e-8, false, "last digits of place and time in MFiX's file"});
    }
    out.draw({fmt::format("dem03_stored_{:g}", e), name, "time, us", "place, mm", code, found});
    ++table;
  }
}

/// A sphere set down sliding.
void slide(const Inputs& inputs, Outcome& out) {
  constexpr double radius = 5e-4, speed = 0.1; // the speed is not in the stored files: ours
  const Rows times = mfix_tables(inputs.file("mfix_dem/DEM04_POST_TIME.dat")).at(0),
             speeds = mfix_tables(inputs.file("mfix_dem/DEM04_POST_TVEL.dat")).at(0),
             spins = mfix_tables(inputs.file("mfix_dem/DEM04_POST_AVEL.dat")).at(0);
  for (std::size_t row = 0; row < times.size(); ++row) {
    const double mu = times[row].at(0);
    const std::string name = fmt::format("MFiX DEM04, mu {:g}", mu);
    scree::Simulation<Linear> sim{
        {.stiffness = scree::Stiffness::of_contact, .gravity = {0.0, 0.0, -g}, .time_step = 2e-6}};
    const scree::Material material = spring(1e4, 1e4, mu, 1.0);
    const auto id = sim.add_material(material);
    const auto shape = scree::make_clump("ball", std::vector<scree::Sphere>{{scree::Vector::Zero(), radius}});
    const double overlap = material.density * shape.volume * g / material.normal_stiffness;
    sim.add({.clump = &shape,
             .material = id,
             .position = {0.0, 0.0, radius - overlap},
             .velocity = {speed, 0.0, 0.0}});
    sim.add_wall({.name = "floor", .surfaces = {{scree::Plane{}, id}}, .dynamics = scree::Fixed{}});
    const auto slip = [&] {
      return sim.bodies().velocity(0).x() - (radius - 0.5 * overlap) * sim.bodies().angular_velocity(0).y();
    };
    while (slip() > 0.0) {
      sim.step();
    }
    // The spring is loaded and lets the sphere rock; MFiX's own results have the same at the end of sliding.
    const auto beside = [&](const char* quantity, const Rows& stored, double simulated) {
      const double own = std::abs(stored[row].at(2) - stored[row].at(1));
      out.add(name, quantity, "1", stored[row].at(2), {Origin::code, version + "DEM04"}, simulated,
              {own + 5e-3 * stored[row].at(1), false,
               "MFiX's own distance from the closed form, and the stretch of the tangential spring: its "
               "period over the time, 1/200 (ours)"});
    };
    beside("time to roll over v / (mu g)", times, sim.time() * mu * g / speed);
    beside("speed over that at the start", speeds, sim.bodies().velocity(0).x() / speed);
    beside("r w over the speed at the start", spins, radius * sim.bodies().angular_velocity(0).y() / speed);
  }
}

} // namespace

Outcome mfix_stored(const Inputs& inputs) {
  Outcome out;
  if (inputs.reference.empty()) {
    out.notes.push_back("MFiX's stored results need the reference data");
    return out;
  }
  bounces(inputs, out);
  stack(inputs, out);
  slide(inputs, out);
  out.notes.push_back(
      "MFiX DEM02 to DEM04: inputs are those of its mfix.dat; of DEM04 the speed at the start is ours, "
      "as its results are over it.");
  return out;
}

} // namespace validation
