#include "scree/core/random.hpp"
#include "scree/io/csv.hpp"
#include "support/file_content.hpp"
#include "support/scratch_folder.hpp"

#include <doctest/doctest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

using namespace scree;
using scree::test::content_of;
using scree::test::ScratchFolder;

namespace {

void write(const std::filesystem::path& file, std::string_view content) {
  std::ofstream(file, std::ios::binary).write(content.data(), static_cast<std::streamsize>(content.size()));
}

/// The message of the Error that `action` throws, or nothing.
template <class Action>
std::optional<std::string> error_of(Action action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return std::nullopt;
}

/// Checks that the content is refused at this line, with this in the message.
void refused_at(std::size_t line, std::string_view what, std::string_view content,
                const CsvLimits& limits = {}) {
  const ScratchFolder folder;
  const auto file = folder / "refused.csv";
  write(file, content);
  const auto why = error_of([&] { (void)read_csv(file, limits); });
  REQUIRE_MESSAGE(why, "accepted: ", content);
  CHECK_MESSAGE(*why == message(file.string(), ":", line, ": ", what), *why);
}

} // namespace

TEST_CASE("a table is written as lines of shortest numbers") {
  const ScratchFolder folder;
  const auto file = folder / "drag.csv";
  CsvWriter table{file, {"time_s", "force_N"}, "two lines\nof comment"};
  CHECK(content_of(file) == "# two lines\n# of comment\ntime_s,force_N\n");
  table.row({0.1, -1500});
  CHECK_MESSAGE(content_of(file) == "# two lines\n# of comment\ntime_s,force_N\n0.1,-1500\n",
                "each row is in the file at once");
  table.row(std::array{1e-300, 1.0 / 3.0});
  CHECK(content_of(file) ==
        "# two lines\n# of comment\ntime_s,force_N\n0.1,-1500\n1e-300,0.3333333333333333\n");
  CHECK(table.rows() == 2);
}

TEST_CASE("numbers of a table come back to the bit") {
  const ScratchFolder folder;
  const auto file = folder / "bits.csv";
  std::vector<double> numbers{0.0, -0.0, std::numeric_limits<double>::denorm_min(),
                              std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest()};
  Random random{2};
  while (numbers.size() < 2000) {
    numbers.push_back(random.normal() * std::pow(10.0, std::floor(random.uniform(-300.0, 300.0))));
  }
  {
    CsvWriter table{file, {"value"}};
    for (const double number : numbers) {
      table.row({number});
    }
  }
  const auto read = read_csv(file);
  REQUIRE(read.rows() == numbers.size());
  std::size_t same = 0;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    same += std::bit_cast<std::uint64_t>(read.column("value")[i]) == std::bit_cast<std::uint64_t>(numbers[i])
                ? 1
                : 0;
  }
  CHECK(same == numbers.size());
}

TEST_CASE("a writer refuses what could not be read back") {
  const ScratchFolder folder;
  const auto file = folder / "t.csv";
  const auto refused = [&](std::vector<std::string> columns, const std::string& what) {
    const auto why = error_of([&] { CsvWriter{file, columns}; });
    REQUIRE(why);
    CHECK(*why == file.string() + ": " + what);
    CHECK_FALSE(std::filesystem::exists(file));
  };
  refused({}, "a table needs a column");
  refused({"a", ""}, "\"\" cannot name a column");
  refused({"a,b"}, "\"a,b\" cannot name a column");
  refused({"a\nb"}, "\"a\nb\" cannot name a column");
  refused({"#a"}, "\"#a\" cannot name a column");
  refused({"a "}, "\"a \" cannot name a column");
  refused({"7"}, "\"7\" cannot name a column");
  refused({"a", "b", "a"}, "two columns are named a");

  CsvWriter table{file, {"time_s", "force_N"}};
  table.row({0, 1});
  const std::string before = content_of(file);
  CHECK(error_of([&] { table.row({1.0}); }) == file.string() + ": a row of 1 numbers for 2 columns");
  CHECK(error_of([&] {
          table.row({1.0, std::nan("")});
        }) == file.string() + ": force_N = nan in row 2 is not a finite number");
  CHECK(error_of([&] {
          table.row({-std::numeric_limits<double>::infinity(), 0.0});
        }) == file.string() + ": time_s = -inf in row 2 is not a finite number");
  CHECK_MESSAGE(content_of(file) == before, "a refused row leaves nothing behind");
}

TEST_CASE("a table that cannot be written says so") {
  const ScratchFolder folder;
  const auto nowhere = folder / "missing" / "t.csv";
  CHECK(error_of([&] { CsvWriter{nowhere, {"a"}}; }) == nowhere.string() + ": cannot be opened for writing");
  if (std::filesystem::exists("/dev/full")) { // a device of Linux that is always full
    CHECK(error_of([] {
            CsvWriter{"/dev/full", {"a"}};
          }) == "/dev/full: cannot be written, is the disk full?");
  }
}

TEST_CASE("tables of other programs are read") {
  const ScratchFolder folder;
  const auto file = folder / "measured.csv";
  write(file, "\xEF\xBB\xBF# measured\r\n\r\n drag_m , force_N\r\n0, +1.5e2\r\n# a pause\r\n\t.5,-2E-1\r\n");
  const auto table = read_csv(file);
  CHECK(table.columns == std::vector<std::string>{"drag_m", "force_N"});
  REQUIRE(table.rows() == 2);
  CHECK(table.column("drag_m")[1] == 0.5);
  CHECK(table.column("force_N")[0] == 150.0);
  CHECK(table.column("force_N")[1] == -0.2);
  CHECK(error_of([&] { (void)table.column("force"); }) ==
        file.string() + ": no column force among drag_m, force_N");
}

TEST_CASE("a reader refuses what is no table of numbers, with file and line") {
  refused_at(1, "the file holds no table", "");
  refused_at(3, "the file holds no table", "# only\n\n");
  refused_at(2, "the table holds no rows", "a,b\n");
  refused_at(3, "the file is cut off, its last line has no end", "a,b\n1,2\n3,4");
  refused_at(1, "names of columns expected, not the number 1.5", "1.5,2\n3,4\n");
  refused_at(1, "\"\" cannot name a column", "a,,b\n1,2,3\n");
  refused_at(1, "\"\"a\"\" cannot name a column", "\"a\",b\n1,2\n");
  refused_at(2, "two columns are named a", "# x\na,a\n1,2\n");
  refused_at(4, "1 fields in a table of 2 columns", "a,b\n1,2\n# x\n3\n");
  refused_at(2, "3 fields in a table of 2 columns", "a,b\n1,2,\n");
  refused_at(3, "b is \"\", not a finite number", "a,b\n1,2\n3,\n");
  for (const std::string bad : {"nan", "NaN", "-inf", "infinity", "1e999", "0x10", "1.5x", "1 2", "--1",
                                "+-1", "1;2", "1'000", "none"}) {
    refused_at(2, message("b is \"", bad, "\", not a finite number"), "a,b\n1," + bad + "\n");
  }
  refused_at(2, "a is \"?1\", not a finite number", std::string_view{"a\n\0001\n", 5});
  const std::string forty(40, '7');
  refused_at(2, message("a is \"", forty, "...\", not a finite number"), "a\n" + forty + "77x\n");
}

TEST_CASE("a reader refuses oversize tables") {
  refused_at(3, "the file is larger than 10 bytes", "a,b\n1,2\n3,4\n", {.bytes = 10});
  refused_at(1, "3 columns, at most 2 are read", "a,b,c\n1,2,3\n", {.columns = 2});
  const ScratchFolder folder;
  const auto file = folder / "fits.csv";
  write(file, "a,b\n1,2\n3,4\n");
  CHECK(read_csv(file, {.bytes = 12, .columns = 2}).rows() == 2);
}

TEST_CASE("a reader refuses a folder and a missing file") {
  const ScratchFolder folder;
  const auto missing = folder / "missing.csv";
  CHECK(error_of([&] { (void)read_csv(missing); }) == missing.string() + ": cannot be opened for reading");
  const auto path = folder / "";
  CHECK(error_of([&] { (void)read_csv(path); }) == path.string() + ": cannot be opened for reading");
}

TEST_CASE("numbers are read whole or not at all") {
  CHECK(parse_number("1e3") == 1000.0);
  CHECK(parse_number("+.5") == 0.5);
  for (const std::string_view bad :
       {"", "+", "-", "++1", "+-1", " 1", "1 ", "1e", "1,5", "nan", "inf", "1e400"}) {
    CHECK_MESSAGE(!parse_number(bad), bad);
  }
  CHECK(number_text(0.1) == "0.1");
  CHECK(number_text(100000.0) == "1e+05");
}

TEST_CASE("a table is gone on with behind the rows that count") {
  const ScratchFolder folder;
  const auto file = folder / "table.csv";
  std::uintmax_t counted = 0;
  {
    CsvWriter csv{file, {"a", "b"}, "made"};
    csv.row({1.0, 2.0});
    counted = csv.bytes_on_disk();
    csv.row({3.0, 4.0});
  }
  const std::string before = content_of(file).substr(0, counted);
  CHECK(before == "# made\na,b\n1,2\n");
  CsvWriter::go_on(file, {"a", "b"}, counted).row({5.0, 6.0});
  CHECK(content_of(file) == before + "5,6\n");
  CHECK_THROWS_WITH_AS(
      CsvWriter::go_on(file, {"a", "b"}, 1000),
      (file.string() + ": has 19 bytes, fewer than the 1000 that were written before").c_str(), Error);
  CHECK_THROWS_AS(CsvWriter::go_on(folder / "missing.csv", {"a"}, 0), Error);
}
