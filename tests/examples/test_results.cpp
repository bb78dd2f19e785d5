#include "support/results.hpp"
#include "support/scratch_folder.hpp"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <string>

using namespace scree;
using namespace scree::examples;
using scree::test::ScratchFolder;
namespace fs = std::filesystem;

namespace {

/// Makes a folder the working folder for a while.
class WorkingFolder {
public:
  explicit WorkingFolder(const fs::path& folder) : before_{fs::current_path()} { fs::current_path(folder); }
  WorkingFolder(const WorkingFolder&) = delete;
  WorkingFolder& operator=(const WorkingFolder&) = delete;
  ~WorkingFolder() { fs::current_path(before_); }

private:
  fs::path before_;
};

} // namespace

TEST_CASE("without a wish each run gets a folder of its own") {
  const ScratchFolder folder;
  const WorkingFolder here{folder / ""};
  CHECK(results_folder("", "drag-desk") == fs::path{"results/drag-desk-1"});
  CHECK(results_folder("", "drag-desk") == fs::path{"results/drag-desk-2"});
  CHECK(results_folder("", "drag-lab") == fs::path{"results/drag-lab-1"});
  CHECK(fs::is_directory(folder / "results" / "drag-desk-2"));
}

TEST_CASE("a wished folder is made, or taken if it is empty, and never written over") {
  const ScratchFolder folder;
  const auto wanted = folder / "deep" / "run";
  CHECK(results_folder(wanted.string(), "drag") == wanted);
  CHECK(results_folder(wanted.string(), "drag") == wanted);
  std::ofstream(wanted / "drag.csv") << "kept";
  CHECK_THROWS_WITH_AS(results_folder(wanted.string(), "drag"),
                       (wanted.string() + ": holds something already; give another --out").c_str(), Error);
  const auto file = wanted / "drag.csv";
  CHECK_THROWS_WITH_AS(results_folder(file.string(), "drag"),
                       (file.string() + ": holds something already; give another --out").c_str(), Error);
  CHECK_THROWS_AS(results_folder((file / "below").string(), "drag"), Error);
  CHECK(fs::file_size(file) == 4);
}

TEST_CASE("a record is written as a whole") {
  const ScratchFolder folder;
  const auto file = folder / "summary.json";
  const nlohmann::ordered_json summary{
      {"force_N", 0.1}, {"remarks", {"\u00B0", "a \"b\""}}, {"finished", false}};
  write_json(file, summary);
  std::ifstream in(file);
  CHECK(nlohmann::ordered_json::parse(in) == summary);
  CHECK_FALSE(fs::exists(file.string() + ".part"));
}

TEST_CASE("the versions name compiler, libraries and build") {
  const auto json = versions();
#ifdef SCREE_VERSION
  CHECK(json.at("scree") == SCREE_VERSION);
#endif
  const auto compiler = json.at("compiler").get<std::string>();
  CHECK((compiler.find("GCC ") == 0 || compiler.find("clang ") == 0));
  CHECK(json.at("boost").get<std::string>().find("1.") == 0);
  CHECK(json.at("eigen").get<std::string>().find('.') != std::string::npos);
  CHECK((json.at("build") == "release" || json.at("build") == "debug"));
}
