#pragma once
/// \file
/// Numbers in files of other programs, which are no CSV: words between blanks, among lines of text.

#include "scree/io/number_text.hpp"

#include <cstddef>
#include <istream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace validation {

using Rows = std::vector<std::vector<double>>;

/// The numbers of a line; none where one of its words is something else.
inline std::vector<double> numbers_in(const std::string& line) {
  std::istringstream words{line};
  std::vector<double> numbers;
  for (std::string word; words >> word;) {
    const auto number = scree::parse_number(word);
    if (!number) {
      return {};
    }
    numbers.push_back(*number);
  }
  return numbers;
}

/// The lines that are rows of `count` numbers.
inline Rows rows_of(std::istream& text, std::size_t count) {
  Rows rows;
  for (std::string line; std::getline(text, line);) {
    if (auto row = numbers_in(line); row.size() == count) {
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

} // namespace validation
