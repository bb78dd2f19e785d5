#pragma once
/// \file
/// The folder that a run writes to, and what every run says of itself.

#include "scree/core/error.hpp"
#include "scree/io/atomic_file.hpp"

#include <boost/version.hpp>
#include <nlohmann/json.hpp>

#include <Eigen/Core>

#include <filesystem>
#include <string>

namespace scree::examples {

/// Makes the folder for results. `wanted` is taken as given, and refused where it holds anything: a run never
/// writes over another. An empty `wanted` gives "results/NAME-K" in the working folder with the first K that
/// is free. \throws Error naming the folder.
inline std::filesystem::path results_folder(const std::string& wanted, const std::string& name) {
  namespace fs = std::filesystem;
  fs::path folder = wanted;
  if (wanted.empty()) {
    for (int k = 1; folder.empty() || fs::exists(folder); ++k) {
      folder = fs::path{"results"} / message(name, "-", k);
    }
  }
  std::error_code error;
  if (fs::exists(folder) && (!fs::is_directory(folder) || !fs::is_empty(folder))) {
    throw Error(message(folder.string(), ": holds something already; give another --out"));
  }
  fs::create_directories(folder, error);
  if (error) {
    throw Error(message(folder.string(), ": cannot be made: ", error.message()));
  }
  return folder;
}

/// Compiler and library versions, and the version of scree where the build gives one.
inline nlohmann::ordered_json versions() {
  nlohmann::ordered_json out;
#ifdef SCREE_VERSION
  out["scree"] = SCREE_VERSION;
#endif
#if defined(__clang__)
  out["compiler"] = message("clang ", __clang_major__, ".", __clang_minor__, ".", __clang_patchlevel__);
#elif defined(__GNUC__)
  out["compiler"] = message("GCC ", __GNUC__, ".", __GNUC_MINOR__, ".", __GNUC_PATCHLEVEL__);
#endif
  out["boost"] = message(BOOST_VERSION / 100000, ".", BOOST_VERSION / 100 % 1000);
  out["eigen"] = message(EIGEN_WORLD_VERSION, ".", EIGEN_MAJOR_VERSION, ".", EIGEN_MINOR_VERSION);
#ifdef NDEBUG
  out["build"] = "release";
#else
  out["build"] = "debug";
#endif
  return out;
}

inline void write_json(const std::filesystem::path& file, const nlohmann::ordered_json& json) {
  write_atomically(file, json.dump(2) + "\n");
}

} // namespace scree::examples
