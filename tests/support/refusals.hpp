#pragma once
/// \file
/// Whether a setup refuses what is out of its range, for tables of its fields.

#include "scree/core/error.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <initializer_list>
#include <limits>
#include <string>

namespace scree::test {

inline constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN(), infinite = HUGE_VAL;

template <class Setup>
std::string complaint(const Setup& setup) {
  try {
    setup.check();
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

/// \param name of the field as the message says it
/// \param field of a Setup, a reference of which it returns
/// \param values each of which is to be refused, in one line with the name and the value
template <class Setup, class Field, class Value>
void check_refusals(const char* name, Field field, std::initializer_list<Value> values) {
  CAPTURE(name);
  REQUIRE(complaint(Setup{}) == "accepted");
  for (const Value value : values) {
    Setup setup;
    field(setup) = value;
    const std::string said = complaint(setup);
    CAPTURE(said);
    CAPTURE(value);
    const bool named = said.find(message(name, " = ", value)) != std::string::npos;
    CHECK(named);
    CHECK(said.find('\n') == std::string::npos);
  }
}

} // namespace scree::test

/// A line of a table: type, field, its name in messages, values that are refused.
#define SCREE_REFUSES(Setup, field, name, ...)                                                               \
  scree::test::check_refusals<Setup>(name, [](Setup & setup) -> auto& { return setup.field; }, {__VA_ARGS__})
