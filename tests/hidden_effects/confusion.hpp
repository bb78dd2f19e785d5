#pragma once
/// \file
/// What was taken for what, beside what the diagnoses expected.

#include "hidden_effects/score.hpp"

#include "scree/io/csv.hpp"

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

namespace hidden {

/// One row for each truth and answer: how often, of how many, and how often it was expected.
/// Answers are causes, "several" that include the truth or do not, "unexplained" and "nothing".
inline void write_confusion(const std::vector<Trial>& trials, const std::filesystem::path& file) {
  struct Cell {
    double seen = 0.0, expected = 0.0;
  };
  std::map<std::string, std::map<std::string, Cell>> cells;
  std::map<std::string, double> sets;
  for (const Trial& t : trials) {
    std::string truth = t.kind == Kind::nothing ? "nothing" : t.kind == Kind::outside ? "no cause" : "";
    for (const std::string& effect : t.truth.effects) {
      truth += (truth.empty() ? "" : " and ") + effect;
    }
    const Verdict verdict = honest(t);
    std::string answer;
    if (verdict.single()) {
      for (const std::string& name : verdict.named.front()) {
        answer += (answer.empty() ? "" : " and ") + name;
      }
    } else if (verdict.finding == scree::Finding::indistinguishable) {
      bool there = false;
      for (const auto& causes : verdict.named) {
        there = there || t.truth.has(causes);
      }
      answer = there ? "several with the truth" : "several without the truth";
    } else {
      answer = verdict.finding == scree::Finding::unexplained ? "unexplained" : "nothing";
    }
    sets[truth] += 1.0;
    cells[truth][answer].seen += 1.0;
    for (std::size_t c = 0; c < t.expected.size(); ++c) {
      const auto& causes = t.diagnosed.space.causes();
      cells[truth][c < causes.size() ? causes[c].name : "nothing"].expected += t.expected[c];
    }
  }
  std::ofstream out{file};
  out << "truth,answer,seen,expected,sets\n";
  for (const auto& [truth, row] : cells) {
    for (const auto& [answer, cell] : row) {
      if (cell.seen > 0.0 || cell.expected > 0.005) {
        out << truth << ',' << answer << ',' << cell.seen << ',' << cell.expected << ',' << sets[truth]
            << '\n';
      }
    }
  }
  out.close();
  if (!out) {
    throw scree::Error(scree::message(file.string(), ": cannot be written"));
  }
}

} // namespace hidden
