#include "scree/io/atomic_file.hpp"
#include "support/file_content.hpp"
#include "support/scratch_folder.hpp"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

using namespace scree;
using scree::test::content_of;
using scree::test::ScratchFolder;

TEST_CASE("a file is replaced as a whole") {
  const ScratchFolder folder;
  const auto file = folder / "summary.json";
  write_atomically(file, "a longer first content\n");
  // A reader that opened the old file goes on with the old file: it was replaced, not overwritten.
  std::ifstream reader(file);
  const std::string second{"second\0\n", 8};
  write_atomically(file, second);
  CHECK(content_of(file) == second);
  CHECK(std::string{std::istreambuf_iterator<char>(reader), {}} == "a longer first content\n");
  CHECK_FALSE(std::filesystem::exists(file.string() + ".part"));
}

TEST_CASE("a replacement that fails leaves what was there") {
  const ScratchFolder folder;
  const auto nowhere = folder / "missing" / "x";
  CHECK_THROWS_WITH_AS(write_atomically(nowhere, "x"), (nowhere.string() + ": cannot be written").c_str(),
                       Error);

  const auto taken = folder / "taken"; // a folder that holds a file cannot be replaced by a file
  std::filesystem::create_directory(taken);
  write_atomically(taken / "kept", "kept");
  CHECK_THROWS_AS(write_atomically(taken, "x"), Error);
  CHECK(content_of(taken / "kept") == "kept");
  CHECK_FALSE(std::filesystem::exists(taken.string() + ".part"));
}
