#pragma once
/// \file
/// Spheres between six smooth walls, three of which are pressed or driven: the press of a triaxial test.

#include "impact.hpp"

#include "scree/contact/linear_spring.hpp"
#include "scree/measure/energy.hpp"
#include "scree/measure/stress.hpp"
#include "scree/measure/unbalanced_force.hpp"
#include "scree/packing/loose_lattice.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace validation {

/// A wall that is pressed with a force, or driven along its axis at a given speed.
struct Platen {
  scree::ForceControlled pressed;
  scree::Vector axis;                  ///< unit vector, into the sample
  std::shared_ptr<const double> speed; ///< m/s along the axis; not a number: pressed

  static void start(scree::WallMotion& motion, const scree::TimeStep&) { motion.velocity.setZero(); }
  void advance(scree::WallMotion& motion, const scree::WallLoad& load, const scree::TimeStep& step) const {
    if (std::isnan(*speed)) {
      pressed.advance(motion, load, step);
    } else {
      motion.velocity = *speed * axis;
      motion.position += motion.velocity * step.dt;
    }
  }
  [[nodiscard]] double mobility(double arm) const { return pressed.mobility(arm); }
};

struct PressModel : scree::DefaultModel {
  using Walls = scree::Walls<scree::Fixed, Platen>;
};

/// What a sample is and how it is tested. All numbers are ours.
struct PressSetup {
  std::size_t spheres = 500;
  double pressure = 1e5;         ///< Pa, of the consolidation and then of the sides
  double diameter = 2e-3;        ///< m, mean; uniform from 0.75 to 1.25 of it
  double stiffness_ratio = 300;  ///< k_n over pressure times diameter
  double friction = 0.5;         ///< between spheres, in the test; the walls have none
  double density = 2650.0;       ///< kg/m3
  double inertial_number = 9e-4; ///< of axial strain rate, diameter, density and pressure
  unsigned threads = 1;
  std::uint64_t seed = 1;
};

/// The sample, from a loose lattice to the end of the test. Compression counts as positive.
class Press : public scree::Simulation<PressModel> {
public:
  using Vector = scree::Vector;

  explicit Press(const PressSetup& setup)
      : Simulation{{.stiffness = scree::Stiffness::of_contact,
                    .gravity = Vector::Zero(),
                    .local_damping = 0.1,
                    .threads = setup.threads}},
        setup_{setup} {
    grains_.density = setup.density;
    grains_.normal_stiffness = setup.stiffness_ratio * setup.pressure * setup.diameter;
    grains_.shear_stiffness = 0.8 * grains_.normal_stiffness;
    grains_.friction = setup.friction;
    grains_.restitution = 0.9;
    rock_ = add_material(grains_);
    scree::Material smooth = grains_;
    smooth.friction = 0.0;
    const auto wall = add_material(smooth);

    scree::Random random{setup.seed, "triaxial sample"};
    const std::vector<scree::Clump> shapes{
        scree::make_clump("sphere", std::vector<scree::Sphere>{{Vector::Zero(), 0.5 * setup.diameter}})};
    std::vector<scree::DrawnClump> drawn;
    for (std::size_t k = 0; k < setup.spheres; ++k) {
      drawn.push_back({0, random.uniform(0.75, 1.25)});
    }
    // Twice as high as wide, as the samples of the laboratory.
    const double cell = 1.25 * 1.02 * setup.diameter;
    const double wide = std::round(std::cbrt(0.5 * static_cast<double>(setup.spheres)));
    const double width = wide * cell * (1.0 + 1e-9);
    const double height = std::ceil(static_cast<double>(setup.spheres) / (wide * wide)) * cell;
    const scree::Packing packing =
        scree::loose_lattice(shapes, drawn, {Vector::Zero(), Vector{width, width, height}}, random);
    add(packing);
    solid_ = scree::solid_volume(packing);

    const Vector corner{width, width, height};
    for (int d = 0; d < 3; ++d) {
      const Vector axis = Vector::Unit(d);
      add_wall({.name = "fixed",
                .surfaces = {{scree::Plane{Vector::Zero(), axis}, wall}},
                .dynamics = scree::Fixed{}});
      const auto k = static_cast<std::size_t>(d);
      // A mass and a dashpot that let the wall follow within a share of a per cent of the pressure.
      const double mass = 0.1 * solid_ * setup.density;
      scree::ForceControlled by_force{{.axis = -axis,
                                       .mass = mass,
                                       .force = [this, d](double) { return setup_.pressure * area(d); },
                                       .damping = 0.2 * std::sqrt(grains_.normal_stiffness * mass)}};
      add_wall({.name = "platen",
                .surfaces = {{scree::Plane{Vector::Zero(), -axis}, wall}},
                .dynamics = Platen{std::move(by_force), -axis, speed_[k]},
                .motion = {.position = corner[d] * axis}});
    }
  }

  /// Presses the lattice together at one rate and lets it come to equilibrium under the pressure, with
  /// another friction between the spheres than in the test.
  void consolidate(double friction) {
    scree::Material other = grains_;
    other.friction = friction;
    change_material(rock_, other);
    const double rate = 0.015 * rate_of(1.0); // an inertial number of 0.015: a quick but dense flow
    while (stress().mean() < 0.5 * setup_.pressure) {
      for (int d = 0; d < 3; ++d) {
        *speed_[static_cast<std::size_t>(d)] = rate * size(d);
      }
      step();
    }
    for (const auto& speed : speed_) {
      *speed = pressed;
    }
    do {
      for (int k = 0; k < 1000; ++k) {
        step();
      }
    } while (scree::unbalanced_force(*this).ratio() > 2e-3 ||
             (stress() / setup_.pressure - Vector::Ones()).cwiseAbs().maxCoeff() > 2e-3);
    change_material(rock_, grains_);
    height_ = size(2);
    volume_ = volume();
  }

  /// Drives the upper wall at the rate of the test, in true strain.
  void shear_step() {
    *speed_[2] = axial_rate() * size(2);
    step();
  }

  /// m, between opposite walls.
  [[nodiscard]] double size(int d) const { return wall(platen(d)).motion.position[d]; }
  [[nodiscard]] double volume() const { return size(0) * size(1) * size(2); }
  /// m2, of the wall normal to axis `d`.
  [[nodiscard]] double area(int d) const { return size((d + 1) % 3) * size((d + 2) % 3); }
  [[nodiscard]] double void_ratio() const { return volume() / solid_ - 1.0; }
  /// 1/s, of the test.
  [[nodiscard]] double axial_rate() const { return rate_of(setup_.inertial_number); }
  /// Since the consolidation, true strains.
  [[nodiscard]] double axial_strain() const { return std::log(height_ / size(2)); }
  [[nodiscard]] double volume_strain() const { return std::log(volume_ / volume()); }

  /// Pa, of the three axes, from the walls: the mean of opposite ones.
  [[nodiscard]] Vector stress() const {
    Vector sum;
    for (int d = 0; d < 3; ++d) {
      sum[d] = 0.5 * (wall(platen(d)).load.force[d] - wall(platen(d) - 1).load.force[d]) / area(d);
    }
    return sum;
  }
  /// N s, what the walls took since the start, the mean of opposite ones: over time and area, the mean
  /// stress.
  [[nodiscard]] Vector impulse() const {
    Vector sum;
    for (int d = 0; d < 3; ++d) {
      sum[d] = 0.5 * (wall(platen(d)).load.impulse[d] - wall(platen(d) - 1).load.impulse[d]);
    }
    return sum;
  }
  /// Pa, of the three axes, from the contacts.
  [[nodiscard]] Vector contact_stress() const {
    const Eigen::AlignedBox3d sample{Vector::Zero(), Vector{size(0), size(1), size(2)}};
    return scree::mean_stress(*this, sample).diagonal();
  }
  /// J, done on the spheres by all walls since the start.
  [[nodiscard]] double boundary_work() const {
    double sum = 0.0;
    for (const auto& w : walls()) {
      sum += w.load.work;
    }
    return sum;
  }
  /// J, in the springs and in motion.
  [[nodiscard]] double stored() const {
    return scree::elastic_energy(*this) + scree::kinetic_energy(bodies());
  }
  /// J, lost since the start.
  [[nodiscard]] double lost() const { return dissipation().total(); }
  [[nodiscard]] const PressSetup& press() const { return setup_; }

private:
  static constexpr double pressed = std::numeric_limits<double>::quiet_NaN();
  static std::size_t platen(int d) { return static_cast<std::size_t>(2 * d + 1); }
  /// 1/s, at which the inertial number under the pressure is `number`.
  [[nodiscard]] double rate_of(double number) const {
    return number / setup_.diameter * std::sqrt(setup_.pressure / setup_.density);
  }

  PressSetup setup_;
  scree::Material grains_;
  scree::MaterialId rock_ = 0;
  double solid_ = 0.0, height_ = 0.0, volume_ = 0.0; // m3, m, m3
  std::array<std::shared_ptr<double>, 3> speed_{std::make_shared<double>(0.0), std::make_shared<double>(0.0),
                                                std::make_shared<double>(0.0)};
};

} // namespace validation
