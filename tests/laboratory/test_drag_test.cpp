#include "scree/laboratory/bucket_body.hpp"
#include "scree/laboratory/drag_test.hpp"
#include "scree/laboratory/rock_parameters.hpp"
#include "scree/measure/state_hash.hpp"
#include "support/models.hpp"
#include "support/relative_error.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

using namespace scree;

namespace {

/// A few centimetres, over a bed of some hundred large soft grains.
DragTestSetup tiny_drag() {
  DragTestSetup s{.sample = desk_rock(), .rig = desk_drag()};
  s.sample.assembly = Assembly{default_rock(), 3.0};
  for (Material* material : {&s.sample.rock, &s.sample.rig}) {
    material->normal_stiffness = material->shear_stiffness = 1e4;
  }
  s.rig.bed_length = 0.6;
  s.rig.bed_width = 0.36;
  s.rig.bed_depth = 0.15;
  s.rig.drag_distance = 0.05;
  s.bucket = bucket_body();
  s.threads = 1;
  return s;
}

struct Dragged {
  DragTestResult result;
  std::uint64_t hash;
};
Dragged dragged(const DragTestSetup& setup) {
  DragTest<> test{setup};
  (void)test.run();
  return {test.result(), state_hash(test.simulation().bodies())};
}

} // namespace

TEST_CASE("a drag with a rig as it is said to be is the drag itself, to the bit") {
  const DragTestSetup setup = tiny_drag();
  const Dragged null = dragged(setup);
  REQUIRE(null.result.curve.size() > 5);

  DragSetup rig = setup.rig;
  rig.seed = setup.seed;
  rig.threads = 1;
  rig.rock = setup.sample.rock;
  rig.steel = rig.floor = setup.sample.rig;
  rig.stiffness = setup.sample.stiffness;
  DragRig<DefaultModel> by_hand{rig, setup.bucket};
  by_hand.make_bed(setup.sample.assembly, [](const auto&, const auto&) {});
  by_hand.place_bucket([](const auto&) {});
  double last = by_hand.sample().force;
  while (!by_hand.done()) {
    by_hand.advance(setup.interval, [](const auto&) {});
    last = by_hand.sample().force;
  }
  CHECK(state_hash(by_hand.simulation().bodies()) == null.hash);
  CHECK(null.result.curve.back().force == last);

  // The load cell is told the force, and does not act back.
  DragTestSetup misread = setup;
  misread.gear.load_cell_gain = 1.25;
  misread.gear.load_cell_offset = -3.0;
  const Dragged wrong = dragged(misread);
  CHECK(wrong.hash == null.hash);
  for (std::size_t k = 0; k < wrong.result.rows.size(); ++k) {
    CHECK(wrong.result.curve[k].force == null.result.curve[k].force);
    CHECK(null.result.rows[k].force == null.result.curve[k].force);
    CHECK(wrong.result.rows[k].force == test::about(1.25 * null.result.rows[k].force - 3.0));
    CHECK(wrong.result.rows[k].pitch == null.result.rows[k].pitch);
  }
}

TEST_CASE("rope, bucket and floor that are not as they are said to be act on the drag") {
  const DragTestSetup setup = tiny_drag();
  const Dragged null = dragged(setup);
  const auto with = [&](double Gear::*what, double factor) {
    DragTestSetup other = setup;
    other.gear.*what = factor;
    return dragged(other);
  };
  // Hauled by the same winch, a slack rope lets the bucket lag behind.
  const Dragged slack = with(&Gear::rope_stiffness, 0.1);
  CHECK(slack.hash != null.hash);
  CHECK(slack.result.rows[3].lag > 1.2 * null.result.rows[3].lag);
  for (double Gear::*what : {&Gear::bucket_mass, &Gear::bucket_inertia}) {
    CHECK(with(what, 1.3).hash != null.hash);
  }
  CHECK(with(&Gear::floor_depth, 1.3).result.bed.kept > null.result.bed.kept);
}

TEST_CASE("gear multiplies what is stated of the rig") {
  const DragSetup rig = desk_drag();
  const DragSetup slack = Gear{.rope_stiffness = 0.5, .floor_depth = 0.75}.applied_to(rig);
  CHECK(slack.rope_stiffness == 0.5 * rig.rope_stiffness);
  CHECK(slack.bed_depth == 0.75 * rig.bed_depth);
  CHECK(slack.bed_length == rig.bed_length);
  const BucketBody bucket = tiny_drag().bucket;
  const BucketBody heavy = Gear{.bucket_mass = 2.0}.applied_to(bucket);
  CHECK(heavy.body.mass == 2.0 * bucket.body.mass);
  CHECK(heavy.body.inertia.isApprox(2.0 * bucket.body.inertia));
  const BucketBody sluggish = Gear{.bucket_inertia = 3.0}.applied_to(bucket);
  CHECK(sluggish.body.mass == bucket.body.mass);
  CHECK(sluggish.body.inertia.isApprox(3.0 * bucket.body.inertia));
  CHECK(Gear{.load_cell_gain = 2.0, .load_cell_offset = 5.0}.reading(10.0) == 25.0);
  CHECK(Gear{}.reading(0.1) == 0.1);
}

TEST_CASE("a parameter of the gear is one of the rock's model, null at first") {
  RockModel model{desk_rock()};
  struct Case {
    const char* name;
    double Gear::*what;
  };
  for (const Case& c :
       {Case{"rope_stiffness", &Gear::rope_stiffness}, Case{"bucket_mass", &Gear::bucket_mass},
        Case{"bucket_inertia", &Gear::bucket_inertia}, Case{"floor_depth", &Gear::floor_depth},
        Case{"load_cell_gain", &Gear::load_cell_gain}, Case{"load_cell_offset", &Gear::load_cell_offset}}) {
    CAPTURE(c.name);
    const RockParameter& parameter = rock_parameter(c.name);
    CHECK(parameter.get(model) == Gear{}.*c.what);
    parameter.set(model, 1.5);
    CHECK(model.gear.*c.what == 1.5);
    CHECK(parameter.get(model) == 1.5);
  }
  CHECK_FALSE(model.extended());
}

TEST_CASE("a rig that cannot be is refused") {
  DragTestSetup setup = tiny_drag();
  setup.gear.rope_stiffness = 0.0;
  CHECK_THROWS_WITH_AS(DragTest<>{setup}, doctest::Contains("gear rope_stiffness = 0"), Error);
  setup = tiny_drag();
  setup.interval = 0.0;
  CHECK_THROWS_WITH_AS(DragTest<>{setup}, doctest::Contains("drag interval = 0 s"), Error);
}
