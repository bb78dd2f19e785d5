#pragma once
/// \file
/// A wall that stays where it is.

#include "scree/walls/concept.hpp"

#include <type_traits>
#include <variant>

namespace scree {

struct Fixed {
  static void start(WallMotion& motion, const TimeStep&) {
    motion.velocity.setZero();
    motion.angular_velocity.setZero();
  }
  static void advance(WallMotion&, const WallLoad&, const TimeStep&) {}
};

/// Whether a wall of these dynamics never moves.
template <class... Dynamics>
bool stands_still(const std::variant<Dynamics...>& dynamics) {
  return std::visit([](const auto& d) { return std::is_same_v<std::decay_t<decltype(d)>, Fixed>; }, dynamics);
}

} // namespace scree
