#pragma once
/// \file
/// A contact of two spheres that are moved by hand: what a law answers to a known motion.

#include "scree/simulation/pair_loop.hpp"

#include <array>
#include <cstddef>

namespace scree::test {

/// Two spheres of one material whose poses are given; velocities are those that lead from pose to pose, as
/// between the steps of the leapfrog. Sums what was put in and what the law says was lost.
template <class Law>
class DrivenContact {
public:
  using History = std::array<double, static_cast<std::size_t>(Law::history_size)>;

  DrivenContact(const Law& law, const Material& material, double radius_i, double radius_j)
      : pair{mix(material, material, Stiffness::of_contact)}, law_{law} {
    i_.radius = radius_i;
    j_.radius = radius_j;
    i_.inverse_mass = j_.inverse_mass = 1.0;
  }

  /// Puts the spheres down without any history.
  void place(const Vector& i, const Vector& j) {
    i_.position = to_vec3(i);
    j_.position = to_vec3(j);
    history = {};
  }
  /// Moves the spheres to new places within `dt` [s] while they turn at `spin_i`, `spin_j` [rad/s].
  void move(const Vector& i, const Vector& j, const Vector& spin_i, const Vector& spin_j, double dt) {
    i_.velocity = (to_vec3(i) - i_.position) * (1.0 / dt);
    j_.velocity = (to_vec3(j) - j_.position) * (1.0 / dt);
    i_.angular_velocity = to_vec3(spin_i);
    j_.angular_velocity = to_vec3(spin_j);
    evaluate(i, j, dt);
  }
  /// Moves the spheres to new places as one rigid body that turns at `spin` [rad/s] about the origin.
  /// Velocities are those of the places half a step back, so that there is no slip whatever the step.
  void move_rigidly(const Vector& i, const Vector& j, const Vector& spin, double dt) {
    Matrix turning;
    turning << 0.0, -spin.z(), spin.y(), spin.z(), 0.0, -spin.x(), -spin.y(), spin.x(), 0.0;
    // v = spin x (place - dt / 2 v)
    const Matrix halfway = (Matrix::Identity() + 0.5 * dt * turning).inverse() * turning;
    i_.velocity = to_vec3(Vector(halfway * i));
    j_.velocity = to_vec3(Vector(halfway * j));
    i_.angular_velocity = j_.angular_velocity = to_vec3(spin);
    evaluate(i, j, dt);
  }

  [[nodiscard]] Vector tangential() const { return to_eigen(force.tangential); }
  [[nodiscard]] double elastic_energy() const {
    return law_.elastic_energy(pair, kinematics.reduced_radius, kinematics.overlap, history);
  }

  PairMaterial<double> pair;
  History history{};
  Kinematics<double> kinematics{};
  ContactForce<double> force{};
  double friction = 0.0, viscous = 0.0; ///< J, lost as the law has it
  double work_put_in = 0.0;             ///< J, against the force on the contact

private:
  void evaluate(const Vector& i, const Vector& j, double dt) {
    i_.position = to_vec3(i);
    j_.position = to_vec3(j);
    const Vec3<double> apart = i_.position - j_.position;
    const Touch<double> touch = touch_of(i_, j_, apart, squared_norm(apart), dt);
    const Vec3<double> force_before = kinematics.normal * force.normal + force.tangential;
    const Vec3<double> couple_before = force.couple;
    kinematics = touch.kinematics;
    force = law_.evaluate(pair, kinematics, history);
    friction += force.frictional_work;
    viscous += force.viscous_work;
    // Of second order: the mean of the forces at both ends of the step.
    const Vec3<double> mean = (force_before + kinematics.normal * force.normal + force.tangential) * 0.5;
    const Vec3<double> spin = i_.angular_velocity - j_.angular_velocity;
    work_put_in -= (dot(mean, kinematics.velocity) + dot((couple_before + force.couple) * 0.5, spin)) * dt;
  }

  Law law_;
  SphereRecord<double> i_, j_;
};

} // namespace scree::test
