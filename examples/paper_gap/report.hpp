#pragma once
/// \file
/// Tables, curves, summary and page of the paper's gap.

#include "findings.hpp"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace paper_gap {

/// All that a report is made of.
struct Report {
  const Base& base;
  const Findings& findings;
  std::span<const Done> runs;
  std::string fidelity;
  double dense_density; ///< of the particles of dense beds over those of loose ones
  std::size_t planned;  ///< runs in all, done or not
};

/// runs.csv, effects.csv, curves.csv. \returns what could not be drawn; empty where all was.
std::string write_tables(const Report& report, const std::filesystem::path& folder);
nlohmann::ordered_json summary(const Report& report);
/// One page that needs nothing beside it. \param figure SVG, may be empty
std::string page(const Report& report, const std::string& figure);
/// What the runs say, sentence by sentence.
std::vector<std::string> sentences(const Report& report);
/// What the published figures leave open, in numbers where there are some.
std::vector<std::string> undecided(const Report& report);

} // namespace paper_gap
