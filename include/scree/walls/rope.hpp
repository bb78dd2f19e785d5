#pragma once
/// \file
/// A rope between a winch and a point of a wall body.

#include "scree/core/error.hpp"
#include "scree/state/wall_motion.hpp"

#include <cmath>
#include <functional>
#include <limits>
#include <string>

namespace scree {

/// Pulls only. Its stretch is that of the geometry, |winch - hitch| - (L0 - wound in), which is what Coetzee
/// et al. (2010) Eqs. (16)-(19) accumulate step by step, but without their drift; tension k_r times the
/// stretch (Eq. (20)).
struct Rope {
  std::string name = "rope";
  Vector hitch = Vector::Zero();              ///< m, in the wall's frame
  Vector winch = Vector::Zero();              ///< m, in space
  double stiffness = 0.0;                     ///< N/m, above 0
  double damping = 0.0;                       ///< N s/m, 0 or above; not in the paper
  double slack = 0.0;                         ///< m, by which it is longer than the distance at the start
  std::function<double(double time)> wound{}; ///< m wound in by a time; none for a rope of constant length

  double unstretched = std::numeric_limits<double>::quiet_NaN(); ///< m, at the start: set by `taut`
  double stretch = 0.0;                                          ///< m, in the last step; below 0 when slack
  double tension = 0.0;                                          ///< N, in the last step, 0 or above
  Vector impulse = Vector::Zero();                               ///< N s, given to the body since the start
  double winch_work = 0.0;                                       ///< J, put in by the winch since the start

  /// Sets the length at the start from where the body is, unless one was given.
  /// \throws Error for a parameter out of range.
  void taut(const WallMotion& motion, double time) {
    require_positive(message("rope '", name, "': stiffness"), stiffness, "N/m");
    require(message("rope '", name, "': damping"), damping, {0.0, 1e300, "N s/m"});
    if (std::isnan(unstretched)) {
      unstretched = (winch - motion.to_space(hitch)).norm() + slack + wound_at(time);
    }
  }

  /// What changes while it pulls.
  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {
    archive(self.unstretched, self.stretch, self.tension, self.impulse, self.winch_work);
  }

  [[nodiscard]] double wound_at(double time) const { return wound ? wound(time) : 0.0; }

  /// N, on the body at the hitch, from its present pose.
  Vector pull(const WallMotion& motion, double time) {
    const Vector at = motion.to_space(hitch);
    const Vector to_winch = winch - at;
    const double length = to_winch.norm();
    if (!(length > 0.0)) {
      throw Error(message("rope '", name, "': the hitch has reached the winch at t = ", time, " s"));
    }
    stretch = length - (unstretched - wound_at(time));
    const double closing = motion.velocity_at(at).dot(to_winch) / length;
    tension = stretch > 0.0 ? std::fmax(0.0, stiffness * stretch - damping * closing) : 0.0;
    return to_winch * (tension / length);
  }
};

} // namespace scree
