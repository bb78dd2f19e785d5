#include "scree/core/archive.hpp"
#include "scree/laboratory/bucket_body.hpp"
#include "scree/laboratory/drag_test.hpp"
#include "scree/measure/state_hash.hpp"
#include "support/models.hpp"
#include "support/relative_error.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

using namespace scree;

namespace {

/// A tenth of the way, over a bed of few large grains.
DragTestSetup small_test(std::uint64_t seed) {
  DragTestSetup s{
      .sample = desk_rock(), .rig = desk_drag(), .bucket = bucket_body(), .seed = seed, .threads = 1};
  s.sample.assembly = Assembly{s.sample.assembly.shapes(), 2.6};
  s.rig.bed_length = 0.9;
  s.rig.bed_width = 0.42;
  s.rig.bed_depth = 0.2;
  s.rig.bucket_start = 0.1;
  s.rig.drag_distance = 0.12;
  return s;
}

using Free = DragTest<DefaultModel>;
using Replayed = DragTest<DefaultModel, PathHaul>;

double mean_force(const std::vector<DragRow>& rows, double distance) {
  return pieces_of(rows, distance, 1).force.front();
}

} // namespace

TEST_CASE("physics: a bucket that is made to follow a path is where the path says, whatever the rock does") {
  const BucketPath path{{{0, 0, 0}, {0.03, 0.04, 0.0}, {0.08, -0.1, 0.01}, {0.13, -0.12, 0.02}}};
  const DragTestSetup setup = small_test(3);
  Replayed test{setup, {}, PathHaul{path}};
  const DragTestResult& run = test.run();
  CHECK(run.curve.size() > 10);
  for (const DragSample& s : run.curve) {
    const PathPoint at = path.at(s.drag);
    CHECK(std::abs(s.drag - s.wound) < 1e-12);
    CHECK(std::abs(s.attitude.pitch - at.pitch) < 1e-12);
    CHECK(std::abs(s.depth - at.depth) < 1e-12);
    CHECK(std::abs(s.attitude.roll - run.curve.front().attitude.roll) < 1e-12);
  }
  CHECK(mean_force(run.rows, setup.rig.drag_distance) > 0.0);
}

TEST_CASE("physics: a bucket led through free space takes its own weight and inertia, and no more") {
  DragTestSetup setup = small_test(4);
  // Up and away from the bed, steadily faster over the ramp and then evenly.
  const BucketPath path{{{0, 0, 0}, {0.01, 0, -0.05}, {0.05, 0, -0.25}, {0.2, 0, -1.0}}};
  setup.rig.ramp = 0.1;
  Replayed test{setup, {}, PathHaul{path}};
  const DragTestResult& run = test.run();
  const DragSample& last = run.curve.back();
  const double weight = setup.bucket.body.mass * 9.81;
  CHECK(std::abs(last.force) < 1e-6 * weight);
  CHECK(last.lift == test::about(weight, 1e-6));
  CHECK(last.kinetic_energy > 0.5 * setup.bucket.body.mass * 0.75 * 0.75);
}

TEST_CASE(
    "physics: along the path that a free bucket took, rock holds it with the force that its ropes had") {
  double free = 0.0, replayed = 0.0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const DragTestSetup setup = small_test(seed);
    Free own{setup};
    const auto& rows = own.run().rows;
    Replayed again{setup, {}, PathHaul{recorded_path(rows)}};
    const double f = mean_force(rows, setup.rig.drag_distance);
    const double r = mean_force(again.run().rows, setup.rig.drag_distance);
    MESSAGE("seed " << seed << ": " << f << " N free, " << r << " N along its path");
    free += f;
    replayed += r;
  }
  // Grains that push past each other are chaotic: one pair differs by some 15 %, the means of six by 6 %.
  CHECK(replayed == test::about(free, 0.25));
}

TEST_CASE("physics: a replayed drag that is taken up at any step ends in the same bits") {
  const DragTestSetup setup = small_test(2);
  const BucketPath path{{{0, 0, 0}, {0.03, 0.04, 0.0}, {0.08, -0.1, 0.01}, {0.13, -0.12, 0.02}}};
  DragSetup drag = setup.rig;
  drag.rock = setup.sample.rock;
  drag.steel = drag.floor = setup.sample.rig;
  drag.stiffness = setup.sample.stiffness;
  drag.seed = setup.seed;
  drag.threads = 1;
  drag.drag_distance = 0.03;
  using Rig = DragRig<DefaultModel, PathHaul>;
  const auto made = [&] { return std::make_unique<Rig>(drag, setup.bucket, Setup<>{}, PathHaul{path}); };
  const auto unwatched = [](const auto&) {};
  const auto finish = [&](Rig& rig) { // to the end, from wherever it is
    rig.place_bucket(unwatched);
    DragSample last;
    while (!rig.done()) {
      rig.advance(0.005, unwatched);
      last = rig.sample();
    }
    return last;
  };

  const auto whole = made();
  whole->make_bed(setup.sample.assembly, [](const auto&, const auto&) {});
  std::vector<std::string> states;
  const auto save = [&] {
    ArchiveWriter writer;
    writer(*whole);
    states.push_back(writer.bytes());
  };
  save();
  std::size_t steps = 0;
  whole->place_bucket([&](const auto&) {
    if (++steps == 200) {
      save();
    }
  });
  steps = 0;
  DragSample last;
  while (!whole->done()) {
    whole->advance(0.005, [&](const auto&) {
      if (++steps % 400 == 150) {
        save();
      }
    });
    last = whole->sample();
    if (!whole->done()) {
      save();
    }
  }
  CHECK(states.size() > 6);
  for (const std::string& state : states) {
    const auto other = made();
    ArchiveReader reader{state, "memory"};
    reader(*other);
    const DragSample s = finish(*other);
    CHECK(state_hash(other->simulation().bodies()) == state_hash(whole->simulation().bodies()));
    CHECK(s.force == last.force);
    CHECK(s.lift == last.lift);
    CHECK(s.attitude.pitch == last.attitude.pitch);
  }
}

TEST_CASE("a path that ends before the drag does is refused") {
  try {
    const Replayed test{
        small_test(1), {}, PathHaul{BucketPath{{{0, 0, 0}, {0.01, 0, 0}, {0.02, 0, 0}, {0.1, 0, 0}}}}};
    FAIL("not refused");
  } catch (const Error& error) {
    CHECK(std::string{error.what()}.find("ends at a drag of 0.1 m, before drag_distance = 0.12 m") !=
          std::string::npos);
  }
}
