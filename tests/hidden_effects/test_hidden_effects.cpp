#include "hidden_effects/confusion.hpp"
#include "hidden_effects/mutants.hpp"
#include "hidden_effects/score.hpp"

#include "scree/core/error.hpp"
#include "scree/io/number_text.hpp"
#include "support/scratch_folder.hpp"

#include <doctest/doctest.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

using namespace hidden;

namespace {

/// A variable of the environment, or `otherwise`.
std::string told(const char* variable, const char* otherwise) {
  const char* value = std::getenv(variable);
  return value == nullptr ? otherwise : value;
}

/// How much more than in the quick suite is hidden.
std::size_t factor() {
  const std::string text = told("SCREE_HIDDEN_EFFECTS_TIMES", "10");
  const double times = scree::parse_number(text).value_or(0.0);
  return static_cast<std::size_t>(scree::require("SCREE_HIDDEN_EFFECTS_TIMES", times, {1.0, 1000.0}));
}

/// The scores, and beside them which mutants get away; the matrix of confusion goes to a file.
void judge_all(std::uint64_t seed, std::size_t times, const std::string& name) {
  const scree::test::ScratchFolder scratch;
  const std::filesystem::path kept{told("SCREE_HIDDEN_EFFECTS_KEPT", "")};
  const std::vector<Trial> all = trials(data_sets(seed, times), kept.empty() ? scratch.path() : kept);
  const std::filesystem::path folder = std::filesystem::current_path() / "hidden_effects_tables";
  std::filesystem::create_directories(folder);
  write_confusion(all, folder / (name + "_confusion.csv"));
  write_trials(all, folder / (name + "_trials.csv"));

  const auto scores = score(all, honest);
  std::printf("%s\n", text_of(scores).c_str());
  for (const Requirement& requirement : scores) {
    CAPTURE(requirement.text());
    CHECK(requirement.met());
  }
  struct Mutant {
    const char* name;
    Judge judge;
  };
  for (const Mutant& mutant : {Mutant{"constant answer", constant_answer},
                               Mutant{"best fit without penalty", best_fit_without_penalty},
                               Mutant{"chi-squared threshold", chi_squared_threshold},
                               Mutant{"zeroed signature", zeroed_signature}}) {
    const auto of_mutant = score(all, mutant.judge);
    std::printf("%s\n%s\n", mutant.name, text_of(of_mutant).c_str());
    CAPTURE(mutant.name);
    CHECK_FALSE(all_met(of_mutant));
  }
}

} // namespace

TEST_CASE("long: what was hidden in simulated experiments is found, and broken diagnoses are not let "
          "through") {
  judge_all(1, 1, "once");
}

TEST_CASE("long: ten times as much that was hidden") {
  judge_all(2, factor(), "nightly");
}
