/// \brief A cause of your own that a diagnosis considers beside those of the library
/// \smoke
#include "scree/calibrate/run_log.hpp"
#include "scree/contact/normal_exponent.hpp"
#include "scree/contact/normal_hysteresis.hpp"
#include "scree/diagnose/diagnosis.hpp"
#include "scree/diagnose/shared_design.hpp"
#include "scree/simulation/run.hpp"
#include "scree/simulation/simulation.hpp"

#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

using namespace scree;

/// The cause: a dashpot that thickens with the overlap, as rubber between the grains does. Null at 0.
struct Rubber {
  double thickening = 0.0; ///< N s/m2, 0 or above

  static constexpr int history_size = 0; // remembers nothing of a contact
  static constexpr std::array<int, 0> history_parity{};

  template <class T>
  T normal(const PairMaterial<T>&, const Kinematics<T>& k, T normal_force, std::span<T, 0>, T&) const {
    return larger(normal_force - T(thickening) * k.overlap * dot(k.velocity, k.normal), T(0));
  }
};

struct Bouncing : DefaultModel {
  using Contact = LinearSpring<Rubber, NormalHysteresis, NormalExponent>;
};

/// What is measured: how a ball leaves a plate, over the speed at which it came, and for how long it touched.
const std::vector<double> speeds{0.2, 0.5, 1.0, 2.0, 4.0};

/// \param p restitution, stiffness, thickening, unloading ratio, exponent
std::vector<double> bounces(const std::vector<double>& p, Random& reading) {
  std::vector<double> out;
  double touched = 0.0;
  for (const double speed : speeds) {
    const Bouncing::Contact law{Rubber{.thickening = p[2]}, NormalHysteresis{.ratio = p[3]},
                                NormalExponent{.exponent = p[4]}};
    Simulation<Bouncing> sim{{.contact = law, .gravity = Vector::Zero(), .time_step = 5e-7}};
    const auto rock =
        sim.add_material({.normal_stiffness = p[1], .shear_stiffness = p[1], .restitution = p[0]});
    const Clump ball = make_clump("ball", std::vector<Sphere>{{Vector::Zero(), 0.01}});
    sim.add({.clump = &ball, .material = rock, .position = {0.0, 0.0, 0.01}, .velocity = {0.0, 0.0, -speed}});
    sim.add_wall({.name = "plate", .surfaces = {{Plane{}, rock}}, .dynamics = Fixed{}});
    run_while(sim, [](const auto& s) {
      return s.time() < 0.01 && (s.steps() == 0 || s.bodies().position(0).z() < 0.01);
    });
    touched += sim.time() / static_cast<double>(speeds.size());
    out.push_back(sim.bodies().velocity(0).z() / speed * (1.0 + 0.01 * reading.normal()));
  }
  out.push_back(touched * (1.0 + 0.01 * reading.normal()));
  return out;
}

int main() {
  const ModelSpace space{
      {{"restitution", "", 0.3, 0.95}, {"normal_stiffness", "N/m", 1e4, 1e6, true}},
      {{"rubber", {{"thickening", "N s/m2", 0.0, 3e4}}, {0.0}, "Contact = LinearSpring<Rubber>"},
       {"normal_hysteresis", {{"unloading_ratio", "", 1.0, 2.0}}, {1.0}},
       {"normal_law", {{"normal_exponent", "", 1.0, 1.5}}, {1.0}}}};

  // A laboratory with rubber between its grains measures eight balls.
  Random laboratory{1, "laboratory"};
  std::vector<Measured> measured;
  for (const double speed : speeds) {
    measured.push_back({.name = message("restitution at ", speed, " m/s"), .specimens = message(speed)});
  }
  measured.push_back({.name = "time of contact", .unit = "s", .logarithmic = true, .specimens = "time"});
  for (int ball = 0; ball < 8; ++ball) {
    const auto values = bounces({0.8, 1e5, 1.2e4, 1.0, 1.0}, laboratory);
    for (std::size_t k = 0; k < values.size(); ++k) {
      measured[k].replicates.push_back(values[k]);
    }
  }

  // Runs over the space of all models, any of which may be on another machine; these are not.
  RunLog log{space.parameters(), measured};
  Random random{2, "runs"};
  log.make(
      shared_design(space, 60, 1, random),
      [](const std::vector<RunRequest>& requests) {
        std::vector<RunOutcome> outcomes;
        for (const RunRequest& request : requests) {
          Random reading{request.seed};
          outcomes.push_back({bounces(request.parameters, reading), {}});
        }
        return outcomes;
      },
      random);

  const Diagnosis diagnosis = Diagnostician{space, measured, {}, log.runs()}();
  std::printf("%s: %s\n", name_of(diagnosis.finding).c_str(), diagnosis.reason.c_str());
  for (const Ranked& ranked : diagnosis.ranking) {
    std::printf("  log odds %7.1f  %s\n", ranked.log_odds,
                ranked.causes.empty() ? "base model" : space.causes()[ranked.causes.front()].name.c_str());
  }
  const Ranked& best = diagnosis.ranking.front();
  if (diagnosis.finding != Finding::cause || space.causes()[best.causes.front()].name != "rubber") {
    return 1;
  }
  const auto& found = best.parameters.front();
  std::printf("thickening %.3g N s/m2, %.3g to %.3g; made with 1.2e4\n", found.value, found.low, found.high);
  return found.low < 1.2e4 && 1.2e4 < found.high ? 0 : 1;
}
