#pragma once
/// \file
/// Replaces a file in one step, so that a reader or a killed run never meets half of one.

#include "scree/core/error.hpp"

#include <filesystem>
#include <fstream>
#include <string_view>
#include <system_error>

#if defined(__unix__) || defined(__APPLE__)
#include <fcntl.h>
#include <unistd.h>
#endif

namespace scree {

/// Whether what is written is on the disk itself before a call returns, so that it outlives a power cut too.
enum class Durable { no, yes };

/// Waits until the system has brought a file or folder to its disk. Does nothing where that is not known how.
/// Returns whether it went well.
inline bool bring_to_disk(const std::filesystem::path& file) {
#if defined(__unix__) || defined(__APPLE__)
  const int handle = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (handle < 0) {
    return false;
  }
  const bool well = ::fsync(handle) == 0;
  return ::close(handle) == 0 && well;
#else
  (void)file;
  return true;
#endif
}

/// Writes `content` into a temporary beside `file` (`file` plus ".part") and renames it to `file`.
/// \throws Error naming the file if it cannot be written; an older `file` is then left as it was.
inline void write_atomically(const std::filesystem::path& file, std::string_view content,
                             Durable durable = Durable::no) {
  auto temporary = file;
  temporary += ".part";
  std::error_code ignored;
  std::ofstream out(temporary, std::ios::binary | std::ios::trunc);
  out.write(content.data(), static_cast<std::streamsize>(content.size()));
  out.close();
  if (!out || (durable == Durable::yes && !bring_to_disk(temporary))) {
    std::filesystem::remove(temporary, ignored);
    throw Error(message(file.string(), ": cannot be written"));
  }
  std::error_code failure;
  std::filesystem::rename(temporary, file, failure);
  if (failure) {
    std::filesystem::remove(temporary, ignored);
    throw Error(message(file.string(), ": cannot be replaced: ", failure.message()));
  }
  if (durable == Durable::yes) {
    // Some file systems cannot do this with folders.
    const auto folder = file.parent_path();
    (void)bring_to_disk(folder.empty() ? std::filesystem::path{"."} : folder);
  }
}

} // namespace scree
