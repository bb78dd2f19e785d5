/// \file
/// The start of every test program.

#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include "support/environment.hpp"

int main(int argc, char** argv) {
  doctest::Context context(argc, argv);
  const int failed = context.run();
  // CTest counts 77 as "skipped" (cmake/AddCase.cmake). A failure comes first, so that a skip never hides it.
  constexpr int skipped = 77;
  return failed == 0 && scree::test::has_skipped() ? skipped : failed;
}
