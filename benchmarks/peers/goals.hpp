#pragma once
/// \file
/// What scree wants to reach, and what of it the rows show.

#include "rows.hpp"

#include <functional>
#include <string>
#include <vector>

namespace scree::benchmarks {

/// One question to the rows.
struct Goal {
  std::string question;
  double least = 0.0, most = 0.0; ///< what is wanted; 0: no bound
  double measured = 0.0;          ///< 0: not measured
  [[nodiscard]] bool met() const { return measured >= least && (most == 0.0 || measured <= most); }
};

inline std::vector<Goal> goals_of(const Rows& rows) {
  std::vector<Goal> goals;
  const auto against_peer = [&](const char* question, const char* work, const char* real) {
    const Row* row = row_of(rows, work, "scree native", real);
    goals.push_back({question, goal_of(work, real), 0.0, row != nullptr ? ratio_of(*row, rows).median : 0.0});
  };
  const auto quotient = [&](const char* question, const Row* a, const Row* b, double least, double most,
                            const std::function<double(const Row&)>& value) {
    goals.push_back({question, least, most, a != nullptr && b != nullptr ? value(*a) / value(*b) : 0.0});
  };
  const auto ours = [&](const char* work, int threads = 1) {
    return row_of(rows, work, "scree native", "double", threads);
  };
  const auto rate = [](const Row& row) { return row.rate(row.median()); };
  const auto cost = [](const Row& row) { return row.median() / (row.steps * row.grains); };
  const auto memory = [](const Row& row) { return row.megabytes; };

  against_peer("settled bed, 20,000 spheres, over the fastest peer", "bed", "double");
  against_peer("settled bed, 100,000 spheres, over the fastest peer", "bed100k", "double");
  against_peer("settled bed, 20,000 spheres, float, over the fastest peer", "bed", "float");
  against_peer("settled bed, 100,000 spheres, float, over the fastest peer", "bed100k", "float");
  quotient("2 threads over 1, 20,000 spheres", ours("bed", 2), ours("bed"), 1.85, 0.0, rate);
  quotient("2 threads over 1, 100,000 spheres", ours("bed100k", 2), ours("bed100k"), 1.85, 0.0, rate);
  against_peer("flowing bed, over the fastest peer", "flow", "double");
  against_peer("5,000 clumps of 4 spheres, over the fastest peer", "clumps", "double");
  quotient("time with a moving bucket of 520 triangles over the bed alone", ours("bucket 520"),
           ours("no bucket"), 0.0, 1.05, cost);
  quotient("time with a moving bucket of 5,000 triangles over the bed alone", ours("bucket 5000"),
           ours("no bucket"), 0.0, 1.15, cost);
  quotient("cost of a grain among 1,000,000 over that among 5,000", ours("scale 1000k"), ours("scale 5k"),
           0.0, 1.15, cost);
  quotient("memory over LAMMPS's, 100,000 spheres", ours("bed100k"), row_of(rows, "bed100k", "LAMMPS"), 0.0,
           1.0, memory);
  return goals;
}

inline void write_goals(const Rows& rows, const std::filesystem::path& markdown,
                        const std::filesystem::path& csv) {
  std::ofstream md = opened_for_writing(markdown), out = opened_for_writing(csv);
  md.precision(3);
  out.precision(4);
  md << "| question | goal | measured | met |\n|---|---|---|---|\n";
  out << "question,at_least,at_most,measured,met\n";
  for (const Goal& goal : goals_of(rows)) {
    const bool known = goal.measured > 0.0;
    const char* met = !known ? "not measured" : goal.met() ? "yes" : "no";
    md << "| " << goal.question << " | "
       << (goal.most > 0.0 ? "at most " + or_nothing(goal.most) : "at least " + or_nothing(goal.least))
       << " | " << or_nothing(goal.measured, 3) << " | " << met << " |\n";
    out << '"' << goal.question << "\"," << or_nothing(goal.least) << ',' << or_nothing(goal.most) << ','
        << or_nothing(goal.measured) << ',' << met << '\n';
  }
  close(md, markdown);
  close(out, csv);
}

} // namespace scree::benchmarks
