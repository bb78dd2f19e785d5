#pragma once
/// \file
/// A drag as an experiment among others: a rock, a rig, a run, and its curves.

#include "scree/laboratory/drag_pieces.hpp"
#include "scree/laboratory/drag_rig.hpp"
#include "scree/laboratory/gear.hpp"
#include "scree/laboratory/rock_sample.hpp"
#include "scree/laboratory/stage.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace scree {

struct DragTestSetup {
  RockSample sample = paper_rock();
  DragSetup rig{};        ///< what it says of rock, steel and trough is not used: they are the sample's
  BucketBody bucket{};    ///< as it is said to be
  Gear gear{};            ///< how rig and load cell differ from that
  double interval = 0.01; ///< s, simulated, between two lines of the record, above 0
  std::uint64_t seed = 1;
  unsigned threads = 0; ///< 0: one for each processor
};

struct DragTestResult {
  std::vector<DragSample> curve{}; ///< true forces
  std::vector<DragRow> rows{};     ///< forces as the load cell reads them
  BedReport bed{};
};

/// Makes a bed, lays the bucket on it and drags it.
///
///     scree::DragTest<> test{setup};
///     const auto pieces = scree::pieces_of(test.run().rows, setup.rig.drag_distance, 4);
///
/// \tparam Haul what moves the bucket (bucket_haul.hpp)
template <class Model = DefaultModel, class Haul = RopeHaul>
class DragTest {
public:
  using Sim = Simulation<Model>;
  using Setting = DragTestSetup;
  using Result = DragTestResult;

  /// \throws Error for a parameter out of its range.
  explicit DragTest(DragTestSetup setup, Setup<Model> physics = {}, Haul haul = {})
      : setup_{checked(std::move(setup))},
        rig_{rig_of(setup_), setup_.gear.applied_to(setup_.bucket), std::move(physics), std::move(haul)} {}

  /// Once. `watch(simulation, Stage)` is called after every step.
  /// \throws Error as DragRig does.
  template <class Watch>
  const DragTestResult& run(Watch watch) {
    once_.begin("drag");
    Stage stage{"bed", 0.0};
    result_.bed = rig_.make_bed(setup_.sample.assembly, [&](const auto& simulation, const Stage& bed) {
      stage = {"bed, " + bed.name, 0.3 * bed.share};
      watch(simulation, std::as_const(stage));
    });
    stage = {"placing the bucket", 0.3};
    const auto observe = [&](const auto& simulation) { watch(simulation, std::as_const(stage)); };
    rig_.place_bucket(observe);
    stage.name = "dragging";
    keep(rig_.sample());
    while (!rig_.done()) {
      rig_.advance(setup_.interval, observe);
      keep(rig_.sample());
      stage.share = 0.3 + 0.7 * std::clamp(rig_.drag() / setup_.rig.drag_distance, 0.0, 1.0);
    }
    return result_;
  }
  const DragTestResult& run() {
    return run([](const auto&, const Stage&) {});
  }

  [[nodiscard]] const DragTestSetup& setup() const { return setup_; }
  [[nodiscard]] const DragTestResult& result() const { return result_; }
  [[nodiscard]] const DragRig<Model, Haul>& rig() const { return rig_; }
  [[nodiscard]] const Sim& simulation() const { return rig_.simulation(); }

private:
  static DragTestSetup checked(DragTestSetup setup) {
    require_positive("drag interval", setup.interval, "s");
    setup.gear.check();
    return setup;
  }
  static DragSetup rig_of(const DragTestSetup& setup) {
    DragSetup rig = setup.gear.applied_to(setup.rig);
    rig.seed = setup.seed;
    rig.threads = setup.threads;
    rig.rock = setup.sample.rock;
    rig.steel = rig.floor = setup.sample.rig;
    rig.stiffness = setup.sample.stiffness;
    rig.size_factor = setup.sample.assembly.size_factor();
    return rig;
  }

  void keep(const DragSample& s) {
    result_.curve.push_back(s);
    result_.rows.push_back({.drag = s.drag,
                            .force = setup_.gear.reading(s.force),
                            .pitch = s.attitude.pitch,
                            .depth = s.depth,
                            .mass = s.fill.struck,
                            .lag = s.wound - s.drag});
  }

  DragTestSetup setup_;
  RunsOnce once_;
  DragRig<Model, Haul> rig_;
  DragTestResult result_;
};

} // namespace scree
