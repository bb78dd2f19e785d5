#pragma once
/// \file
/// What the misspelt name of a parameter may have meant.

#include "scree/core/error.hpp"
#include "support/options_entry.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace scree::examples::detail {

/// Edit distance (Levenshtein).
inline std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) {
    row[j] = j;
  }
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] != b[j - 1] ? 1 : 0);
      diagonal = std::exchange(row[j], std::min({row[j] + 1, row[j - 1] + 1, replaced}));
    }
  }
  return row.back();
}

/// The known name that is nearest in letters, as a hint.
inline std::string spelling_hint(const std::string& name, const std::vector<OptionsEntry>& entries) {
  std::size_t least = name.size() / 3 + 2;
  std::string nearest;
  for (const OptionsEntry& e : entries) {
    if (const std::size_t d = edit_distance(name, e.name); d < least) {
      least = d;
      nearest = e.name;
    }
  }
  return nearest.empty() ? "" : message("; did you mean '", nearest, "'?");
}

} // namespace scree::examples::detail
