#include "scree/core/archive.hpp"
#include "scree/core/linear.hpp"
#include "scree/core/random.hpp"

#include <doctest/doctest.h>

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

using namespace scree;

namespace {

struct Part {
  std::string name;
  Vector place = Vector::Zero();
  int scratch = 0; // not kept

  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {
    archive(self.name, self.place);
  }
};

struct Whole {
  double number = 0.0;
  std::vector<Part> parts;
  std::vector<std::uint32_t> plain;
  std::map<std::pair<int, int>, std::optional<double>> table;
  Quaternion turn = Quaternion::Identity();
  std::variant<int, Part> kind;

  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {
    archive(self.number, self.parts, self.plain, self.table, self.turn, self.kind);
  }
};

Whole whole() {
  return {-0.0,
          {{"a", {1, 2, 3}, 7}, {"", {4, 5, 1.0 / 3.0}, 8}},
          {1, 2, 3},
          {{{1, 2}, 0.5}, {{3, 4}, std::nullopt}},
          Quaternion{0.5, 0.5, -0.5, 0.5},
          Part{"held", {0, 0, 1}, 9}};
}

std::string bytes_of(const Whole& value) {
  ArchiveWriter writer;
  writer.section("whole");
  writer(value);
  return writer.bytes();
}

} // namespace

TEST_CASE("an archive gives back what was written, to the bit") {
  const std::string bytes = bytes_of(whole());
  Whole found;
  found.kind = Part{};
  ArchiveReader reader{bytes, "memory"};
  reader.section("whole");
  reader(found);
  reader.end();
  CHECK(bytes_of(found) == bytes);
  CHECK(std::signbit(found.number));
  CHECK(found.parts[1].place.z() == 1.0 / 3.0);
  CHECK(found.parts[1].scratch == 0);
  CHECK(found.table.at({1, 2}) == 0.5);
  CHECK(!found.table.at({3, 4}).has_value());
  CHECK(std::get<Part>(found.kind).name == "held");
}

TEST_CASE("an archive that is cut off anywhere is refused, whatever its sizes say") {
  const std::string bytes = bytes_of(whole());
  for (std::size_t n = 0; n < bytes.size(); ++n) {
    Whole found;
    found.kind = Part{};
    ArchiveReader reader{std::string_view{bytes}.substr(0, n), "memory"};
    CHECK_THROWS_AS((reader.section("whole"), reader(found)), Error);
  }
  // A size that no memory holds.
  ArchiveWriter writer;
  writer(std::uint64_t{1} << 62U);
  std::vector<double> numbers;
  ArchiveReader reader{writer.bytes(), "memory"};
  CHECK_THROWS_WITH_AS(reader(numbers),
                       "memory: cut off: 4611686018427387904 items expected where 0 bytes are left", Error);
}

TEST_CASE("an archive says what is in the place of what was looked for") {
  ArchiveWriter writer;
  writer.section("bodies");
  writer(std::variant<int, double>{1.5}, 3);
  ArchiveReader wrong{writer.bytes(), "file"};
  CHECK_THROWS_WITH_AS(wrong.section("walls"), "file: the part 'walls' is not where it should be", Error);
  ArchiveReader reader{writer.bytes(), "file"};
  reader.section("bodies");
  std::variant<int, double> held = 1;
  CHECK_THROWS_WITH_AS(reader(held), "file: holds a thing of kind 1 where one of kind 0 is", Error);
  held = 0.0;
  ArchiveReader again{writer.bytes(), "file"};
  again.section("bodies");
  again(held);
  CHECK(std::get<double>(held) == 1.5);
  CHECK_THROWS_WITH_AS(again.end(), "file: 4 bytes are left over", Error);
}

TEST_CASE("a yes or no that is neither is refused") {
  const std::string bytes{"\2", 1};
  bool answer = false;
  ArchiveReader reader{bytes, "file"};
  CHECK_THROWS_WITH_AS(reader(answer), "file: holds neither yes nor no where one of them should be", Error);
}

TEST_CASE("a stream of random numbers goes on where it was kept") {
  Random random{3, "stream"};
  for (int k = 0; k < 1000; ++k) {
    (void)random.normal();
  }
  ArchiveWriter writer;
  writer(random);
  const double next = random.uniform();
  Random other{9};
  ArchiveReader reader{writer.bytes(), "memory"};
  reader(other);
  reader.end();
  CHECK(other.uniform() == next);
}
