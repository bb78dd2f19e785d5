#pragma once
/// \file
/// Reads a text file as a whole, up to a limit.

#include "scree/core/error.hpp"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace scree {

/// The content of `file`, of at most `bytes` bytes.
/// \throws Error naming the file, and the line at which the limit is passed.
inline std::string read_text(const std::filesystem::path& file, std::size_t bytes) {
  // A folder opens like a file on POSIX and fails only on reading.
  std::ifstream in(file, std::ios::binary);
  if (!in || std::filesystem::is_directory(file)) {
    throw Error(message(file.string(), ": cannot be opened for reading"));
  }
  std::string text;
  std::vector<char> block(std::size_t{1} << 16U);
  while (in.read(block.data(), static_cast<std::streamsize>(block.size())), in.gcount() > 0) {
    text.append(block.data(), static_cast<std::size_t>(in.gcount()));
    if (text.size() > bytes) {
      const auto end = text.begin() + static_cast<std::ptrdiff_t>(bytes);
      const auto line = static_cast<std::size_t>(std::count(text.begin(), end, '\n')) + 1;
      throw file_error(file, line, message("the file is larger than ", bytes, " bytes"));
    }
  }
  if (in.bad()) {
    throw Error(message(file.string(), ": cannot be read"));
  }
  return text;
}

} // namespace scree
