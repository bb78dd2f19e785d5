#pragma once
/// \file
/// An experiment as programs see it: options, observables, a run.

#include "scree/core/error.hpp"
#include "scree/io/csv.hpp"
#include "scree/laboratory/rock_model.hpp"
#include "scree/laboratory/rock_parameters.hpp"
#include "support/extended_simulation.hpp"
#include "support/options.hpp"
#include "support/plot.hpp"
#include "support/workbench.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace scree::examples {

/// What one run is done with.
struct Conditions {
  RockModel model;
  std::uint64_t seed = 1;
  unsigned threads = 1; ///< 0: one for each processor
  double step_safety = 0.8;
  double limit = 1e3; ///< s of simulated time, beyond which a run counts as failed
};

/// A number that comes of an experiment.
struct Observable {
  std::string name; ///< with its unit, as in the head of a table: modulus_Pa
  bool logarithmic = true;
};

/// The curve that a run writes beside its numbers.
struct CurveFile {
  std::string file;                    ///< CSV
  std::string x, y;                    ///< its columns
  std::string title, x_label, y_label; ///< of the plot, with units
};

/// One of the kinds of experiment, with the numbers of its own setup.
class Experiment {
public:
  Experiment() = default;
  Experiment(const Experiment&) = delete;
  Experiment& operator=(const Experiment&) = delete;
  virtual ~Experiment() = default;

  /// Adds what is particular to this experiment; the options must not outlive it.
  virtual void bind(Options& options) = 0;

  /// What a run gives, in this order.
  [[nodiscard]] virtual std::vector<Observable> observables() const = 0;
  [[nodiscard]] virtual CurveFile curve() const = 0;

  /// One run. Writes the curve into `folder` unless that is empty. May be called from several threads.
  /// \throws Error where the run fails.
  [[nodiscard]] virtual std::vector<double> observe(const Conditions& conditions,
                                                    const std::filesystem::path& folder) const = 0;

  /// The observables of a curve that was measured, in their order.
  /// \throws Error for a kind that takes no curves, or where the curve says nothing.
  [[nodiscard]] virtual std::vector<double> reduce(const CsvTable& curve) const {
    throw Error(message(curve.file.string(), ": this kind of experiment takes tables of observables only"));
  }

  /// One run with all that is to be seen of it, after `Workbench::begin`.
  /// \throws Error for a kind that has a program of another form.
  virtual void show(Workbench& /*bench*/) const {
    throw Error("this kind of experiment is shown by a program of another form");
  }
};

/// Of the kinds "immersion", "bulk_density", "oedometer", "angle_of_repose", "drop_test",
/// "tilt_test" and "drag".
/// \param desk whether the defaults are those of desk fidelity, or the paper's size
/// \throws Error for another kind.
std::unique_ptr<Experiment> make_experiment(const std::string& kind, bool desk);
std::vector<std::string> experiment_kinds();
/// Those of them whose results the parameter can change.
std::vector<std::string> kinds_that_show(const RockParameter& parameter);

namespace detail {

std::unique_ptr<Experiment> make_immersion(bool desk);
std::unique_ptr<Experiment> make_bulk_density(bool desk);
std::unique_ptr<Experiment> make_oedometer(bool desk);
std::unique_ptr<Experiment> make_angle_of_repose(bool desk);
std::unique_ptr<Experiment> make_drop_test(bool desk);
std::unique_ptr<Experiment> make_tilt_test(bool desk);
std::unique_ptr<Experiment> make_drag_test(bool desk);

/// The setup with the rock and so on of one run.
template <class Setup>
Setup prepared(Setup setup, const Conditions& conditions) {
  setup.sample = conditions.model.sample;
  setup.seed = conditions.seed;
  if constexpr (requires { setup.fill.packing_friction; }) {
    setup.fill.packing_friction *= conditions.model.packing_friction;
  }
  if constexpr (requires { setup.threads; }) {
    setup.threads = conditions.threads;
  }
  return setup;
}

/// Calls `run` with the physics that the conditions ask for.
template <class Run>
auto with_physics_of(const Conditions& conditions, const Run& run) {
  return with_physics(
      conditions.model,
      {.step_safety = conditions.step_safety, .local_damping = conditions.model.local_damping}, run);
}

inline Conditions conditions_of(const Workbench& bench) {
  return {.model = {bench.sample()},
          .seed = bench.seed(),
          .threads = bench.threads(),
          .step_safety = bench.step_safety()};
}

/// Ends a run that takes longer than it may.
inline auto limited(const Conditions& conditions) {
  return [limit = conditions.limit](const auto& simulation, const Stage& stage) {
    if (simulation.time() > limit) {
      throw Error(message("the run is longer than its limit of ", limit, " s, while ", stage.name));
    }
  };
}

} // namespace detail

} // namespace scree::examples
