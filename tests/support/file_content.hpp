#pragma once
/// \file
/// What a file holds.

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace scree::test {

/// All bytes of a file; none of one that cannot be read.
inline std::string content_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

} // namespace scree::test
