#include "scree/core/compressed_rows.hpp"

#include <doctest/doctest.h>

#include <vector>

using namespace scree;

namespace {

/// Row i has (7 i) mod 5 items, so that a fifth of the rows is empty.
std::vector<std::size_t> row_of(std::size_t i) {
  std::vector<std::size_t> row;
  for (std::size_t k = 0; k < 7 * i % 5; ++k) {
    row.push_back(100 * i + k);
  }
  return row;
}

void build(CompressedRows<std::size_t>& rows, std::size_t count, Workers& workers) {
  rows.build(count, workers, [](std::size_t i, std::vector<std::size_t>& out) {
    const auto row = row_of(i);
    out.insert(out.end(), row.begin(), row.end());
  });
}

void check(const CompressedRows<std::size_t>& rows, std::size_t count) {
  REQUIRE(rows.size() == count);
  std::size_t at = 0;
  for (std::size_t i = 0; i < count; ++i) {
    CAPTURE(i);
    const auto expected = row_of(i);
    REQUIRE(rows.begin_of(i) == at);
    const auto row = rows.row(i);
    REQUIRE(std::vector<std::size_t>(row.begin(), row.end()) == expected);
    for (std::size_t k = 0; k < expected.size(); ++k) {
      REQUIRE(rows[at + k] == expected[k]);
    }
    at += expected.size();
  }
  CHECK(rows.begin_of(count) == at);
  CHECK(rows.total() == at);
}

} // namespace

TEST_CASE("rows that nobody has built are none") {
  const CompressedRows<int> rows;
  CHECK(rows.size() == 0);
  CHECK(rows.total() == 0);
}

TEST_CASE("compressed rows hold what was appended to each row, for any number of rows and threads") {
  for (const unsigned threads : {1U, 3U}) {
    Workers workers{threads};
    CompressedRows<std::size_t> rows;
    // Up and down again, on both sides of the 512 rows that are one task.
    for (const std::size_t count : {3U, 511U, 512U, 513U, 2000U, 1024U, 1U, 0U, 600U}) {
      CAPTURE(threads);
      CAPTURE(count);
      build(rows, count, workers);
      check(rows, count);
    }
  }
}

TEST_CASE("rows without any item are still rows") {
  Workers workers{2};
  CompressedRows<int> rows;
  rows.build(1500, workers, [](std::size_t, std::vector<int>&) {});
  CHECK(rows.size() == 1500);
  CHECK(rows.total() == 0);
  CHECK(rows.row(1499).empty());
}
