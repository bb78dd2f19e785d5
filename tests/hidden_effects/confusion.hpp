#pragma once
/// \file
/// What was taken for what, beside what the diagnoses expected.

#include "hidden_effects/score.hpp"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

namespace hidden {

/// "a and b".
inline std::string joined(const std::vector<std::string>& names) {
  std::string out;
  for (const std::string& name : names) {
    out += (out.empty() ? "" : " and ") + name;
  }
  return out;
}

/// One row for each data set: what was hidden and what was found.
inline void write_trials(const std::vector<Trial>& trials, const std::filesystem::path& file) {
  std::ofstream out{file};
  out << "seed,hidden,form,value,low,high,verdict,named,p,adequacy,held_out_before,held_out_after,gain_low,"
         "gain_"
         "high,"
         "held_out_p,expected_right\n";
  for (const Trial& t : trials) {
    const Verdict verdict = honest(t);
    const scree::Diagnosis& d = t.diagnosed.diagnosis;
    std::string named, hidden = t.kind == Kind::outside ? t.set.misread : joined(t.truth.effects);
    for (const auto& causes : verdict.named) {
      named += (named.empty() ? "" : "; ") + joined(causes);
    }
    std::replace(hidden.begin(), hidden.end(), ',', ';');
    out << t.set.seed << ',' << hidden << ',';
    if (t.kind == Kind::one) {
      const auto& found = t.hypothesis().parameters.at(0);
      out << t.truth.forms[0] << ',' << t.truth.values[0] << ',' << found.low << ',' << found.high;
    } else {
      out << ",,,";
    }
    out << ',' << scree::name_of(verdict.finding) << ',' << named << ',' << d.alarm.p << ','
        << d.ranking.front().adequacy.value_or(1.0) << ',';
    if (d.held_out) {
      out << d.held_out->gain.before << ',' << d.held_out->gain.after << ',' << d.held_out->gain.low << ','
          << d.held_out->gain.high << ',' << d.held_out->p;
    } else {
      out << ",,,,";
    }
    out << ',';
    if (t.kind == Kind::one) {
      out << t.expected[t.cause()];
    }
    out << '\n';
  }
  out.close();
  if (!out) {
    throw scree::Error(scree::message(file.string(), ": cannot be written"));
  }
}

/// One row for each truth and answer: how often, of how many, and how often it was expected.
/// Answers are causes, "several" that include the truth or do not, "unexplained" and "nothing".
inline void write_confusion(const std::vector<Trial>& trials, const std::filesystem::path& file) {
  struct Cell {
    double seen = 0.0, expected = 0.0;
  };
  std::map<std::string, std::map<std::string, Cell>> cells;
  std::map<std::string, double> sets;
  for (const Trial& t : trials) {
    const std::string truth = t.kind == Kind::nothing   ? "nothing"
                              : t.kind == Kind::outside ? "no cause"
                                                        : joined(t.truth.effects);
    const Verdict verdict = honest(t);
    std::string answer;
    if (verdict.single()) {
      answer = joined(verdict.named.front());
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
