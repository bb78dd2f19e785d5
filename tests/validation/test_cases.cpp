/// \file
/// What holds for the list of cases as a whole.

#include "validation/cases.hpp"

#include "support/environment.hpp"

#include "scree/core/error.hpp"
#include "scree/io/read_text.hpp"

#include <doctest/doctest.h>

#include <filesystem>
#include <set>
#include <string>

TEST_CASE("every case of the validation is a test, under a name of its own") {
  std::string tests;
  for (const auto& entry :
       std::filesystem::directory_iterator{scree::test::source_directory() / "tests/validation"}) {
    tests += scree::read_text(entry.path(), entry.file_size());
  }
  std::set<std::string> names;
  for (const validation::Case& c : validation::all_cases()) {
    CAPTURE(c.name);
    CHECK(tests.find("check_case(\"" + c.name + "\")") != std::string::npos);
    CHECK(names.insert(c.name).second);
    CHECK(&validation::find_case(c.name) == &c);
  }
  CHECK_THROWS_WITH_AS((void)validation::find_case("nonesuch"), "no case is named 'nonesuch'", scree::Error);
}
