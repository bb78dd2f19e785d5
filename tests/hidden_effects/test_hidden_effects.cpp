#include "hidden_effects/confusion.hpp"
#include "hidden_effects/mutants.hpp"
#include "hidden_effects/score.hpp"

#include <doctest/doctest.h>

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>

using namespace hidden;

namespace {

/// The scores, and beside them which mutants get away; the matrix of confusion goes to a file.
void judge_all(std::uint64_t seed, std::size_t times, const std::string& name) {
  const std::vector<Trial> all = trials(data_sets(seed, times));
  const std::filesystem::path folder = std::filesystem::current_path() / "hidden_effects";
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

// Over 20 minutes of one core; `long` until it is cheap enough for every change.
TEST_CASE(
    "long: what was hidden in simulated experiments is found, and broken diagnoses are not let through") {
  judge_all(1, 1, "once");
}

TEST_CASE("long: ten times as much that was hidden") {
  judge_all(2, 10, "nightly");
}
