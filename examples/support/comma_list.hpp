#pragma once
/// \file
/// Texts with commas between them.

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace scree::examples {

/// The parts of "a,b,c"; none of an empty text.
inline std::vector<std::string> comma_list(const std::string& text) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t comma = std::min(text.find(',', begin), text.size());
    parts.push_back(text.substr(begin, comma - begin));
    begin = comma + 1;
  }
  return parts;
}

} // namespace scree::examples
