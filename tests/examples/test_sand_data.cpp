#include "laboratory/sand_data.hpp"
#include "support/environment.hpp"
#include "support/scratch_folder.hpp"

#include "scree/core/error.hpp"
#include "scree/io/atomic_file.hpp"

#include <doctest/doctest.h>

#include <filesystem>
#include <string>

using namespace scree;

namespace sand_data_tests {

namespace {

const std::string head = "sigma1 eps1 Void ratio\n[kPa] [%] [-]\n\n";

std::string complaint(const std::string& text) {
  const test::ScratchFolder scratch;
  std::filesystem::create_directories(scratch / "OE");
  write_atomically(scratch / "OE" / "OE1.dat", text);
  try {
    (void)sand::read_sand_test(scratch.path(), 1);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

} // namespace

TEST_CASE("a test on sand is read as loading, unloading and loading again") {
  const test::ScratchFolder scratch;
  std::filesystem::create_directories(scratch / "OE");
  write_atomically(scratch / "OE" / "OE4.dat",
                   head + "0 0 0.9\n10 1 0.88\n20 1.5 0.87\n20 1.5 0.87\n10 1.4 0.872\n0 -1.2 0.876\n"
                          "0 1.2 0.876\n10 1.35 0.873\n20 1.7 0.866\n");
  const auto test = sand::read_sand_test(scratch.path(), 4);
  CHECK(test.void_ratio == 0.9);
  CHECK(test.highest == 2e4);
  CHECK(test.loading.stress == std::vector<double>{0.0, 1e4, 2e4});
  CHECK(test.unloading.stress == std::vector<double>{2e4, 1e4, 0.0});
  CHECK(test.unloading.strain.back() == doctest::Approx(0.012)); // the sign that is wrong at the source
  CHECK(test.reloading.strain.back() == doctest::Approx(0.017));
}

TEST_CASE("a test on sand that is none is refused") {
  CHECK(complaint(head).find("there are no rows") != std::string::npos);
  CHECK(complaint(head + "0 0 0.9\n10 x 0.88\n").find("OE1.dat:5: stress, strain") != std::string::npos);
  CHECK(complaint(head + "0 0 0.9\n10 1 0.88\n20 2 0.8\n").find("no loading, unloading") !=
        std::string::npos);
}

TEST_CASE("the Karlsruhe tests have the moduli between 114 and 407 kPa that their tables give") {
  const auto file = test::reference_file("kfsdb_sand/OE/OE1.dat");
  if (!file) {
    return;
  }
  const auto test = sand::read_sand_test(file->parent_path().parent_path(), 1);
  CHECK(test.void_ratio == doctest::Approx(1.03858));
  const double low = 114'479.0, high = 407'089.0;
  CHECK(secant_modulus(test.loading, low, high) == doctest::Approx(30.3e6).epsilon(0.002));
  CHECK(secant_modulus(test.unloading, low, high) == doctest::Approx(191.2e6).epsilon(0.002));
  CHECK(secant_modulus(test.reloading, low, high) == doctest::Approx(61.2e6).epsilon(0.002));
}

} // namespace sand_data_tests
