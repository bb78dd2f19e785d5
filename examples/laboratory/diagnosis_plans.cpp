#include "laboratory/diagnosis_plans.hpp"

#include "scree/core/error.hpp"

#include <string>

namespace scree::examples {

namespace {

// All numbers are ours. Bounds are wider than what is drawn, so that the truth is not at the edge of the
// space.

/// \param stiffness bounds
std::string base(const std::string& least, const std::string& most) {
  return R"(# Simulations stand for a laboratory.
fidelity = "desk"

[parameters.particle_density] # kg/m3
least = 1100.0
most = 2300.0

[parameters.friction]
least = 0.15
most = 0.9

[parameters.normal_stiffness] # N/m
least = )" +
         least + "\nmost = " + most + "\n";
}

/// Filled and struck off. \param more lines
std::string container(const std::string& name, const std::string& radius, const std::string& height,
                      const std::string& more = "") {
  return "\n[experiments." + name + "]\n" + (name == "bulk_density" ? "" : "kind = \"bulk_density\"\n") +
         "container.radius = " + radius + "\ncontainer.height = " + height + "\nfill.surplus = 0.5\n" + more +
         "data = \"" + name + ".csv\"\n";
}
/// The same rock with less friction while it is poured, so denser.
std::string tamped(const std::string& name, const std::string& radius, const std::string& height,
                   const std::string& packing_friction, const std::string& more = "") {
  return container(name, radius, height, "fill.packing_friction = " + packing_friction + "\n" + more);
}
std::string oedometer(const std::string& name, const std::string& radius, const std::string& height,
                      const std::string& more) {
  return "\n[experiments." + name + "]\n" + (name == "oedometer" ? "" : "kind = \"oedometer\"\n") +
         "container.radius = " + radius + "\ncontainer.height = " + height + "\n" + more + "data = \"" +
         name + ".csv\"\n";
}
std::string heap(const std::string& name, const std::string& solid, const std::string& more = "") {
  return "\n[experiments." + name + "]\n" +
         (name == "angle_of_repose" ? "" : "kind = \"angle_of_repose\"\n") + "funnel.solid = " + solid +
         "\nfunnel.outlet = 0.15\nfunnel.rim = 0.28\n" + more + "data = \"" + name + ".csv\"\n";
}
std::string lifted(const std::string& radius, const std::string& height) {
  return "\n[experiments.lifted_cylinder]\nkind = \"angle_of_repose\"\nheap.method = \"lifted_cylinder\"\n"
         "tube.radius = " +
         radius + "\ntube.height = " + height + "\ndata = \"lifted_cylinder.csv\"\n";
}
/// Single rocks dropped and a plate of them tilted, and a batch weighed in water.
std::string single_rocks(const std::string& batch, const std::string& tilt_rate) {
  return R"(
[experiments.immersion]
batch.grains = )" +
         batch + R"(
data = "immersion.csv"

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
tilt.rate = )" +
         tilt_rate + R"(
data = "tilt_test.csv"
use = ["angle_deg", "failure_angle_deg"]
)";
}

/// The same as one that was not done yet: without what is said of its data, which comes last.
std::string not_yet(const std::string& experiment) {
  return experiment.substr(0, experiment.find("data = ")) + "measured = false\n";
}

constexpr const char* not_fitted = "held_out = true\n";
constexpr const char* first_loading = R"(held_out = true
use = ["first_modulus_Pa", "settlement", "base_share"]
)";
constexpr const char* rising = R"(funnel.clearance = 0.06
funnel.lift_speed = 0.1
held_out = true
)";
constexpr const char* soft = R"(
[rock]
normal_stiffness = 1.2e4
shear_stiffness = 1.2e4

[rig]
normal_stiffness = 1.2e4
shear_stiffness = 1.2e4
)";
/// Loads that suit soft rock.
constexpr const char* light = R"(load.low_stress = 1e3
load.high_stress = 5e3
load.cycles = 2
load.strain_rate = 0.25
load.most_inertial_number = 2e-2
)";
constexpr const char* heavy = R"(load.low_stress = 2e3
load.high_stress = 1e4
load.cycles = 1
load.strain_rate = 0.25
load.most_inertial_number = 2e-2
)";

std::string desk() {
  // Four times as fast as the desk's oedometer has it, which takes a third of the time, and heaps of a
  // seventh of its rock: a diagnosis is to end within 20 minutes of two cores.
  const std::string quickly = "load.strain_rate = 0.25\nload.most_inertial_number = 2e-2\n";
  return base("4e4", "2.5e5") + single_rocks("4000", "6.0") + container("bulk_density", "0.1", "0.1") +
         tamped("tamped", "0.1", "0.1", "0.3") +
         oedometer("oedometer", "0.1", "0.08", quickly + "load.cycles = 2\n") +
         heap("angle_of_repose", "0.001") + heap("rising_funnel", "0.001", rising) +
         oedometer("stronger", "0.1", "0.08",
                   quickly + "load.high_stress = 8e4\nload.cycles = 1\n" + first_loading) +
         not_yet(tamped("barely_tamped", "0.1", "0.1", "0.6")) +
         not_yet(oedometer("more_cycles", "0.1", "0.08", quickly + "load.cycles = 4\n")) +
         not_yet(lifted("0.08", "0.18"));
}

std::string mini() {
  return base("5e3", "3e4") + soft + single_rocks("1000", "12.0") +
         container("bulk_density", "0.08", "0.08") + tamped("tamped", "0.08", "0.08", "0.3") +
         oedometer("oedometer", "0.08", "0.08", light) + heap("angle_of_repose", "0.001") +
         heap("rising_funnel", "0.001", rising) +
         oedometer("stronger", "0.08", "0.08", std::string{heavy} + first_loading) +
         not_yet(tamped("barely_tamped", "0.08", "0.08", "0.6")) + not_yet(lifted("0.06", "0.15"));
}

/// Single rocks once more, held out.
constexpr const char* again = R"(
[experiments.drop_between]
kind = "drop_test"
drop.speeds = [1.6, 1.8, 2.0, 2.2, 2.4]
held_out = true
data = "drop_between.csv"

[experiments.tilt_slowly]
kind = "tilt_test"
tilt.rocks = 25
tilt.rate = 6.0
held_out = true
data = "tilt_slowly.csv"
use = ["angle_deg", "failure_angle_deg"]
)";

std::string micro() {
  std::string rock = soft;
  rock.insert(rock.find("normal"), "fractions = [0.25, 0.0, 0.0, 0.75] # the last are spheres\n");
  return base("5e3", "3e4") + rock + single_rocks("1000", "12.0") + container("bulk_density", "0.1", "0.1") +
         tamped("tamped", "0.1", "0.1", "0.3") +
         oedometer("oedometer", "0.1", "0.08", std::string{"fill.surplus = 0.5\n"} + light) + again +
         tamped("lightly_tamped", "0.1", "0.1", "0.6", not_fitted) +
         not_yet(container("taller", "0.1", "0.2")) +
         not_yet(oedometer("stronger", "0.1", "0.08", std::string{"fill.surplus = 0.5\n"} + heavy)) +
         not_yet(heap("angle_of_repose", "0.001"));
}

/// A third of a metre through a few layers of coarse grains, by a slack rope, whose stretch tells the force
/// once more. The bucket is still empty on most of the way.
std::string short_drag(const std::string& name, const std::string& speed, const std::string& more = "",
                       const std::string& depth = "0.18") {
  return "\n[experiments." + name + "]\n" + (name == "drag" ? "" : "kind = \"drag\"\n") +
         "bed.length = 0.8\nbed.width = 0.36\nbed.depth = " + depth + "\nrig.drag_distance = 0.3\n" +
         "rig.rope_stiffness = 5e3\nrecord.pieces = 3\nrig.drag_speed = " + speed + "\n" + more +
         "data = \"" + name + ".csv\"\n" + R"(use = ["force_N_1", "force_N_2", "force_N_3",
  "pitch_deg_1", "pitch_deg_2", "pitch_deg_3", "depth_m_1", "depth_m_2", "depth_m_3",
  "lag_m_1", "lag_m_2", "lag_m_3", "mass_kg_3", "roughness"]
)";
}

std::string drag() {
  std::string rock = soft;
  rock.insert(rock.find("normal"), "fractions = [0.25, 0.0, 0.0, 0.75] # the last are spheres\n"
                                   "size_factor = 1.6\n");
  return base("5e3", "3e4") + rock + single_rocks("1000", "12.0") +
         container("bulk_density", "0.13", "0.13") + tamped("tamped", "0.13", "0.13", "0.3") +
         oedometer("oedometer", "0.13", "0.105", std::string{"fill.surplus = 0.5\n"} + light) +
         short_drag("drag", "0.9") + short_drag("drag_slower", "0.5", not_fitted) +
         not_yet(short_drag("drag_deeper", "0.9", "", "0.24"));
}

std::vector<Reading> readings(const std::string& plan, std::size_t replicates) {
  std::vector<Reading> out{{"immersion", replicates, 5e-4, 0.0},   {"bulk_density", replicates, 1e-3, 0.0},
                           {"tamped", replicates, 1e-3, 0.0},      {"oedometer", replicates, 1e-2, 0.0},
                           {"drop_slowly", replicates, 5e-3, 0.0}, {"drop_fast", replicates, 5e-3, 0.0},
                           {"tilt_test", replicates, 0.0, 0.3}};
  if (plan == "drag") {
    out.push_back({"drag", replicates, 1e-2, 0.0});
    out.push_back({"drag_slower", replicates, 1e-2, 0.0});
  } else if (plan == "micro") {
    out.push_back({"lightly_tamped", replicates, 1e-3, 0.0});
    out.push_back({"drop_between", replicates, 5e-3, 0.0});
    out.push_back({"tilt_slowly", replicates, 0.0, 0.3});
  } else {
    out.push_back({"angle_of_repose", replicates, 0.0, 0.5});
    out.push_back({"rising_funnel", replicates, 0.0, 0.5});
    out.push_back({"stronger", replicates, 1e-2, 0.0});
  }
  return out;
}

} // namespace

DiagnosisPlan diagnosis_plan(const std::string& name, std::size_t replicates) {
  if (name == "desk") {
    return {name, desk(), readings(name, replicates)};
  }
  if (name == "mini") {
    return {name, mini(), readings(name, replicates)};
  }
  if (name == "micro") {
    return {name, micro(), readings(name, replicates)};
  }
  if (name == "drag") {
    return {name, drag(), readings(name, replicates)};
  }
  throw Error(message("there is no plan '", name, "' of experiments; there are desk, mini, micro and drag"));
}

} // namespace scree::examples
