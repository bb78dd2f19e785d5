/// \file
/// What fuzzers found worth keeping is read again: inputs that take a reader somewhere new, and those that
/// once broke one.

#include "fuzz/readers.hpp"
#include "support/environment.hpp"
#include "support/file_content.hpp"

#include <doctest/doctest.h>

#include <cstddef>
#include <filesystem>
#include <string>

using namespace scree;

namespace {

template <class Read>
void replay(const char* corpus, Read read) {
  const auto folder = test::source_directory() / "tests/fuzz/corpora" / corpus;
  std::size_t inputs = 0;
  for (const auto& entry : std::filesystem::directory_iterator{folder}) {
    CAPTURE(entry.path());
    CHECK_NOTHROW(read(test::content_of(entry.path())));
    ++inputs;
  }
  CHECK(inputs > 0);
}

} // namespace

TEST_CASE("whatever an STL file holds, it is read or refused") {
  replay("stl", test::read_as_stl);
}
TEST_CASE("whatever a table holds, it is read or refused") {
  replay("csv", test::read_as_csv);
}
#if defined(SCREE_READS_CALIBRATIONS)
TEST_CASE("whatever a calibration.toml holds, it is read or refused") {
  replay("calibration", test::read_as_calibration);
}
#endif
TEST_CASE("whatever a checkpoint holds, it is read or refused") {
  replay("checkpoint", test::read_as_checkpoint);
}
