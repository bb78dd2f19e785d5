/// \file
/// The order of the folders of include/scree, and what a header may include at all.

#include "support/environment.hpp"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

struct Folder {
  int level;
  /// The levels that it may include; every lower one where this is left out.
  std::optional<std::set<int>> only = std::nullopt;
};

const std::map<std::string, Folder> folders{
    {"core", {0}},
    {"geometry", {1}},
    {"material", {1}},
    {"state", {2}},
    {"packing", {3}},
    {"neighbours", {3}},
    {"contact", {3}},
    {"walls", {3}},
    {"integrators", {3}},
    {"measure", {3}},
    {"io", {3}},
    {"simulation", {4}},
    {"laboratory", {5}},
    {"compare", {6, {{0}}}},
    {"calibrate", {7, {{0, 6}}}},
    {"diagnose", {8, {{0, 6, 7}}}},
};

bool may_include(const std::string& from, const std::string& to) {
  if (from == to) {
    return true;
  }
  const Folder& user = folders.at(from);
  const Folder& used = folders.at(to);
  return used.level < user.level && (!user.only || user.only->contains(used.level));
}

/// Headers of the compiler, the standard library, Eigen and Boost.
bool is_allowed_outside(const std::string& header) {
  static const std::regex allowed{"[a-z_0-9]+|immintrin\\.h|Eigen/[A-Za-z]+|boost/.+"};
  return std::regex_match(header, allowed);
}

/// The first folder of "folder/file.hpp"; empty for "file.hpp".
std::string folder_of(const std::string& header) {
  const auto slash = header.find('/');
  return slash == std::string::npos ? std::string{} : header.substr(0, slash);
}

/// What the system alone can do: to wait until a file is on its disk.
bool is_of_the_system(const std::string& name, const std::string& header) {
  return name == "io/atomic_file.hpp" && (header == "fcntl.h" || header == "unistd.h");
}

/// What is wrong with a header; `name` is its path below include/scree.
std::vector<std::string> faults_of(const std::string& name, const std::string& text) {
  std::vector<std::string> faults;
  const auto fault = [&](const std::string& what) { faults.push_back(name + ": " + what); };

  const std::string folder = folder_of(name);
  if (!folder.empty() && !folders.contains(folder)) {
    fault("the folder has no level in this test");
    return faults;
  }
  if (!text.starts_with("#pragma once\n/// \\file\n")) {
    fault("does not begin with '#pragma once' and '/// \\file'");
  }

  static const std::regex include_line{R"(^\s*#\s*include\s*([<"])([^>"]+)[>"])"};
  std::istringstream lines{text};
  std::smatch match;
  for (std::string line; std::getline(lines, line);) {
    if (!std::regex_search(line, match, include_line)) {
      continue;
    }
    const std::string header = match[2];
    if (match[1] == "<") {
      if (!is_allowed_outside(header) && !is_of_the_system(name, header)) {
        fault("includes <" + header + ">, which is none of the standard library, Eigen and Boost");
      }
      continue;
    }
    const std::string used = header.starts_with("scree/") ? folder_of(header.substr(6)) : std::string{};
    if (!folders.contains(used)) {
      fault("includes \"" + header + "\", which is in no folder of scree");
    } else if (!folder.empty() && !may_include(folder, used)) {
      fault("includes \"" + header + "\", which is not below " + folder);
    }
  }
  return faults;
}

std::string text_of(const std::filesystem::path& file) {
  std::ifstream in{file, std::ios::binary};
  return {std::istreambuf_iterator<char>{in}, {}};
}

/// Whether a header of `top` includes Eigen, itself or through others of scree.
bool reaches_eigen(const std::filesystem::path& top, const std::string& name, std::set<std::string>& seen) {
  if (!seen.insert(name).second) {
    return false;
  }
  static const std::regex include_line{R"(#\s*include\s*[<"](?:scree/)?([^>"]+)[>"])"};
  const std::string text = text_of(top / name);
  for (std::sregex_iterator it{text.begin(), text.end(), include_line}, end; it != end; ++it) {
    const std::string used = (*it)[1];
    if (used.starts_with("Eigen/") ||
        (std::filesystem::exists(top / used) && reaches_eigen(top, used, seen))) {
      return true;
    }
  }
  return false;
}

} // namespace

TEST_CASE("every header includes only what its folder may include") {
  const auto top = scree::test::source_directory() / "include" / "scree";
  int headers = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator{top}) {
    if (!entry.is_regular_file()) {
      continue;
    }
    CHECK_MESSAGE(entry.path().extension() == ".hpp", entry.path().string(), " is not a .hpp file");
    ++headers;
    const std::string name = entry.path().lexically_relative(top).generic_string();
    for (const std::string& fault : faults_of(name, text_of(entry.path()))) {
      FAIL_CHECK(fault);
    }
  }
  CHECK(headers > 0);
}

TEST_CASE("every header that names a type of Eigen includes it, itself or through others") {
  // The check that headers compile alone has Eigen read beforehand.
  const auto top = scree::test::source_directory() / "include" / "scree";
  const std::regex type{R"(\b(Eigen::|Vector\b|Matrix\b|Quaternion\b))"};
  int users = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator{top}) {
    if (!entry.is_regular_file() || !std::regex_search(text_of(entry.path()), type)) {
      continue;
    }
    const std::string name = entry.path().lexically_relative(top).generic_string();
    std::set<std::string> seen;
    CHECK_MESSAGE(reaches_eigen(top, name, seen), name);
    ++users;
  }
  CHECK(users > 20);
  std::set<std::string> seen;
  CHECK_FALSE(reaches_eigen(top, "core/error.hpp", seen));
}

TEST_CASE("the check of includes finds what is wrong") {
  const std::string start = "#pragma once\n/// \\file\n";
  const auto faults = [&](const std::string& name, const std::string& line) {
    return faults_of(name, start + line + "\n").size();
  };

  CHECK(faults("contact/law.hpp", "#include \"scree/state/bodies.hpp\"") == 0);
  CHECK(faults("contact/law.hpp", "#include \"scree/contact/other.hpp\"") == 0);
  CHECK(faults("contact/law.hpp", "#include \"scree/walls/fixed.hpp\"") == 1);
  CHECK(faults("state/bodies.hpp", "  #  include \"scree/contact/law.hpp\"") == 1);
  CHECK(faults("calibrate/fit.hpp", "#include \"scree/compare/curve.hpp\"") == 0);
  CHECK(faults("calibrate/fit.hpp", "#include \"scree/simulation/simulation.hpp\"") == 1);
  CHECK(faults("compare/curve.hpp", "#include \"scree/geometry/sphere.hpp\"") == 1);
  CHECK(faults("core/a.hpp", "#include \"b.hpp\"") == 1);
  CHECK(faults("core/a.hpp", "#include \"scree/unknown/b.hpp\"") == 1);
  CHECK(faults("unknown/a.hpp", "") == 1);

  CHECK(faults("core/a.hpp", "#include <vector>") == 0);
  CHECK(faults("core/a.hpp", "#include <immintrin.h>") == 0);
  CHECK(faults("core/a.hpp", "#include <Eigen/Core>") == 0);
  CHECK(faults("core/a.hpp", "#include <boost/geometry.hpp>") == 0);
  CHECK(faults("core/a.hpp", "#include <fmt/format.h>") == 1);
  CHECK(faults("core/a.hpp", "#include <arpa/inet.h>") == 1);

  CHECK(faults_of("core/a.hpp", "// a comment\n#pragma once\n/// \\file\n").size() == 1);
}
