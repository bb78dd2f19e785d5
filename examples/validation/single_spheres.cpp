/// \file
/// MFiX's verification cases DEM01 to DEM04: a sphere that falls and bounces, two that are held between
/// plates, one that slides until it rolls. All by the linear law, against closed forms.

#include "bounce.hpp"
#include "cases.hpp"
#include "impact.hpp"

#include "scree/contact/linear_spring.hpp"
#include "scree/simulation/run.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace validation {

/// DEM01 and DEM02: a sphere of 0.2 m falls from 0.5 m, is held by the plane's spring and dashpot and
/// bounces.
Outcome falling_sphere(const Inputs& /*inputs*/) {
  constexpr double radius = 0.1, start = 0.5, density = 2600.0, g = 9.81;
  constexpr int bounces = 3, steps = 4000; // of a contact
  const double mass = 4.0 / 3.0 * std::numbers::pi * std::pow(radius, 3) * density;
  Outcome out;
  for (const double stiffness : {5e4, 2.5e5, 1.25e6}) {
    for (const double e : {0.6, 0.8, 1.0}) {
      const std::string name = fmt::format("MFiX DEM01-02, k_n {:g} N/m, e {:g}", stiffness, e);
      const double frequency = std::sqrt(stiffness / mass);
      const double share = scree::damping_ratio(e);
      scree::Simulation<With<scree::LinearSpring<>>> sim{{.stiffness = scree::Stiffness::of_contact,
                                                          .gravity = {0.0, 0.0, -g},
                                                          .time_step = std::numbers::pi / frequency / steps}};
      const auto steel = sim.add_material({.density = density,
                                           .normal_stiffness = stiffness,
                                           .shear_stiffness = stiffness,
                                           .friction = 0.0,
                                           .restitution = e});
      const auto shape =
          scree::make_clump("ball", std::vector<scree::Sphere>{{scree::Vector::Zero(), radius}});
      sim.add({.clump = &shape, .material = steel, .position = {0.0, 0.0, start}});
      sim.add_wall({.name = "floor", .surfaces = {{scree::Plane{}, steel}}, .dynamics = scree::Fixed{}});

      // The leapfrog starts and ends a contact within a step: an impulse of first order in the step.
      const Tolerance first_order{10.0 / steps, true,
                                  "first order in the time step where a contact begins and ends"};
      const Source closed{Origin::theory, "free fall and damped oscillator under gravity that never pulls"};
      Series heights{"scree", Origin::code, {}, {}}, expected{"closed form", Origin::theory, {}, {}};
      double speed = std::sqrt(2.0 * g * (start - radius)), lowest = 0.0, highest = 0.0;
      for (int bounce = 1; bounce <= bounces; ++bounce) {
        const BounceInTheory theory{g, frequency, share * frequency, speed};
        const auto height = [&] { return sim.bodies().position(0).z() - radius; };
        while (height() >= 0.0) {
          sim.step();
        }
        lowest = 0.0;
        while (height() < 0.0) {
          lowest = std::min(lowest, height());
          sim.step();
        }
        highest = 0.0;
        while (sim.bodies().velocity(0).z() > 0.0) {
          sim.step();
          highest = std::max(highest, height());
        }
        if (bounce == 1) {
          out.add(name, "deepest", "m", -theory.height(theory.lowest()), closed, -lowest, first_order);
        }
        heights.x.push_back(bounce);
        heights.y.push_back(highest);
        expected.x.push_back(bounce);
        expected.y.push_back(theory.top());
        speed = std::sqrt(2.0 * g * theory.top());
      }
      out.add(name, "height of bounce 1", "m", expected.y.front(), closed, heights.y.front(), first_order);
      Tolerance of_all = first_order;
      of_all.size *= bounces;
      out.add(name, fmt::format("height of bounce {}", bounces), "m", expected.y.back(), closed,
              heights.y.back(), of_all);
      out.draw({fmt::format("dem02_{:g}_{:g}", stiffness, e),
                name,
                "bounce",
                "height of the foot, m",
                {expected},
                {heights}});
    }
  }
  out.notes.push_back(
      "MFiX DEM01-02: diameter, start and k_n 5e4 N/m with e 1 are MFiX's; the density and the other "
      "stiffnesses and restitutions are ours, as the closed form holds for any.");
  return out;
}

/// DEM03: two spheres, the upper half as heavy, pressed between two plates and let go.
Outcome stacked_spheres(const Inputs& /*inputs*/) {
  constexpr double radius = 5e-4, stiffness = 1e3, g = 9.81, top = 3.6 * radius;
  const char* name = "MFiX DEM03, two stacked spheres";
  scree::Simulation<With<scree::LinearSpring<>>> sim{
      {.stiffness = scree::Stiffness::of_contact, .gravity = {0.0, 0.0, -g}, .time_step = 1e-8}};
  const auto shape = scree::make_clump("ball", std::vector<scree::Sphere>{{scree::Vector::Zero(), radius}});
  const double volume = 4.0 / 3.0 * std::numbers::pi * std::pow(radius, 3);
  Eigen::Vector2d mass, at{0.9 * radius, 2.7 * radius};
  for (int k = 0; k < 2; ++k) {
    const double density = k == 0 ? 20000.0 : 10000.0;
    mass[k] = density * volume;
    sim.add({.clump = &shape,
             .material = sim.add_material({.density = density,
                                           .normal_stiffness = stiffness,
                                           .shear_stiffness = stiffness,
                                           .friction = 0.0,
                                           .restitution = 1.0}),
             .position = {0.0, 0.0, at[k]}});
  }
  sim.add_wall({.name = "floor", .surfaces = {{scree::Plane{}, 0}}, .dynamics = scree::Fixed{}});
  sim.add_wall({.name = "roof",
                .surfaces = {{scree::Plane{{0.0, 0.0, top}, -scree::Vector::UnitZ()}, 0}},
                .dynamics = scree::Fixed{}});
  // m x'' = k (what pushes it up minus what pushes it down) - m g, for as long as all three contacts last.
  const Eigen::Matrix2d springs = stiffness * Eigen::Matrix2d{{2.0, -1.0}, {-1.0, 2.0}};
  const Eigen::Vector2d rest =
      springs.inverse() *
      (stiffness * Eigen::Vector2d{radius - 2.0 * radius, 2.0 * radius + top - radius} - g * mass);
  const Eigen::Vector2d root = mass.cwiseSqrt();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> modes{root.cwiseInverse().asDiagonal() * springs *
                                                             root.cwiseInverse().asDiagonal()};
  const Eigen::Vector2d amplitude = modes.eigenvectors().transpose() * root.cwiseProduct(at - rest);
  const auto theory = [&](double t) -> Eigen::Vector2d {
    const Eigen::Vector2d swing =
        amplitude.cwiseProduct((modes.eigenvalues().cwiseSqrt() * t).array().cos().matrix());
    return rest + root.cwiseInverse().cwiseProduct(modes.eigenvectors() * swing);
  };
  Outcome out;
  Series lower{"lower sphere", Origin::code, {}, {}}, upper{"upper sphere", Origin::code, {}, {}};
  Series lower_theory{"closed form", Origin::theory, {}, {}};
  double worst = 0.0;
  while (sim.time() < 1e-3 && sim.bodies().position(1).z() - sim.bodies().position(0).z() < 2.0 * radius) {
    sim.step();
    const Eigen::Vector2d exact = theory(sim.time());
    if (exact[0] > radius || exact[1] < top - radius) {
      break; // a contact with a plate has opened
    }
    for (int k = 0; k < 2; ++k) {
      worst = std::max(worst, std::abs(sim.bodies().position(static_cast<std::size_t>(k)).z() - exact[k]));
    }
    lower.x.push_back(1e6 * sim.time());
    upper.x.push_back(1e6 * sim.time());
    lower.y.push_back(1e3 * sim.bodies().position(0).z());
    upper.y.push_back(1e3 * sim.bodies().position(1).z());
    if (sim.steps() % 500 == 0) {
      for (int k = 0; k < 2; ++k) {
        lower_theory.x.push_back(1e6 * sim.time());
        lower_theory.y.push_back(1e3 * exact[k]);
      }
    }
  }
  const double phase = std::sqrt(modes.eigenvalues()[1]) * 1e-8;
  out.add(name, fmt::format("largest distance from the closed form in {:.0f} us", lower.x.back()), "m", 0.0,
          {Origin::theory, "two masses and three springs, MFiX DEM03"}, worst,
          {phase * phase * 0.1 * radius * lower.x.back() / 10.0, false,
           "second order of the time step: (w dt)^2 of the amplitude, growing with time"});
  out.draw({"dem03", name, "time, us", "place, mm", {lower_theory}, {lower, upper}});
  return out;
}

/// DEM04: a sphere set down sliding rolls after 2 v / (7 mu g) with 5/7 of its speed.
Outcome sliding_sphere(const Inputs& /*inputs*/) {
  constexpr double radius = 0.005, speed = 0.5, g = 9.81;
  Outcome out;
  Series found{"scree", Origin::code, {}, {}}, expected{"2/7", Origin::theory, {}, {}};
  for (int tenth = 2; tenth <= 10; ++tenth) {
    const double mu = 0.1 * tenth;
    const std::string name = fmt::format("MFiX DEM04, mu {:.1f}", mu);
    scree::Simulation<With<scree::LinearSpring<>>> sim{
        {.stiffness = scree::Stiffness::of_contact, .gravity = {0.0, 0.0, -g}, .time_step = 2e-6}};
    const scree::Material glass{
        .density = 2500, .normal_stiffness = 1e5, .shear_stiffness = 1e5, .friction = mu, .restitution = 0.5};
    const auto id = sim.add_material(glass);
    const auto shape = scree::make_clump("ball", std::vector<scree::Sphere>{{scree::Vector::Zero(), radius}});
    const double overlap = glass.density * shape.volume * g / glass.normal_stiffness;
    sim.add({.clump = &shape,
             .material = id,
             .position = {0.0, 0.0, radius - overlap},
             .velocity = {speed, 0.0, 0.0}});
    sim.add_wall({.name = "floor", .surfaces = {{scree::Plane{}, id}}, .dynamics = scree::Fixed{}});
    const double expected_time = 2.0 / 7.0 * speed / (mu * g);
    double rolls = 0.0;
    while (sim.time() < 1.2 * expected_time) {
      sim.step();
      const double slip = sim.bodies().velocity(0).x() - radius * sim.bodies().angular_velocity(0).y();
      if (rolls == 0.0 && slip <= 0.0) {
        rolls = sim.time();
      }
    }
    const Tolerance of_time{5e-3, true,
                            "stretch of the tangential spring: its period over the time, 1/200 (ours)"};
    const Tolerance of_speed{1e-3, true,
                             "half the overlap off friction's arm and the spring's stretch (ours)"};
    out.add(name, "time to roll over v / (mu g)", "1", 2.0 / 7.0,
            {Origin::theory, "sliding sphere, MFiX DEM04"}, rolls * mu * g / speed, of_time);
    out.add(name, "speed over that at the start", "1", 5.0 / 7.0,
            {Origin::theory, "sliding sphere, MFiX DEM04"}, sim.bodies().velocity(0).x() / speed, of_speed);
    found.x.push_back(mu);
    found.y.push_back(rolls * mu * g / speed);
    expected.x.push_back(mu);
    expected.y.push_back(2.0 / 7.0);
  }
  out.draw({"dem04", "MFiX DEM04", "friction", "time to roll over v / (mu g)", {expected}, {found}});
  return out;
}

} // namespace validation
