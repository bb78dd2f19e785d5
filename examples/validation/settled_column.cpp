/// \file
/// Stress in a bed at rest that repeats sideways: the weight above, on a level floor and on a slope.

#include "ball_bed.hpp"
#include "cases.hpp"

#include "scree/measure/stress.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace validation {

namespace {

using Bed = scree::Simulation<Quiet>;

/// Mean resultant over mean contact force at which the bed counts as at rest; ours.
constexpr double at_rest = 1e-6;

/// Share of the weight above a plane that the resultants of all balls above it can come to.
Tolerance of_rest(const Bed& bed, double weight) {
  const scree::UnbalancedForce unbalanced = scree::unbalanced_force(bed);
  const double most = at_rest * unbalanced.mean_contact * static_cast<double>(bed.bodies().size()) / weight;
  return {
      most, true,
      fmt::format("resultants of all balls, {:g} of the mean contact force each, over the weight", at_rest)};
}

/// Planes and layers of the bed against the weight above them, `weight` being that of 1 kg.
void compare(Outcome& out, const Bed& bed, const std::string& name, const scree::Vector& gravity,
             double floor, double top, double area) {
  const Source statics{Origin::theory, "equilibrium of what lies above"};
  Series normal{"planes, normal", Origin::code, {}, {}}, shear{"planes, shear", Origin::code, {}, {}};
  Series normal_theory{"weight above", Origin::theory, {}, {}},
      shear_theory{"its part along the floor", Origin::theory, {}, {}};
  for (int k = 0; k < 40; ++k) {
    const double z = floor + (top - floor) * k / 40.0;
    const scree::Vector carried = scree::force_through_plane(bed, 2, z);
    const double above = mass_where(bed, [z](const scree::Vector& at) { return at.z() >= z; });
    const double depth = 1e3 * (top - z);
    normal.x.push_back(depth);
    normal.y.push_back(carried.z() / area);
    shear.x.push_back(depth);
    shear.y.push_back(-carried.x() / area);
    normal_theory.x.push_back(depth);
    normal_theory.y.push_back(-above * gravity.z() / area);
    shear_theory.x.push_back(depth);
    shear_theory.y.push_back(above * gravity.x() / area);
    if (k % 8 == 0) {
      const std::string at = fmt::format(" at {:.2f} of the height", k / 40.0);
      const double weight = above * gravity.norm();
      const Tolerance rest = of_rest(bed, weight);
      out.add(name, "normal stress" + at, "Pa", -above * gravity.z() / area, statics, carried.z() / area,
              rest);
      const Tolerance rest_in_pascal{rest.size * weight / area, false, rest.grounds};
      out.add(name, "shear stress along the slope" + at, "Pa", above * gravity.x() / area, statics,
              -carried.x() / area, rest_in_pascal);
      out.add(name, "shear stress across" + at, "Pa", 0.0, statics, carried.y() / area, rest_in_pascal);
    }
  }
  // The mean over a layer: each ball weighs on the part of the layer that is below it.
  const double low = floor + 0.25 * (top - floor), high = floor + 0.5 * (top - floor);
  const scree::Vector period = bed.setup().period;
  const scree::Matrix stress =
      scree::mean_stress(bed, {scree::Vector{0.0, 0.0, low}, scree::Vector{period.x(), period.y(), high}});
  double above = 0.0;
  for (std::size_t b = 0; b < bed.bodies().size(); ++b) {
    above += bed.bodies().mass(b) * std::clamp((bed.bodies().position(b).z() - low) / (high - low), 0.0, 1.0);
  }
  const double weight = above * gravity.norm();
  out.add(name, "mean stress of a layer, normal", "Pa", -above * gravity.z() / area, statics, stress(2, 2),
          of_rest(bed, weight));
  out.add(name, "mean stress of a layer, shear", "Pa", above * gravity.x() / area, statics, -stress(0, 2),
          {of_rest(bed, weight).size * weight / area, false, of_rest(bed, weight).grounds});
  out.notes.push_back(fmt::format("{}: stress along over stress normal to the floor in the layer, K = {:.3f} "
                                  "down the slope and {:.3f} across; of this there is no exact value.",
                                  name, stress(0, 0) / stress(2, 2), stress(1, 1) / stress(2, 2)));
  out.draw({fmt::format("column_{}", gravity.x() > 0.0 ? "slope" : "level"),
            name,
            "depth, mm",
            "stress, Pa",
            {normal_theory, shear_theory},
            {normal, shear}});
}

void check_rest(Outcome& out, const std::string& name, double unbalanced) {
  out.add(name, "mean resultant over mean contact force", "1", 0.0,
          {Origin::theory, "equilibrium of every ball"}, unbalanced,
          {at_rest, false, "what counts as rest (ours)"});
}

} // namespace

/// Balls poured on a floor in a box that repeats sideways; then the lowest are held and the bed is tilted.
Outcome settled_column(const Inputs& inputs) {
  const Balls balls;
  const double d = balls.diameter, tau = balls.time();
  const double side = (inputs.full ? 20.0 : 10.0) * d;
  const std::size_t count = inputs.full ? 16000 : 2000;
  Bed bed{{.stiffness = scree::Stiffness::of_contact,
           .gravity = {0.0, 0.0, -balls.g},
           .period = {side, side, 0.0},
           .local_damping = 0.3,
           .threads = inputs.threads}};
  const auto glass = bed.add_material(balls.material());
  bed.add_wall({.name = "floor", .surfaces = {{scree::Plane{}, glass}}, .dynamics = scree::Fixed{}});
  scree::Random random{1, "settled column"};
  bed.add(loose_balls(balls, count, {scree::Vector::Zero(), scree::Vector{side, side, d}}, random, glass));
  const auto top_of = [&] {
    double top = 0.0;
    for (std::size_t b = 0; b < bed.bodies().size(); ++b) {
      top = std::max(top, bed.bodies().position(b).z());
    }
    return top;
  };
  scree::run_for(bed, 2.0 * std::sqrt(2.0 * top_of() / balls.g));
  Outcome out;
  std::string name = "Settled column, level floor";
  check_rest(out, name, come_to_rest(bed, at_rest, 400.0 * tau, 2.0 * tau));
  const double area = side * side;
  compare(out, bed, name, bed.setup().gravity, 0.0, top_of(), area);
  double mass = 0.0;
  for (std::size_t b = 0; b < bed.bodies().size(); ++b) {
    mass += bed.bodies().mass(b);
  }
  out.add(name, "force on the floor", "N", mass * balls.g, {Origin::theory, "weight of all balls"},
          -bed.wall(0).load.force.z(), of_rest(bed, mass * balls.g));

  // A smooth floor would let the lowest balls roll away, so they are held.
  bed.fix_bodies([&](const auto& bodies, std::size_t b) { return bodies.position(b).z() < 0.8 * d; });
  const double slope = 15.0 * std::numbers::pi / 180.0;
  const int tilts = 150;
  for (int k = 1; k <= tilts; ++k) {
    const double angle = slope * k / tilts;
    bed.set_gravity(balls.g * scree::Vector{std::sin(angle), 0.0, -std::cos(angle)});
    scree::run_for(bed, 0.2 * tau);
  }
  name = "Settled column, slope of 15 degrees";
  check_rest(out, name, come_to_rest(bed, at_rest, 400.0 * tau, 2.0 * tau));
  compare(out, bed, name, bed.setup().gravity, 1.2 * d, top_of(), area);
  const scree::Vector carried = scree::force_through_plane(bed, 2, 0.5 * top_of());
  // Both forces are in doubt by the same, the smaller one by the larger share.
  const Tolerance rest = of_rest(bed, carried.norm());
  const double shares = carried.norm() / std::abs(carried.x()) + carried.norm() / std::abs(carried.z());
  out.add(name, "shear over normal stress at half height", "1", std::tan(slope),
          {Origin::theory, "tan of the slope"}, -carried.x() / carried.z(),
          {shares * rest.size, true, rest.grounds + ", of each of the two"});
  out.notes.push_back("Settled column: the balls, the box and the slope are ours; the laws hold for any.");
  return out;
}

} // namespace validation
