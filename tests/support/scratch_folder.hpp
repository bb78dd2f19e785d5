#pragma once
/// \file
/// A folder of its own for a test that writes files.

#include <filesystem>
#include <random>
#include <string>
#include <system_error>

namespace scree::test {

/// An empty folder among the system's temporary files, removed with its content at the end of the scope.
class ScratchFolder {
public:
  ScratchFolder() {
    // Not scree::Random, whose names would be the same for tests that run at the same time.
    std::random_device entropy;
    do {
      path_ = std::filesystem::temp_directory_path() /
              ("scree_" + std::to_string(entropy()) + std::to_string(entropy()));
    } while (!std::filesystem::create_directory(path_));
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::filesystem::path operator/(const std::filesystem::path& name) const {
    return path_ / name;
  }

private:
  std::filesystem::path path_;
};

} // namespace scree::test
