#pragma once
/// \file
/// A rigid body made of walls, free but for gravity, the grains and any number of ropes.

#include "scree/geometry/mass_properties.hpp"
#include "scree/state/rotation.hpp"
#include "scree/walls/concept.hpp"
#include "scree/walls/rope.hpp"

#include <Eigen/Eigenvalues>

#include <utility>
#include <vector>

namespace scree {

/// The bucket of Coetzee et al. (2010) section 5: six degrees of freedom, Eqs. (3)-(20) as corrected (Euler's
/// equations for (6), moments x_h x F_r, the rotation matrix of the quaternion for (9)-(10)), leapfrog in
/// time.
class RopeCoupled {
public:
  /// `body`: mass, centre and inertia in the wall's frame.
  /// \throws Error for a mass of 0 or below or an inertia that no solid has.
  explicit RopeCoupled(const MassProperties& body, std::vector<Rope> ropes = {})
      : mass_{require_positive("rope-coupled wall: mass", body.mass, "kg")},
        centre_{body.centre},
        ropes_{std::move(ropes)} {
    if (!body.inertia.allFinite() || !body.centre.allFinite() ||
        !body.inertia.isApprox(body.inertia.transpose(), 1e-9)) {
      throw Error("rope-coupled wall: centre and inertia must be finite and the inertia symmetric");
    }
    const Eigen::SelfAdjointEigenSolver<Matrix> solver{body.inertia};
    inertia_ = solver.eigenvalues();
    if (!(inertia_[0] > 0.0) || inertia_[0] + inertia_[1] < inertia_[2] * (1.0 - 1e-9)) {
      throw Error(message("rope-coupled wall: principal moments of inertia ", inertia_[0], ", ", inertia_[1],
                          ", ", inertia_[2], " kg m2 are those of no solid"));
    }
    Matrix axes = solver.eigenvectors();
    if (axes.determinant() < 0.0) {
      axes.col(2) *= -1.0;
    }
    principal_ = Quaternion{axes};
  }

  void start(WallMotion& motion, const TimeStep& step) {
    velocity_ = motion.velocity_at(motion.to_space(centre_));
    spin_ = (motion.orientation * principal_).conjugate() * motion.angular_velocity;
    for (Rope& rope : ropes_) {
      rope.taut(motion, step.time);
    }
  }

  void advance(WallMotion& motion, const WallLoad& load, const TimeStep& step) {
    const Vector centre = motion.to_space(centre_);
    Vector force = load.force + mass_ * step.gravity;
    Vector moment = load.moment - (centre - motion.position).cross(load.force);
    for (Rope& rope : ropes_) {
      const Vector pull = rope.pull(motion, step.time);
      force += pull;
      moment += (motion.to_space(rope.hitch) - centre).cross(pull);
      rope.impulse += pull * step.kick;
      rope.winch_work += rope.tension * (rope.wound_at(step.time + step.dt) - rope.wound_at(step.time));
    }
    const Quaternion axes = motion.orientation * principal_;
    velocity_ += force * (step.kick / mass_);
    spin_ = kicked(spin_, axes.conjugate() * moment, inertia_, step.kick);
    const Quaternion next = turned(axes, spin_, step.dt);

    motion.orientation = (next * principal_.conjugate()).normalized();
    motion.position = centre + velocity_ * step.dt - motion.orientation * centre_;
    motion.angular_velocity = next * spin_;
    motion.velocity = velocity_ - motion.angular_velocity.cross(motion.orientation * centre_);
  }

  [[nodiscard]] double mobility(double arm) const {
    const double reach = arm + centre_.norm();
    return 1.0 / mass_ + reach * reach / inertia_.minCoeff();
  }
  /// Of all ropes pulling as one at their hitches.
  [[nodiscard]] double squared_frequency() const {
    double sum = 0.0;
    for (const Rope& rope : ropes_) {
      const double arm2 = (rope.hitch - centre_).squaredNorm();
      sum += rope.stiffness * (1.0 / mass_ + arm2 / inertia_.minCoeff());
    }
    return sum;
  }
  /// 1/s, of all rope dashpots as one at their hitches.
  [[nodiscard]] double damping_rate() const {
    double sum = 0.0;
    for (const Rope& rope : ropes_) {
      const double arm2 = (rope.hitch - centre_).squaredNorm();
      sum += rope.damping * (1.0 / mass_ + arm2 / inertia_.minCoeff());
    }
    return sum;
  }
  [[nodiscard]] std::string holder() const {
    const Rope* stiffest = nullptr;
    for (const Rope& rope : ropes_) {
      stiffest = stiffest == nullptr || rope.stiffness > stiffest->stiffness ? &rope : stiffest;
    }
    return stiffest == nullptr ? std::string{}
                               : message("rope '", stiffest->name, "' of ", stiffest->stiffness,
                                         " N/m on a body of ", mass_, " kg");
  }

  /// What changes while it moves.
  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {
    archive.same("number of ropes", self.ropes_.size());
    archive(self.velocity_, self.spin_);
    for (auto& rope : self.ropes_) {
      archive(rope);
    }
  }

  [[nodiscard]] const std::vector<Rope>& ropes() const { return ropes_; }
  [[nodiscard]] std::vector<Rope>& ropes() { return ropes_; }
  [[nodiscard]] double mass() const { return mass_; }
  /// m, in the wall's frame.
  [[nodiscard]] const Vector& centre() const { return centre_; }
  /// m/s, of the centre of mass, half a step behind the pose.
  [[nodiscard]] const Vector& velocity() const { return velocity_; }
  /// J, of translation and rotation.
  [[nodiscard]] double kinetic_energy() const {
    return 0.5 * mass_ * velocity_.squaredNorm() + 0.5 * spin_.dot(inertia_.cwiseProduct(spin_));
  }

private:
  double mass_;
  Vector centre_;
  Vector inertia_ = Vector::Zero();
  Quaternion principal_ = Quaternion::Identity(); // principal axes to wall frame
  std::vector<Rope> ropes_;
  Vector velocity_ = Vector::Zero();
  Vector spin_ = Vector::Zero(); // rad/s, in the principal frame
};

} // namespace scree
