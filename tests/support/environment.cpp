#include "support/environment.hpp"

#include "scree/core/error.hpp"

#include <iostream>

namespace scree::test {

namespace {
bool any_skipped = false;
}

std::filesystem::path source_directory() {
  return SCREE_SOURCE_DIR;
}

std::filesystem::path reference_directory() {
  return SCREE_REFERENCE_DIR;
}

std::optional<std::filesystem::path> reference_file(const std::filesystem::path& name) {
  const std::filesystem::path folder = reference_directory();
  if (folder.empty()) {
    skip(message("no reference data: configure with -DSCREE_REFERENCE_DIR=... for ", name.string()));
    return std::nullopt;
  }
  if (!std::filesystem::exists(folder / name)) {
    throw Error(message("the reference data in ", folder.string(), " lack ", name.string()));
  }
  return folder / name;
}

void skip(std::string_view reason) {
  any_skipped = true;
  std::cout << "skipped: " << reason << '\n';
}

bool has_skipped() {
  return any_skipped;
}

} // namespace scree::test
