#pragma once
/// \file
/// What a diagnosis says, for people and for programs.

#include "diagnose/diagnosing.hpp"
#include "diagnose/foresight.hpp"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace diagnose {

/// All that a report is made of.
struct Case {
  const Diagnosed& diagnosed;
  double seconds; ///< that it took
  /// What rivals say of experiments that were not done yet, where several were named.
  std::vector<ForeseenExperiment> foreseen{};
};

/// The verdict in one sentence.
std::string sentence(const Case& c);
/// The type to write for the model with the causes named, and their parameters; empty where none is.
std::vector<std::string> model_to_write(const Case& c);
/// What was gained on held-out data by runs of both models there; empty where none were made.
std::string gain_of_runs(const Case& c);
/// What to measure next; empty where nothing is left open.
std::string next_experiment(const Case& c);

nlohmann::ordered_json verdict(const Case& c);
/// One HTML page that needs nothing beside it.
std::string page(const Case& c);

} // namespace diagnose
