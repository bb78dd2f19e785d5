#include "scree/io/checkpoint_file.hpp"
#include "support/file_content.hpp"
#include "support/scratch_folder.hpp"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <string>

using namespace scree;
using scree::test::content_of;
using scree::test::ScratchFolder;

namespace {

void put(const std::filesystem::path& file, const std::string& content) {
  std::ofstream(file, std::ios::binary) << content;
}

} // namespace

TEST_CASE("the last two checkpoints are kept, and the newest whole one is read") {
  const ScratchFolder folder;
  const auto file = folder / "state";
  const std::string first{"one\0\n", 5}, second{"two"}, third{"three"};
  write_checkpoint(file, "a drag", first);
  CHECK(read_checkpoint(file, "a drag").content == first);
  write_checkpoint(file, "a drag", second);
  write_checkpoint(file, "a drag", third);
  CHECK(read_checkpoint(file, "a drag").content == third);
  CHECK(read_checkpoint(file, "a drag").remark.empty());
  CHECK(read_one_checkpoint(folder / "state.before", "a drag") == second);

  const std::string whole = content_of(file);
  for (std::size_t n = 0; n < whole.size(); ++n) { // cut off anywhere, or one bit another
    put(file, whole.substr(0, n));
    CHECK(read_checkpoint(file, "a drag").content == second);
    std::string other = whole;
    other[n] = static_cast<char>(other[n] ^ 4);
    put(file, other);
    const Checkpoint found = read_checkpoint(file, "a drag");
    CHECK(found.content == second);
    CHECK(found.remark.find(file.string()) == 0);
  }
  put(file, whole);
  CHECK(read_checkpoint(file, "a drag").content == third);
  // Killed between the two renames.
  std::filesystem::rename(file, folder / "state.new");
  CHECK(read_checkpoint(file, "a drag").content == second);
}

TEST_CASE("what is no checkpoint, or one of something else, is refused with the reason") {
  const ScratchFolder folder;
  const auto file = folder / "state";
  write_checkpoint(file, "a drag", "content");
  const std::string whole = content_of(file), head = "scree checkpoint 1 of a drag\n";
  REQUIRE(whole.substr(0, head.size()) == head);
  const auto reason = [&](const std::string& content) {
    put(file, content);
    try {
      (void)read_one_checkpoint(file, "a drag");
    } catch (const Error& error) {
      return std::string{error.what()}.substr(file.string().size());
    }
    return std::string{};
  };
  CHECK(reason(whole).empty());
  CHECK(reason("") == ": is no checkpoint");
  CHECK(reason("solid\n") == ": is no checkpoint");
  CHECK(reason("scree checkpoint 1 of a heap\n") ==
        ": is a 'scree checkpoint 1 of a heap', not a 'scree checkpoint 1 of a drag'");
  CHECK(reason("scree checkpoint 9 of a drag\n").find("checkpoint 9") != std::string::npos);
  CHECK(reason(head + std::string{"\1\2\3\4"} + whole.substr(head.size() + 4)) ==
        ": was written on a machine with another order of bytes");
  CHECK(reason(whole + "x") == ": the checkpoint is cut off");
  std::string other = whole;
  other[head.size() + 14] = 'C';
  CHECK(reason(other) == ": the checkpoint is damaged: its checksum is another");
  std::filesystem::remove(file);
  CHECK_THROWS_WITH_AS((void)read_checkpoint(file, "a drag"),
                       (file.string() + ": cannot be opened for reading; " + file.string() +
                        ".before: cannot be opened for reading")
                           .c_str(),
                       Error);
}

TEST_CASE("a checkpoint that cannot be written leaves the older one") {
  const ScratchFolder folder;
  const auto file = folder / "state";
  write_checkpoint(file, "a drag", "content");
  std::filesystem::create_directory(folder / "state.new"); // in the way
  put(folder / "state.new" / "x", "x");
  CHECK_THROWS_AS(write_checkpoint(file, "a drag", "other"), Error);
  CHECK(read_checkpoint(file, "a drag").content == "content");
}
