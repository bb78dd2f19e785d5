/// \file
/// A tube of flat facets comes near to the analytic tube as the facets become smaller.

#include "cases.hpp"
#include "impact.hpp"
#include "mesh_shapes.hpp"

#include "scree/contact/linear_spring.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace validation {

namespace {

using scree::Vector;

constexpr double radius = 0.01; // m, of the sphere; ours, as all inputs of this case

/// A sphere that rolls round and round in a tube along z without gravity, held by its own speed. The wall is
/// soft, so that a facet passes in a fraction of the period of the contact.
struct Round : scree::Simulation<With<scree::LinearSpring<>>> {
  static constexpr double tube = 0.1, speed = 1.0, frequency = 400.0; // m, m/s, rad/s

  Round(const scree::Clump& ball, int sides)
      : Simulation{
            {.stiffness = scree::Stiffness::of_contact, .gravity = Vector::Zero(), .time_step = 4e-6}} {
    constexpr double density = 2500.0;
    const double mass = density * ball.volume;
    const double stiffness = mass * frequency * frequency;
    const auto id = add_material({.density = density,
                                  .normal_stiffness = stiffness,
                                  .shear_stiffness = 0.8 * stiffness,
                                  .friction = 0.5,
                                  .restitution = 0.9});
    const double overlap = speed * speed / (tube - radius) / (frequency * frequency);
    add({.clump = &ball,
         .material = id,
         .position = {tube - radius + overlap, 0.0, 0.0},
         .velocity = {0.0, speed, 0.0},
         .angular_velocity = {0.0, 0.0, -speed / radius}});
    const scree::Cylinder round{.radius = tube};
    const auto surface =
        sides > 0 ? scree::WallSurface{prism(tube, sides, -0.1, 0.1), id} : scree::WallSurface{round, id};
    add_wall({.name = "tube", .surfaces = {surface}, .dynamics = scree::Fixed{}});
  }
};

/// Angle [rad] about the axis that a sphere has rolled by, at every hundredth of `duration` [s].
Series rolled(const scree::Clump& ball, int sides, double duration) {
  Round sim{ball, sides};
  Series out{fmt::format("{} sides", sides), Origin::code, {}, {}};
  double angle = 0.0;
  Vector before = sim.bodies().position(0);
  for (int k = 1; k <= 100; ++k) {
    while (sim.time() < 0.01 * k * duration - 1e-9) {
      sim.step();
      const Vector now = sim.bodies().position(0);
      angle += std::atan2(before.cross(now).z(), before.dot(now));
      before = now;
    }
    out.x.push_back(sim.time());
    out.y.push_back(angle);
  }
  return out;
}

} // namespace

/// A sphere rolls round in a tube and in prisms of ever more sides.
Outcome mesh_tube(const Inputs& /*inputs*/) {
  constexpr double duration = 2.0; // s
  const char* name = "roll in a tessellated tube";
  const auto ball = scree::make_clump("sphere", std::vector<scree::Sphere>{{Vector::Zero(), radius}});
  Outcome out;
  Chart chart{"mesh_tube", name, "time, s", "angle behind the Cylinder x sides^2, rad", {}, {}};
  const Series round = rolled(ball, 0, duration);
  const std::array<int, 4> sides{128, 256, 512, 1024};
  double before = 0.0;
  for (std::size_t n = 0; n < sides.size(); ++n) {
    const double squared = std::pow(sides[n], 2);
    Series series = rolled(ball, sides[n], duration);
    for (std::size_t k = 0; k < series.y.size(); ++k) {
      series.y[k] = (round.y[k] - series.y[k]) * squared;
    }
    const double behind = series.y.back() / squared;
    chart.simulated.push_back(std::move(series));
    if (n > 0) {
      // The seams pass at a frequency W and shake the contact, of frequency w, by 1 / (1 - (w/W)^2) times the
      // chord. What the dashpot takes goes with its square, and the order of a doubling with its logarithm.
      const double seams = sides[n - 1] * Round::speed / (Round::tube - radius);
      const double q = std::pow(Round::frequency / seams, 2);
      out.add(name, fmt::format("order of the difference in angle, {} to {} sides", sides[n - 1], sides[n]),
              "1", 2.0, {Origin::theory, "a chord of angle a is off its arc by R a^2 / 8"},
              std::log2(before / behind),
              {3.0 * q, false, "3 (w/W)^2: the contact's own frequency over that of the coarser seams"});
    }
    before = behind;
  }
  out.draw(chart);
  out.notes.push_back(
      "Roll in a tessellated tube: second order is that of a contact which lasts longer than a "
      "facet. Where a facet lasts longer, each seam is an impact that takes a share of the "
      "energy with the square of its angle, and a turn as a whole is of first order; not "
      "compared. All inputs are ours.");
  return out;
}

} // namespace validation
