#include "laboratory/sand_data.hpp"

#include "scree/core/error.hpp"
#include "scree/io/number_text.hpp"
#include "scree/io/read_text.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <sstream>
#include <string>

namespace sand {

using namespace scree;

SandTest read_sand_test(const std::filesystem::path& folder, int number) {
  const auto file = folder / "OE" / message("OE", number, ".dat");
  std::istringstream lines{read_text(file, std::size_t{1} << 20U)};
  StressStrain all;
  SandTest test{.number = number};
  std::string line;
  std::size_t at = 0;
  while (std::getline(lines, line)) {
    ++at;
    std::istringstream fields{line};
    std::string stress, strain, void_ratio;
    if (!(fields >> stress >> strain >> void_ratio)) {
      continue; // blank, or the lines of names and units
    }
    const auto s = parse_number(stress), e = parse_number(strain), v = parse_number(void_ratio);
    if (!s && all.stress.empty()) {
      continue;
    }
    if (!s || !e || !v) {
      throw file_error(file, at, "stress, strain and void ratio must be numbers");
    }
    test.void_ratio = all.stress.empty() ? *v : test.void_ratio;
    all.stress.push_back(1e3 * *s);
    all.strain.push_back(0.01 * (*s == 0.0 ? std::abs(*e) : *e));
  }
  if (all.stress.empty()) {
    throw file_error(file, at, "there are no rows");
  }
  test.highest = *std::max_element(all.stress.begin(), all.stress.end());
  StressStrain* branch = &test.loading;
  for (std::size_t k = 0; k < all.stress.size(); ++k) {
    // The highest and the lowest stress are written twice, once for each branch.
    if (k > 0 && branch == &test.loading && all.stress[k - 1] == test.highest) {
      branch = &test.unloading;
    } else if (k > 0 && branch == &test.unloading && all.stress[k] >= all.stress[k - 1] &&
               branch->stress.size() > 1) {
      branch = &test.reloading;
    }
    branch->stress.push_back(all.stress[k]);
    branch->strain.push_back(all.strain[k]);
  }
  if (test.loading.stress.size() < 3 || test.unloading.stress.size() < 3 ||
      test.reloading.stress.size() < 3) {
    throw Error(message(file.string(), ": this is no loading, unloading and loading again"));
  }
  return test;
}

} // namespace sand
