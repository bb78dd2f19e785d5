#include "laboratory/diagnosis_plans.hpp"

#include "scree/core/error.hpp"

namespace scree::examples {

namespace {

// All numbers are ours. Bounds are wider than what is drawn, so that the truth is not at the edge of the
// space.
constexpr const char* desk = R"(# Simulations stand for a laboratory.
fidelity = "desk"

[parameters.particle_density] # kg/m3
least = 1100.0
most = 2300.0

[parameters.normal_stiffness] # N/m
least = 4e4
most = 2.5e5

[parameters.friction]
least = 0.15
most = 0.9

[experiments.immersion]
batch.grains = 4000
data = "immersion.csv"

[experiments.bulk_density]
container.radius = 0.1
container.height = 0.1
fill.surplus = 0.5
data = "bulk_density.csv"

[experiments.oedometer]
container.radius = 0.1
container.height = 0.08
load.cycles = 2
data = "oedometer.csv"

[experiments.angle_of_repose]
funnel.solid = 0.002
funnel.outlet = 0.15
funnel.rim = 0.28
data = "angle_of_repose.csv"

[experiments.drop_slowly]
kind = "drop_test"
drop.patience = 1.0
drop.speeds = [0.5, 0.7, 1.0, 1.2, 1.5]
data = "drop_slowly.csv"

[experiments.drop_fast]
kind = "drop_test"
drop.speeds = [2.5, 3.0, 3.5, 4.0, 4.5]
data = "drop_fast.csv"

[experiments.tilt_test]
tilt.rocks = 25
tilt.rate = 6.0
data = "tilt_test.csv"
use = ["angle_deg", "failure_angle_deg"]

[experiments.tamped] # denser: the same rock with less friction while it is poured
kind = "bulk_density"
container.radius = 0.1
container.height = 0.1
fill.packing_friction = 0.3
fill.surplus = 0.5
data = "tamped.csv"

[experiments.rising_funnel]
kind = "angle_of_repose"
funnel.solid = 0.002
funnel.outlet = 0.15
funnel.rim = 0.28
funnel.clearance = 0.06
funnel.lift_speed = 0.1
held_out = true
data = "rising_funnel.csv"

[experiments.stronger]
kind = "oedometer"
container.radius = 0.1
container.height = 0.08
load.high_stress = 8e4
load.cycles = 1
held_out = true
data = "stronger.csv"
use = ["first_modulus_Pa", "settlement"]
)";

constexpr const char* mini = R"(# Simulations stand for a laboratory.
fidelity = "desk"

[parameters.particle_density] # kg/m3
least = 1100.0
most = 2300.0

[parameters.normal_stiffness] # N/m
least = 5e3
most = 3e4

[parameters.friction]
least = 0.15
most = 0.9

[rock]
normal_stiffness = 1.2e4
shear_stiffness = 1.2e4

[rig]
normal_stiffness = 1.2e4
shear_stiffness = 1.2e4

[experiments.immersion]
batch.grains = 1000
data = "immersion.csv"

[experiments.bulk_density]
container.radius = 0.08
container.height = 0.08
fill.surplus = 0.5
data = "bulk_density.csv"

[experiments.tamped] # denser: the same rock with less friction while it is poured
kind = "bulk_density"
container.radius = 0.08
container.height = 0.08
fill.packing_friction = 0.3
fill.surplus = 0.5
data = "tamped.csv"

[experiments.oedometer]
container.radius = 0.08
container.height = 0.08
load.low_stress = 1e3
load.high_stress = 5e3
load.cycles = 2
load.strain_rate = 0.25
load.most_inertial_number = 2e-2
data = "oedometer.csv"

[experiments.angle_of_repose]
funnel.solid = 0.001
funnel.outlet = 0.15
funnel.rim = 0.28
data = "angle_of_repose.csv"

[experiments.drop_slowly]
kind = "drop_test"
drop.patience = 1.0
drop.speeds = [0.5, 0.7, 1.0, 1.2, 1.5]
data = "drop_slowly.csv"

[experiments.drop_fast]
kind = "drop_test"
drop.speeds = [2.5, 3.0, 3.5, 4.0, 4.5]
data = "drop_fast.csv"

[experiments.tilt_test]
tilt.rocks = 25
tilt.rate = 12.0
data = "tilt_test.csv"
use = ["angle_deg", "failure_angle_deg"]

[experiments.rising_funnel]
kind = "angle_of_repose"
funnel.solid = 0.001
funnel.outlet = 0.15
funnel.rim = 0.28
funnel.clearance = 0.06
funnel.lift_speed = 0.1
held_out = true
data = "rising_funnel.csv"

[experiments.stronger]
kind = "oedometer"
container.radius = 0.08
container.height = 0.08
load.low_stress = 2e3
load.high_stress = 1e4
load.cycles = 1
load.strain_rate = 0.25
load.most_inertial_number = 2e-2
held_out = true
data = "stronger.csv"
use = ["first_modulus_Pa", "settlement"]
)";

std::vector<Reading> readings(std::size_t replicates) {
  return {{"immersion", replicates, 5e-4, 0.0},      {"bulk_density", replicates, 1e-3, 0.0},
          {"tamped", replicates, 1e-3, 0.0},         {"oedometer", replicates, 1e-2, 0.0},
          {"angle_of_repose", replicates, 0.0, 0.5}, {"drop_slowly", replicates, 5e-3, 0.0},
          {"drop_fast", replicates, 5e-3, 0.0},      {"tilt_test", replicates, 0.0, 0.3},
          {"rising_funnel", replicates, 0.0, 0.5},   {"stronger", replicates, 1e-2, 0.0}};
}

} // namespace

DiagnosisPlan diagnosis_plan(const std::string& name, std::size_t replicates) {
  if (name == "desk") {
    return {name, desk, readings(replicates)};
  }
  if (name == "mini") {
    return {name, mini, readings(replicates)};
  }
  throw Error(message("there is no plan '", name, "' of experiments; there are desk and mini"));
}

} // namespace scree::examples
