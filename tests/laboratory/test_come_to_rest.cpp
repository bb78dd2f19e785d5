#include "scree/laboratory/come_to_rest.hpp"
#include "scree/laboratory/stage.hpp"
#include "scree/simulation/simulation.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

using namespace scree;

namespace {

/// Nineteen balls in hollows of a floor without friction, and one on a slope of it.
Unrest unrest_with(double slope, const RestCriterion& criterion) {
  Simulation<> sim;
  const auto ice = sim.add_material(
      {.normal_stiffness = 1e4, .shear_stiffness = 1e4, .friction = 0.0, .restitution = 0.3});
  const Clump ball = make_clump("ball", std::vector<Sphere>{{Vector::Zero(), 0.01}});
  sim.add_wall({.name = "floor", .surfaces = {{Plane{}, ice}}, .dynamics = Fixed{}});
  const Vector up = Vector{-slope, 0.0, 1.0}.normalized();
  sim.add_wall({.name = "slope",
                .surfaces = {{Plane{.point = {1.0, 0.0, 0.0}, .normal = up}, ice}},
                .dynamics = Fixed{}});
  for (int k = 0; k < 19; ++k) {
    sim.add({.clump = &ball, .material = ice, .position = {-0.03 * k, 0.0, 0.01}});
  }
  sim.add({.clump = &ball, .material = ice, .position = Vector{1.5, 0.0, 0.5 * slope} + 0.01 * up});
  const auto watch = [](const auto&) {};
  return come_to_rest(sim, criterion, 0.1, watch);
}

} // namespace

TEST_CASE("physics: a grain that slides on is not at rest because it was stopped") {
  const RestCriterion criterion{.patience = 0.5};
  const Unrest sliding = unrest_with(0.15, criterion);
  CHECK(sliding.unbalanced < criterion.unbalanced); // the others do not let it be seen
  CHECK(sliding.moving == doctest::Approx(0.05));
  CHECK_THROWS_WITH_AS(require_rest("slope", sliding, criterion),
                       doctest::Contains("slope: not at rest within patience = 0.5 s"), Error);
  const Unrest resting = unrest_with(1e-6, criterion);
  CHECK(resting.within(criterion));
  CHECK_NOTHROW(require_rest("floor", resting, criterion));
}

TEST_CASE("an experiment runs once") {
  RunsOnce once;
  once.begin("heap");
  CHECK_THROWS_WITH_AS(once.begin("heap"), doctest::Contains("heap: this experiment has run"), Error);
}
