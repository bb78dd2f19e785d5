#include "make_measured/laboratory.hpp"

#include "laboratory/diagnosis_plans.hpp"
#include "laboratory/measured_folder.hpp"
#include "laboratory/trials.hpp"
#include "make_measured/effects.hpp"
#include "make_measured/faults.hpp"
#include "support/results.hpp"

#include "scree/core/random.hpp"
#include "scree/io/atomic_file.hpp"
#include "scree/io/read_text.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace make_measured {

using namespace scree;
namespace ex = scree::examples;
using Json = nlohmann::ordered_json;

namespace {

ex::DiagnosisPlan plan_of(const Order& order) {
  const auto& names = ex::diagnosis_plan_names;
  if (std::find(names.begin(), names.end(), order.plan) != names.end() ||
      !std::filesystem::is_directory(order.plan)) {
    return ex::diagnosis_plan(order.plan, order.replicates);
  }
  ex::DiagnosisPlan out{
      order.plan,
      read_text(std::filesystem::path{order.plan} / "calibration.toml", std::size_t{1} << 20U),
      {}};
  for (const ex::PlannedExperiment& e : ex::read_plan(order.plan, ex::Data::none).experiments) {
    out.readings.push_back({e.name, order.replicates, order.reading_error, 0.0, {}});
  }
  return out;
}

} // namespace

void measure(const Order& order, const std::filesystem::path& folder, const Campaign& campaign,
             bool show_progress) {
  ex::DiagnosisPlan wanted = plan_of(order);
  misread(order.misread, wanted.readings);
  const auto measured = folder / "measured", truly = folder / "truth";
  std::filesystem::create_directories(measured);
  write_atomically(measured / "calibration.toml", wanted.toml);
  if (!order.misstated.empty()) {
    std::filesystem::create_directories(truly);
    write_atomically(truly / "calibration.toml", as_it_was(wanted.toml, order.misstated));
  }

  // The laboratory's rock: what the plan looks for, drawn at random, and the effects as parameters beside.
  ex::Plan plan = ex::read_plan(order.misstated.empty() ? measured : truly, ex::Data::none);
  Random draw{order.seed, "laboratory, rock"};
  std::vector<double> parameters;
  Json truth;
  truth["seed"] = order.seed;
  for (const Parameter& p : plan.space) {
    parameters.push_back(p.value(draw.uniform(0.2, 0.8)));
    truth["base"][p.name] = {{"value", parameters.back()}, {"unit", p.unit}};
  }
  truth["effects"] = Json::object();
  Random sizes{order.seed, "laboratory, effects"};
  for (const Effect& effect : effects_in(order.effects, plan, sizes)) {
    plan.space.push_back(effect.parameter);
    parameters.push_back(effect.value);
    Json one{{"parameter", effect.parameter.name}, {"value", effect.value}, {"unit", effect.parameter.unit}};
    if (!effect.form.empty()) {
      one["form"] = effect.form;
    }
    Json& there = truth["effects"][effect.name];
    (there.is_null() ? there : there["second"]) = one;
  }
  truth["misread"] = order.misread;
  truth["misstated"] = order.misstated;
  std::size_t expected = 0;
  for (const ex::Reading& reading : wanted.readings) {
    expected += reading.replicates;
  }
  ex::Trials trials{plan, campaign, order.limit, expected, show_progress, order.step_safety};
  ex::write_measurements(measured, plan, trials, parameters, wanted.readings, order.seed);
  trials.close();
  ex::write_json(folder / "truth.json", truth);
}

} // namespace make_measured
