#include "scree/laboratory/bucket_body.hpp"
#include "scree/laboratory/drag_rig.hpp"
#include "scree/measure/state_hash.hpp"
#include "support/models.hpp"
#include "support/relative_error.hpp"
#include "validation/scatter.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

using namespace scree;

namespace {

struct Resting : DefaultModel {
  using Rest = RestingRegions;
};

/// A tenth of the way, over a bed of few large grains.
DragSetup small_drag() {
  DragSetup s = desk_drag();
  s.size_factor = 2.6;
  s.bed_length = 0.9;
  s.bed_width = 0.42;
  s.bed_depth = 0.2;
  s.bucket_start = 0.1;
  s.drag_distance = 0.12;
  s.removal_interval = 0.04;
  s.removal_distance = 0.2;
  s.threads = 1;
  return s;
}

/// What a drag comes to: mean force [N], pitch [degrees] and depth [m] at the end.
template <class Model>
std::array<double, 3> dragged(DragSetup setup, std::uint64_t seed) {
  setup.seed = seed;
  DragRig<Model> rig{setup, bucket_body()};
  rig.make_bed(Assembly{default_rock(setup.mass_convention), setup.size_factor},
               [](const auto&, const auto&) {});
  rig.place_bucket([](const auto&) {});
  double force = 0.0;
  int samples = 0;
  DragSample sample;
  while (!rig.done()) {
    rig.advance(0.02, [](const auto&) {});
    sample = rig.sample();
    force += sample.force;
    ++samples;
  }
  return {force / samples, sample.attitude.pitch * 180.0 / std::numbers::pi, sample.depth};
}

/// Compares the means over some seeds. Grains that push past each other soon differ by all they can, whatever
/// is other: it is another seed, and only means can be compared.
template <class Model, class Other>
void check_alike(const DragSetup& setup, const DragSetup& other, const std::string& what) {
  std::array<std::vector<double>, 3> first, second;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const auto a = dragged<Model>(setup, seed), b = dragged<Other>(other, seed);
    for (std::size_t k = 0; k < 3; ++k) {
      first[k].push_back(a[k]);
      second[k].push_back(b[k]);
    }
  }
  constexpr double student = 3.71; // t at 99 % on both sides, 6 degrees of freedom
  for (std::size_t k = 0; k < 3; ++k) {
    const validation::Mean a{first[k]}, b{second[k]};
    const double error = std::hypot(a.error, b.error);
    MESSAGE(std::array<std::string, 3>{"force [N]", "pitch [degrees]", "depth [m]"}.at(k)
            << ": " << a.value << ", " << what << " " << b.value << ", standard error of the difference "
            << error);
    CHECK(std::abs(a.value - b.value) < student * error);
  }
}

} // namespace

TEST_CASE("long: a drag in float gives the force, pitch and depth that it gives in double") {
  check_alike<DefaultModel, test::LinearInFloat>(small_drag(), small_drag(), "in float");
}

TEST_CASE("long: a drag with resting regions gives the force, pitch and depth that it gives without") {
  DragSetup resting = small_drag();
  resting.resting = {.speed = 0.0075, .force = 0.1, .window = 500, .interval = 20};
  check_alike<DefaultModel, Resting>(small_drag(), resting, "with resting regions");
}

TEST_CASE("physics: grains that the bucket does not move rest while it is pulled, and not before") {
  DragSetup setup = small_drag();
  setup.drag_distance = 0.04;
  setup.resting = {.speed = 0.02, .force = 0.2, .window = 100, .interval = 20};
  DragRig<Resting> rig{setup, bucket_body()};
  std::size_t early = 0, late = 0;
  const auto count = [](std::size_t& sum) {
    return [&sum](const auto& s, const auto&...) { sum += s.resting_count(); };
  };
  rig.make_bed(Assembly{default_rock(setup.mass_convention), setup.size_factor}, count(early));
  rig.place_bucket(count(early));
  const std::size_t begin = rig.simulation().steps();
  while (!rig.done()) {
    rig.advance(0.02, count(late));
  }
  CHECK(early == 0);
  CHECK(late > (rig.simulation().steps() - begin) * rig.simulation().bodies().size() / 10);
}

TEST_CASE("physics: a bucket is dragged over a bed, its grains counted and removed, the same for any number "
          "of threads") {
  const auto run = [](unsigned threads) {
    DragSetup setup = small_drag();
    setup.threads = threads;
    DragRig<DefaultModel> rig{setup, bucket_body()};
    rig.make_bed(Assembly{default_rock(setup.mass_convention), setup.size_factor},
                 [](const auto&, const auto&) {});
    const std::size_t before = rig.simulation().bodies().size();
    rig.place_bucket([](const auto&) {});
    CHECK(std::abs(rig.sample().attitude.roll) < 0.3);
    double most = 0.0, last = 0.0;
    while (!rig.done()) {
      rig.advance(0.02, [](const auto&) {});
      const DragSample s = rig.sample();
      most = std::max(most, s.force);
      CHECK(s.force == s.force_left + s.force_right);
      CHECK(s.frictional_work >= last);
      last = s.frictional_work;
    }
    // The ropes have to overcome friction at least: a fifth of the bucket's weight is far below it.
    CHECK(most > 0.2 * rig.bucket().body.mass * 9.81);
    CHECK(rig.drag() == test::about(0.12, 0.2));
    CHECK(rig.simulation().bodies().size() < before);
    return state_hash(rig.simulation().bodies());
  };
  CHECK(run(1) == run(2));
}

TEST_CASE("the winch winds in what its speed and ramp say") {
  DragSetup s;
  s.drag_speed = 0.4;
  s.ramp = 0.2;
  CHECK(s.wound(-1.0) == 0.0);
  CHECK(s.wound(0.1) == test::about(0.01));
  CHECK(s.wound(0.2) == test::about(0.04));
  CHECK(s.wound(1.2) == test::about(0.44));
}

TEST_CASE("gravity leans against the drag where the bed rises towards the winch") {
  DragSetup s;
  s.drag_angle = 0.3;
  CHECK(s.gravity().norm() == test::about(9.81));
  CHECK(s.gravity().x() == test::about(-9.81 * std::sin(0.3)));
}

TEST_CASE("a rig that cannot work is refused by the parameter that is wrong") {
  DragSetup hasty = small_drag();
  hasty.resting.speed = 0.01;
  CHECK_THROWS_WITH_AS((DragRig<DefaultModel>{hasty, bucket_body()}),
                       doctest::Contains("resting.speed = 0.01 m/s"), Error);
  const auto refused = [](auto change) {
    DragSetup s = small_drag();
    change(s);
    try {
      const DragRig<DefaultModel> rig{s, bucket_body()};
    } catch (const Error& error) {
      return std::string{error.what()};
    }
    return std::string{};
  };
  CHECK(refused([](DragSetup& s) { s.bed_length = 0.5; }).find("bed_length = 0.5 m is too short") !=
        std::string::npos);
  CHECK(refused([](DragSetup& s) { s.bed_width = 0.2; }).find("bed_width = 0.2 m is narrower") !=
        std::string::npos);
  CHECK(refused([](DragSetup& s) { s.drag_speed = 0.0; }).find("drag_speed = 0 m/s") != std::string::npos);
  CHECK(refused([](DragSetup& s) { s.winch_distance = 0.1; }).find("winch_distance = 0.1 m must exceed") !=
        std::string::npos);
  CHECK(refused([](DragSetup& s) { s.rock.friction = -1.0; }).find("material 'rock': friction = -1") !=
        std::string::npos);
}
