#pragma once
/// \file
/// The stored outputs of MFiX's verification cases: tables of numbers between lines of text.

#include "number_rows.hpp"

#include "scree/core/error.hpp"

#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

namespace validation {

/// The tables of a file, each an unbroken run of lines of nothing but numbers, as many in each.
/// \throws Error for a file that cannot be read or has none.
inline std::vector<Rows> mfix_tables(const std::filesystem::path& file) {
  std::ifstream in{file};
  if (!in) {
    throw scree::Error(scree::message(file.string(), ": cannot be opened"));
  }
  std::vector<Rows> tables;
  bool within = false;
  for (std::string line; std::getline(in, line);) {
    std::vector<double> row = numbers_in(line);
    if (row.empty()) {
      within = false;
      continue;
    }
    if (!within || tables.back().back().size() != row.size()) {
      tables.emplace_back();
    }
    within = true;
    tables.back().push_back(std::move(row));
  }
  if (tables.empty()) {
    throw scree::Error(scree::message(file.string(), ": has no table of numbers"));
  }
  return tables;
}

} // namespace validation
