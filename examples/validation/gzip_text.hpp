#pragma once
/// \file
/// Text files, packed or not.

#include "scree/core/error.hpp"

#include <zlib.h>

#include <array>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>

namespace validation {

/// The content of a file, unpacked where it is packed by gzip.
/// \throws scree::Error naming the file.
inline std::string read_packed_text(const std::filesystem::path& file) {
  const std::unique_ptr<gzFile_s, int (*)(gzFile)> in{gzopen(file.string().c_str(), "rb"), gzclose};
  if (!in) {
    throw scree::Error(scree::message(file.string(), ": cannot be opened for reading"));
  }
  std::string text;
  std::array<char, std::size_t{1} << 16U> block{};
  int got = 0;
  while ((got = gzread(in.get(), block.data(), static_cast<unsigned>(block.size()))) > 0) {
    text.append(block.data(), static_cast<std::size_t>(got));
  }
  int code = Z_OK;
  (void)gzerror(in.get(), &code);
  if (got < 0 || (code != Z_OK && code != Z_STREAM_END)) {
    throw scree::Error(scree::message(file.string(), ": cannot be read or unpacked"));
  }
  return text;
}

} // namespace validation
