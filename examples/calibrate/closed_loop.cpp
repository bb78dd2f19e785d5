#include "calibrate/closed_loop.hpp"

#include "laboratory/measured_folder.hpp"
#include "laboratory/measurements.hpp"
#include "laboratory/trials.hpp"

#include "scree/core/random.hpp"
#include "scree/io/atomic_file.hpp"

#include <cmath>
#include <system_error>

namespace calibrate {

namespace {

using namespace scree;
namespace ex = scree::examples;

/// All numbers are ours.
const std::vector<ex::Reading> readings{{"immersion", 10, 5e-4, 0.0},
                                        {"bulk_density", 12, 1e-3, 0.0},
                                        {"oedometer", 16, 1e-2, 0.0},
                                        {"angle_of_repose", 12, 0.0, 0.5}};

/// The bounds are wider than what is drawn, so that the truth is not at the edge of the space.
constexpr const char* calibration_toml =
    R"(# Made by `calibrate --closed-loop`: simulations stand for a laboratory.
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
use = ["solid_density_kg_m3"]

[experiments.bulk_density]
data = "bulk_density.csv"

[experiments.oedometer]
load.cycles = 2 # enough for these, and each costs a quarter of the time
data = "oedometer.csv"
use = ["modulus_Pa", "first_modulus_Pa", "unloading_modulus_Pa", "settlement"]

[experiments.angle_of_repose]
data = "angle_of_repose.csv"
)";

} // namespace

Truth make_measurements(const std::filesystem::path& folder, std::uint64_t seed, const Campaign& campaign,
                        double limit, bool show_progress) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    throw Error(message(folder.string(), ": cannot be made: ", error.message()));
  }
  Random draw{seed, "closed loop, truth"};
  Truth truth{{"particle_density", draw.uniform(1300.0, 2000.0)},
              {"normal_stiffness", 6e4 * std::pow(1.6e5 / 6e4, draw.uniform())},
              {"friction", draw.uniform(0.25, 0.7)}};

  write_atomically(folder / "calibration.toml", calibration_toml);
  const ex::Plan plan = ex::read_plan(folder, ex::Data::none);
  std::vector<double> parameters = plan.start;
  for (std::size_t k = 0; k < plan.space.size(); ++k) {
    for (const auto& [name, value] : truth) {
      parameters[k] = name == plan.space[k].name ? value : parameters[k];
    }
  }
  std::size_t expected = 0;
  for (const ex::Reading& reading : readings) {
    expected += reading.replicates;
  }
  ex::Trials trials{plan, campaign, limit, expected, show_progress};
  ex::write_measurements(folder, plan, trials, parameters, readings, seed);
  trials.close();
  return truth;
}

} // namespace calibrate
