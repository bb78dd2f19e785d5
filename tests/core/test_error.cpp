#include "scree/core/error.hpp"

#include <doctest/doctest.h>

#include <limits>

using namespace scree;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

} // namespace

TEST_CASE("a message joins words and numbers, with as many digits as tell two inputs apart") {
  CHECK(message("k = ", 1.75e7, " N/m, ", 3, ' ', std::string{"times"}) == "k = 17500000 N/m, 3 times");
  CHECK(message(0.1) == "0.1");
  CHECK(message(1.0 / 3.0) == "0.3333333333");
}

TEST_CASE("text of which nothing is known is shown in one line, and not without end") {
  CHECK(printable("a drag of 3 m") == "a drag of 3 m");
  CHECK(printable("a\nb\t\x7f\xff") == "a?b???");
  CHECK(printable("abcdef", 3) == "abc...");
  CHECK(printable("abc", 3) == "abc");
  CHECK(printable("").empty());
}

TEST_CASE("an error in a file says where") {
  const Error error = file_error("beds/desk.stl", 12, "vertex is not a number");
  CHECK(std::string{error.what()} == "beds/desk.stl:12: vertex is not a number");
}

TEST_CASE("a value in its range comes back, the ends included") {
  CHECK(require("x", 0.25, {0.0, 0.5}) == 0.25);
  CHECK(require("x", 0.0, {0.0, 0.5}) == 0.0);
  CHECK(require("x", 0.5, {0.0, 0.5}) == 0.5);
}

TEST_CASE("a value out of its range is refused with its name, value, range and unit") {
  CHECK_THROWS_WITH_AS(require("porosity", 1.2, {0.0, 1.0}), "porosity = 1.2 is outside [0, 1]", Error);
  CHECK_THROWS_WITH_AS(require("skin", -3e-4, {0.0, 0.1, "m"}), "skin = -0.0003 m is outside [0, 0.1] m",
                       Error);
  CHECK_THROWS_AS(require("x", not_a_number, {0.0, 1.0}), Error);
  CHECK_THROWS_AS(require("x", infinity, {0.0, std::numeric_limits<double>::max()}), Error);
}

TEST_CASE("a value that must be above zero is refused at zero, below, infinite and not a number") {
  CHECK(require_positive("mass", 1e-300) == 1e-300);
  CHECK_THROWS_WITH_AS(require_positive("mass", 0.0, "kg"), "mass = 0 kg must be a finite number above 0",
                       Error);
  CHECK_THROWS_WITH_AS(require_positive("scale", -2.0), "scale = -2 must be a finite number above 0", Error);
  CHECK_THROWS_AS(require_positive("mass", infinity), Error);
  CHECK_THROWS_AS(require_positive("mass", not_a_number), Error);
}
