#pragma once
/// \file
/// What the dynamics of a wall body must offer.
///
///     // Called once before the first step; may set the pose and velocity of the wall.
///     void start(WallMotion& motion, const TimeStep& step);
///     // Moves the wall from `step.time` to `step.time + step.dt`, given what the grains did to it.
///     void advance(WallMotion& motion, const WallLoad& load, const TimeStep& step);
///
/// Velocities in `motion` stand half a step behind the pose, as those of the grains do. Dynamics that give
/// way to forces also say how easily, for the stable time step:
///
///     // 1/kg, acceleration under a force of 1 N of the point that gives way most, at most `arm` [m] from
///     // the wall's origin.
///     double mobility(double arm) const;
///     // rad2/s2, of what holds the wall besides the grains (ropes), and its name for messages.
///     double squared_frequency() const;
///     std::string holder() const;
///     // 1/s, where what holds it also damps: damping coefficient times mobility, summed.
///     double damping_rate() const;
///
/// Dynamics that hold more than plain numbers say which of it is kept in a checkpoint (core/archive.hpp):
///
///     template <class Self, class Archive>
///     static void fields(Self& self, Archive& archive);
///
/// Given by the library: Fixed, Prescribed, ForceControlled, RopeCoupled.

#include "scree/state/wall_motion.hpp"

#include <concepts>
#include <string>

namespace scree {

template <class D>
concept StartsWall = requires(D& dynamics, WallMotion& motion, const TimeStep& step) {
  dynamics.start(motion, step);
};

template <class D>
concept AdvancesWall = requires(D& dynamics, WallMotion& motion, const WallLoad& load, const TimeStep& step) {
  dynamics.advance(motion, load, step);
};

template <class D>
concept GivesWay = requires(const D& dynamics, double arm) {
  { dynamics.mobility(arm) } -> std::convertible_to<double>;
};

template <class D>
concept IsHeld = requires(const D& dynamics) {
  { dynamics.squared_frequency() } -> std::convertible_to<double>;
  { dynamics.holder() } -> std::convertible_to<std::string>;
};

template <class D>
concept WallDynamics = std::copyable<D> && StartsWall<D> && AdvancesWall<D>;

} // namespace scree
