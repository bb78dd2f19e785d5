#pragma once
/// \file
/// Whether a body is stepped or left alone.

#include <cstdint>

namespace scree {

/// `settling` and `waking` are for the moment at which the pairs of a body change over.
enum class Activity : std::uint8_t {
  awake,    ///< stepped
  fresh,    ///< stepped again, for less than a whole window
  waking,   ///< rested until now
  settling, ///< rests from now on
  resting   ///< left alone
};

/// Whether a body rests, once all have changed over.
[[nodiscard]] constexpr bool at_rest(Activity a) {
  return a >= Activity::settling;
}
/// Whether it rested before.
[[nodiscard]] constexpr bool was_at_rest(Activity a) {
  return a == Activity::waking || a == Activity::resting;
}

} // namespace scree
