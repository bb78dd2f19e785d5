#pragma once
/// \file
/// One data set, made, diagnosed and then compared with the truth.

#include "diagnose/diagnosing.hpp"
#include "hidden_effects/data_set.hpp"
#include "support/scratch_folder.hpp"

#include "scree/core/error.hpp"
#include "scree/io/read_text.hpp"
#include "scree/laboratory/campaign.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <filesystem>
#include <future>
#include <limits>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace hidden {

/// What a diagnosis says, most likely first; a pair of causes is one answer.
struct Verdict {
  scree::Finding finding;
  std::vector<std::vector<std::string>> named;

  [[nodiscard]] bool single() const {
    return finding == scree::Finding::cause || finding == scree::Finding::causes;
  }
};

/// What was hidden, from the file that was sealed until the verdict was there.
struct Truth {
  std::vector<std::string> effects, forms; ///< an empty form is that of the diagnosis
  std::vector<double> values;

  /// Whether all of `causes` are there, and one at least.
  [[nodiscard]] bool has(const std::vector<std::string>& causes) const {
    return !causes.empty() && std::all_of(causes.begin(), causes.end(), [&](const std::string& cause) {
      return std::find(effects.begin(), effects.end(), cause) != effects.end();
    });
  }
};

struct Trial {
  Kind kind;
  make_measured::Order set;
  Truth truth;
  diagnose::Diagnosed diagnosed;
  /// Of one effect: how often the diagnosis expects to take such data for each cause, and for nothing (last).
  std::vector<double> expected;

  /// Whether the first effect has the parameter that the diagnosis looks for.
  [[nodiscard]] bool same_form() const { return truth.forms.at(0).empty(); }
  /// Place of the first effect among the causes.
  [[nodiscard]] std::size_t cause() const {
    const auto& causes = diagnosed.space.causes();
    for (std::size_t c = 0; c < causes.size(); ++c) {
      if (causes[c].name == truth.effects.at(0)) {
        return c;
      }
    }
    throw scree::Error(scree::message("no cause ", truth.effects[0]));
  }
  /// The one hypothesis that is the first effect alone.
  [[nodiscard]] const scree::Ranked& hypothesis() const {
    const std::vector<std::size_t> wanted{cause()};
    return *std::find_if(diagnosed.diagnosis.ranking.begin(), diagnosed.diagnosis.ranking.end(),
                         [&](const scree::Ranked& r) { return r.causes == wanted; });
  }
};

inline std::vector<std::string> names_of(const scree::ModelSpace& space,
                                         const std::vector<std::size_t>& causes) {
  std::vector<std::string> out;
  for (const std::size_t c : causes) {
    out.push_back(space.causes()[c].name);
  }
  return out;
}

inline Verdict verdict_of(const scree::ModelSpace& space, const scree::Diagnosis& diagnosis) {
  Verdict out{diagnosis.finding, {}};
  for (const std::size_t place : diagnosis.named) {
    if (!diagnosis.ranking[place].causes.empty()) {
      out.named.push_back(names_of(space, diagnosis.ranking[place].causes));
    }
  }
  return out;
}

inline Truth read_truth(const std::filesystem::path& file) {
  const auto json = nlohmann::ordered_json::parse(scree::read_text(file, std::size_t{1} << 20U));
  Truth out;
  for (const auto& [name, effect] : json["effects"].items()) {
    out.effects.push_back(name);
    out.forms.push_back(effect.value("form", ""));
    out.values.push_back(effect["value"]);
  }
  return out;
}

/// \param runs folder that keeps all runs, of which all diagnoses share those of the model
inline Trial trial(const DataSet& set, const std::filesystem::path& runs, unsigned workers) {
  const scree::test::ScratchFolder folder;
  make_measured::measure(set.order, folder.path(), scree::Campaign{runs, workers}, false);
  diagnose::Request request{.measured = (folder / "measured").string(), .runs = 200, .first_runs = 200};
  request.setup.draws = 200;
  request.confirm = 0; // what is scored is what is known without
  diagnose::Diagnosed diagnosed = diagnose::Diagnosing{request, scree::Campaign{runs, workers}, false}();
  Trial out{set.kind, set.order, read_truth(folder / "truth.json"), std::move(diagnosed), {}};
  if (set.kind == Kind::one) {
    // Of another form, the size is what it amounts to.
    const double size = out.same_form() ? out.truth.values.at(0) : out.hypothesis().parameters.at(0).value;
    out.expected = out.diagnosed.diagnostician->taken_for(out.cause(), size);
  }
  out.diagnosed.diagnostician.reset(); // much, and not asked again
  return out;
}

/// On all processors; the first of them makes the runs of the model.
/// \param runs folder that keeps all runs
inline std::vector<Trial> trials(const std::vector<DataSet>& sets, const std::filesystem::path& runs) {
  std::vector<std::optional<Trial>> done(sets.size());
  done.at(0) = trial(sets[0], runs, 0);
  std::atomic<std::size_t> next{1};
  std::vector<std::future<void>> workers;
  for (unsigned w = 0; w < std::max(1U, std::thread::hardware_concurrency()); ++w) {
    workers.push_back(std::async(std::launch::async, [&] {
      for (std::size_t k = next++; k < sets.size(); k = next++) {
        done[k] = trial(sets[k], runs, 1);
      }
    }));
  }
  for (auto& worker : workers) {
    worker.get();
  }
  std::vector<Trial> out;
  for (auto& one : done) {
    out.push_back(std::move(*one));
  }
  return out;
}

} // namespace hidden
