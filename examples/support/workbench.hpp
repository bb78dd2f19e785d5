#pragma once
/// \file
/// What the programs of the laboratory have in common: options, folder, progress, summary and pictures.

#include "scree/io/render.hpp"
#include "scree/laboratory/rock_sample.hpp"
#include "scree/laboratory/stage.hpp"
#include "scree/measure/watchdog.hpp"
#include "support/default_simulation.hpp"
#include "support/options.hpp"
#include "support/plot.hpp"
#include "support/progress.hpp"
#include "support/rock_options.hpp"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace scree::examples {

/// One run of one experiment.
class Workbench {
public:
  Workbench(std::string name, std::string brief, int argc, const char* const* argv);

  [[nodiscard]] bool desk() const { return fidelity_ == "desk"; }
  /// To add the options of the experiment to, before `begin`.
  [[nodiscard]] Options& options() { return options_; }

  /// Reads command line and TOML file, and makes the folder with input.toml and summary.json.
  /// \throws Error, HelpWanted.
  void begin();

  [[nodiscard]] RockSample sample() const { return rock_.sample(rig_); }
  [[nodiscard]] std::uint64_t seed() const { return seed_; }
  [[nodiscard]] unsigned threads() const { return static_cast<unsigned>(threads_); }
  [[nodiscard]] double step_safety() const { return step_safety_; }
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  [[nodiscard]] nlohmann::ordered_json& summary() { return summary_; }
  [[nodiscard]] std::string title(const std::string& of) const;

  /// Runs an experiment: shows the progress, and ends it when it goes wrong, with trouble.vtp and
  /// trouble.checkpoint of that moment. Returns its result.
  /// \throws Error as the experiment does.
  template <class Test>
  decltype(auto) run(Test& test) {
    try {
      return test.run([this](const auto& simulation, const Stage& stage) { watch(simulation, stage); });
    } catch (const Trouble&) {
      show_trouble(test.simulation());
      throw;
    }
  }

  /// The same, and ends it where a grain leaves the domain, too.
  template <class Test>
  decltype(auto) run(Test& test, const Eigen::AlignedBox3d& domain) {
    bounds_.domain = domain;
    watchdog_.emplace(bounds_);
    return run(test);
  }

  /// Draws NAME.svg and NAME.png from the tables; says what went wrong, if anything did.
  void plot(const std::string& name, const std::string& title, const std::vector<Panel>& panels);

  /// Draws the grains from aside, those in front of the plane y = 0 cut away where `cut` is set.
  /// `add(renderer)` draws what else is there.
  void view(const std::string& name, const Simulation<>& simulation, const Eigen::AlignedBox3d& scene,
            bool cut, const std::string& caption, const std::function<void(Renderer&)>& add);

  /// Closes summary.json with times and the state's hash.
  void finish(const Simulation<>& simulation);

  /// Notes in summary.json why there are no results.
  void fail(const std::string& reason);

private:
  void watch(const Simulation<>& simulation, const Stage& stage);
  void show_trouble(const Simulation<>& simulation);
  void save() const;

  std::string name_;
  int argc_;
  const char* const* argv_;
  Options options_;
  std::string fidelity_, out_;
  std::uint64_t seed_ = 1, threads_ = 0;
  double step_safety_ = 0.8;
  RockOptions rock_;
  Material rig_;
  std::filesystem::path folder_;
  nlohmann::ordered_json summary_;
  Progress progress_;
  double grain_steps_ = 0.0;
  SaneBounds bounds_{.overlap = 1.0}; // the oedometer of desk rock comes to between 0.3 and 0.4
  std::optional<Watchdog> watchdog_{};
};

/// The main() of a program: `work(Workbench&)` adds options, begins, runs and finishes. Returns 0, or 2 after
/// an error, which it prints and notes.
int run_experiment(const std::string& name, const std::string& brief, int argc, const char* const* argv,
                   const std::function<void(Workbench&)>& work);

} // namespace scree::examples
