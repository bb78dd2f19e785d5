#pragma once
/// \file
/// Replaces a file in one step, so that a reader or a killed run never meets half of one.

#include "scree/core/error.hpp"

#include <filesystem>
#include <fstream>
#include <string_view>
#include <system_error>

namespace scree {

/// Writes `content` into a temporary beside `file` (`file` plus ".part") and renames it to `file`.
/// \throws Error naming the file if it cannot be written; an older `file` is then left as it was.
inline void write_atomically(const std::filesystem::path& file, std::string_view content) {
  auto temporary = file;
  temporary += ".part";
  std::error_code ignored;
  std::ofstream out(temporary, std::ios::binary | std::ios::trunc);
  out.write(content.data(), static_cast<std::streamsize>(content.size()));
  out.close();
  if (!out) {
    std::filesystem::remove(temporary, ignored);
    throw Error(message(file.string(), ": cannot be written"));
  }
  std::error_code failure;
  std::filesystem::rename(temporary, file, failure);
  if (failure) {
    std::filesystem::remove(temporary, ignored);
    throw Error(message(file.string(), ": cannot be replaced: ", failure.message()));
  }
}

} // namespace scree
