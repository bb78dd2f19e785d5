#pragma once
/// \file
/// Numbers as text: the shortest form that reads back to the same double, free of any locale.

#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

namespace scree {

/// The shortest decimal text that reads back to the same bits.
inline std::string number_text(double value) {
  char digits[32];
  const auto end = std::to_chars(digits, digits + sizeof digits, value);
  return {digits, end.ptr};
}

/// The finite number that the whole of `text` spells, or nothing. Takes one leading '+'; takes no white
/// space, no hexadecimal form, no infinity and nothing beyond the range of a double.
inline std::optional<double> parse_number(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') {
    text.remove_prefix(1);
  }
  double value = 0.0;
  const auto end = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end.ec != std::errc{} || end.ptr != text.data() + text.size() || !std::isfinite(value)) {
    return std::nullopt;
  }
  return value;
}

} // namespace scree
