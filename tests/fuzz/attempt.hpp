#pragma once
/// \file
/// How a reader is tried.

#include "support/scratch_folder.hpp"

#include "scree/core/error.hpp"

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace scree::test {

/// Ends the program, which a fuzzer notes as a find.
inline void insist(bool holds, const char* what) {
  if (!holds) {
    std::fprintf(stderr, "a reader went wrong: %s\n", what);
    std::abort();
  }
}

/// A file of this name in a folder that lasts as long as the program.
inline std::filesystem::path file_with(const char* name, std::string_view bytes) {
  static const ScratchFolder folder;
  const auto file = folder.path() / name;
  std::ofstream{file, std::ios::binary}.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  return file;
}

/// Calls `read()`, which may refuse what it is given in a message of one line that begins with `source`.
template <class Read>
void attempt(const std::string& source, Read read) {
  try {
    read();
  } catch (const Error& refusal) {
    const std::string_view what = refusal.what();
    insist(what.starts_with(source), "a message does not say which file");
    insist(what.find('\n') == std::string_view::npos, "a message has more than a line");
  }
}

} // namespace scree::test
