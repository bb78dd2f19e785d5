/// \file
/// Every parameter of every program refuses what is out of its range.

#include "drag/parameters.hpp"
#include "laboratory/experiment.hpp"
#include "support/options.hpp"
#include "support/rock_options.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <variant>
#include <vector>

using namespace scree;
using examples::Options;
using Entry = examples::detail::OptionsEntry;

namespace {

/// What is said to this text, and that the value stays as it was.
std::string refusal(Entry& entry, const std::string& given) {
  const std::string before = entry.text();
  std::string said = "accepted";
  try {
    entry.set_text(given, "");
  } catch (const Error& error) {
    said = error.what();
  }
  CHECK(entry.text() == before);
  CHECK(said.find('\n') == std::string::npos);
  return said;
}

/// \param expected all of these must be in what is said to `given`
void check_refused(Entry& entry, const std::string& given, const std::vector<std::string>& expected) {
  const std::string said = refusal(entry, given);
  CAPTURE(given);
  CAPTURE(said);
  for (const std::string& part : expected) {
    const bool there = said.find(part) != std::string::npos;
    CAPTURE(part);
    CHECK(there);
  }
}

void check_number(Entry& entry, const std::string& after) {
  for (const double beyond :
       {std::nextafter(entry.range.least, -HUGE_VAL) - 1e-6 * std::abs(entry.range.least),
        std::nextafter(entry.range.most, HUGE_VAL) + 1e-6 * std::abs(entry.range.most)}) {
    if (entry.value.index() == 1 && beyond < 0.0) {
      check_refused(entry, "-1", {entry.name + after, "-1", "0 or above"});
    } else {
      const std::string given = entry.value.index() == 1
                                    ? std::to_string(static_cast<std::int64_t>(std::round(beyond)))
                                    : number_text(beyond);
      // Rounding a whole number may bring it back to the bound.
      if (entry.value.index() != 1 || std::stod(given) > entry.range.most) {
        check_refused(entry, given,
                      {entry.name + after, message(entry.range.least), message(entry.range.most),
                       std::string{entry.range.unit}});
      }
    }
  }
  for (const char* none : {"nan", "inf", "-inf", "", "1x", "one"}) {
    check_refused(entry, none, {entry.name, none});
  }
}

void check_entry(Entry& entry) {
  CAPTURE(entry.name);
  switch (entry.value.index()) {
  case 0:
  case 1:
    check_number(entry, " = ");
    break;
  case 2:
    check_refused(entry, "maybe", {entry.name + " = maybe", "true or false"});
    break;
  case 4: {
    const auto& list = *std::get<std::vector<double>*>(entry.value);
    std::string given = number_text(entry.range.least - 1.0 - std::abs(entry.range.least));
    for (std::size_t k = 1; k < list.size(); ++k) {
      given += "," + number_text(list[k]);
    }
    check_refused(entry, given, {entry.name + "[0]", message(entry.range.least), message(entry.range.most)});
    check_refused(entry, "1,x", {entry.name, "1,x"});
    check_refused(entry, "nan", {entry.name});
    break;
  }
  default:
    if (!entry.choices.empty()) {
      check_refused(entry, "other", {entry.name + " = \"other\"", entry.choices.front()});
    }
    check_refused(entry, "\xff", {entry.name});
  }
}

/// \return how many parameters there are
std::size_t check_all(Options& options) {
  for (Entry& entry : options.entries()) {
    check_entry(entry);
  }
  return options.entries().size();
}

} // namespace

TEST_CASE("every parameter of every experiment and of its rock refuses what is out of its range") {
  for (const bool desk : {true, false}) {
    for (const std::string& kind : examples::experiment_kinds()) {
      CAPTURE(kind);
      const auto experiment = examples::make_experiment(kind, desk);
      Options options{kind, ""};
      experiment->bind(options);
      CHECK(check_all(options) > 0);
    }
    examples::RockOptions rock{desk};
    Material rig = rock.rig();
    Options options{"rock", ""};
    bind(options, rock, rig);
    CHECK(check_all(options) > 10);
  }
}

TEST_CASE("every parameter of the drag refuses what is out of its range") {
  for (const char* fidelity : {"desk", "lab"}) {
    drag::Parameters parameters = drag::defaults(fidelity);
    Options options{"drag", ""};
    drag::bind(options, parameters);
    CHECK(check_all(options) > 60);
  }
}
