#include "scree/laboratory/drag_pieces.hpp"
#include "support/relative_error.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

using namespace scree;

namespace {

/// Rows at these places, of a drag on which all goes straight: force 10 x, pitch 1 - x, depth x, mass 2 x,
/// lag x / 2.
std::vector<DragRow> straight(const std::vector<double>& places) {
  std::vector<DragRow> rows;
  for (const double x : places) {
    rows.push_back(
        {.drag = x, .force = 10.0 * x, .pitch = 1.0 - x, .depth = x, .mass = 2.0 * x, .lag = 0.5 * x});
  }
  return rows;
}

} // namespace

TEST_CASE("means of a drag are by distance, however often and wherever it was read") {
  const auto rows = straight({0.0, 0.01, 0.013, 0.3, 0.31, 0.95, 1.04});
  const DragPieces pieces = pieces_of(rows, 1.0, 4);
  for (std::size_t k = 0; k < 4; ++k) {
    const double middle = (static_cast<double>(k) + 0.5) / 4.0;
    CHECK(pieces.force[k] == test::about(10.0 * middle));
    CHECK(pieces.pitch[k] == test::about(1.0 - middle));
    CHECK(pieces.depth[k] == test::about(middle));
    CHECK(pieces.mass[k] == test::about(2.0 * middle));
    CHECK(pieces.lag[k] == test::about(0.5 * middle));
  }
}

TEST_CASE("a bucket that slips back for a while is not counted twice there") {
  CHECK(pieces_of(straight({0.0, 0.4, 0.2, 0.6, 0.1, 1.0}), 1.0, 2).force[0] == test::about(2.5));
  // Before the place that it started from there is nothing.
  CHECK(pieces_of(straight({0.0, -0.2, 0.5, 1.0}), 1.0, 2).force[0] == test::about(2.5));
  // On the way back the force is another: what is between is worth as much as the way that it was read on.
  const std::vector<DragRow> loop{{.drag = 0.0, .force = 1.0}, {.drag = 0.8, .force = 1.0},
                                  {.drag = 0.8, .force = 3.0}, {.drag = 0.4, .force = 3.0},
                                  {.drag = 0.4, .force = 1.0}, {.drag = 1.0, .force = 1.0}};
  CHECK(pieces_of(loop, 1.0, 1).force[0] == test::about(1.0 - 0.4 * 3.0 + 0.4 * 1.0));
}

TEST_CASE("a piece that the record does not reach has no mean") {
  const auto rows = straight({0.0, 0.2, 0.6, 0.9});
  const DragPieces pieces = pieces_of(rows, 1.0, 4);
  CHECK(std::isfinite(pieces.force[2]));
  CHECK(std::isnan(pieces.force[3]));
  CHECK(std::isnan(pieces.roughness));
  CHECK(std::isnan(pieces_of(straight({0.1, 1.0}), 1.0, 4).force[0]));
  CHECK(std::isnan(pieces_of({}, 1.0, 1).force[0]));
}

TEST_CASE("roughness is what straight lines leave of the force, over its mean") {
  // A sine about a straight line, many times over in each piece: 1 / sqrt 2 of its amplitude is left.
  constexpr double amplitude = 3.0;
  std::vector<DragRow> rows;
  constexpr int count = 4000;
  for (int k = 0; k <= count; ++k) {
    const double x = static_cast<double>(k) / count;
    rows.push_back(
        {.drag = x, .force = 20.0 + 10.0 * x + amplitude * std::sin(100.0 * 2.0 * std::numbers::pi * x)});
  }
  // The mean force is 25; the least lines follow the sines by a little.
  CHECK(pieces_of(rows, 1.0, 2).roughness == test::about(amplitude / std::sqrt(2.0) / 25.0, 2e-3));

  // Rows in pairs above and below: exactly, with two degrees of freedom less for each piece.
  std::vector<DragRow> few;
  for (int k = 0; k < 8; ++k) {
    few.push_back({.drag = k / 8.0, .force = 5.0 + (k % 4 == 1 || k % 4 == 2 ? 1.0 : -1.0)});
  }
  few.push_back({.drag = 1.0, .force = 5.0});
  // -1, 1, 1, -1 has no slope: 4 squares of 1 in each of two pieces, with 2 degrees of freedom each.
  const DragPieces pieces = pieces_of(few, 1.0, 2);
  CHECK(pieces.roughness == test::about(std::sqrt(8.0 / 4.0) / (0.5 * (pieces.force[0] + pieces.force[1]))));
}

TEST_CASE("too few rows have no roughness, and pieces that make no sense are refused") {
  CHECK(std::isnan(pieces_of(straight({0.0, 1.0}), 1.0, 1).roughness));
  CHECK_THROWS_WITH_AS((void)pieces_of(straight({0.0, 1.0}), 0.0, 1),
                       doctest::Contains("drag distance = 0 m"), Error);
  CHECK_THROWS_WITH_AS((void)pieces_of(straight({0.0, 1.0}), 1.0, 0),
                       doctest::Contains("pieces of the drag = 0"), Error);
}
