#include "report.hpp"
#include "wording.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace paper_gap {

using namespace scree;
using Json = nlohmann::ordered_json;

namespace {

Json json(const Mean& m) {
  return {{"mean", m.value}, {"standard_error", m.error}};
}
Json json(const Effect& e, const Analysis& of, bool as_factor) {
  const Interval i = interval(e, of.freedom, as_factor);
  return {{as_factor ? "factor" : "change", i.value}, {"interval_95", {i.low, i.high}}};
}

} // namespace

std::vector<std::string> sentences(const Report& r) {
  const Findings& f = r.findings;
  std::vector<std::string> out;
  const auto force_of = [&](Motion motion) {
    for (const MotionFinding& m : f.motions) {
      if (m.motion == motion) {
        return m.mean[force_end];
      }
    }
    return Mean{{}};
  };
  const auto over = [&](Motion motion) {
    return text(force_of(motion).scaled(1.0 / stated.force_end), "{:.2f}");
  };
  out.push_back(fmt::format(
      "With all factors low, the force over the last tenth of the way is {} times the 500 N "
      "measured where the bucket is free. Led along the measured pitch it is {} times where depth "
      "follows from pitch and the bucket levels out after a third of the way, {} times where it "
      "stays as steep, and {} times where it is as deep as the free bucket.",
      over(Motion::free), over(Motion::measured), over(Motion::measured_stays),
      over(Motion::measured_sinks)));
  const auto times = [&](Motion of, Motion than) { return force_of(of).value / force_of(than).value; };
  out.push_back(
      fmt::format("3.5 degrees more at a third of the way, as in the paper's DEM, multiply it by {:.2f}; the "
                  "later pitch, which the text does not state, by {:.2f}; the depth, which it does not state "
                  "either, by {:.2f}.",
                  times(Motion::simulated, Motion::measured), times(Motion::measured_stays, Motion::measured),
                  times(Motion::measured_sinks, Motion::measured)));
  std::vector<std::pair<double, std::string>> carried;
  std::string unclear;
  for (std::size_t k = 0; k < f.log_force_end.main.size(); ++k) {
    const Effect& e = f.log_force_end.main[k];
    const Interval i = interval(e, f.log_force_end.freedom, true);
    if (clear(i, 1.0)) {
      carried.emplace_back(-std::abs(e.value),
                           fmt::format("{} ({} to {}) multiplies it by {}, {:+.0f} % of the factor of three",
                                       e.name, factors[k].low, factors[k].high, text(i, "{:.2f}"),
                                       100.0 * share(e)));
    } else {
      unclear += message(unclear.empty() ? "" : ", ", e.name, " ", text(i, "{:.2f}"));
    }
  }
  std::sort(carried.begin(), carried.end());
  for (const auto& [size, what] : carried) {
    out.push_back("At the end of the way " + what + ".");
  }
  if (!unclear.empty()) {
    out.push_back("No effect beyond the noise at the end of the way: " + unclear + ".");
  }
  if (std::isfinite(f.log_force_end.scatter)) {
    out.push_back(fmt::format(
        "A single run is off by a factor of {:.2f} at the end of the way and of {:.2f} at 0.3 of it (one "
        "standard deviation, from {}).",
        std::exp(f.log_force_end.scatter), std::exp(f.log_force_near.scatter), scatter_of(f.log_force_end)));
  }
  if (f.log_force_end.main.empty()) {
    out.emplace_back("There are too few runs of the design for effects.");
  }
  return out;
}

std::vector<std::string> undecided(const Report& r) {
  const Findings& f = r.findings;
  std::size_t measured = 0, simulated = 0;
  for (const Agreement& a : f.agreements) {
    measured += a.with_measured ? 1 : 0;
    simulated += a.with_simulated ? 1 : 0;
  }
  std::vector<std::string> out;
  out.push_back(
      fmt::format("Taken at face value, of {} combinations {} agree with what was measured (150 N, 500 N, "
                  "-6.5 degrees) and {} with "
                  "the paper's DEM (150 N, 1500 N, -10 degrees), forces to a factor of {} and pitch to {} "
                  "degrees beside the noise: {}.",
                  f.agreements.size(), measured, simulated, force_tolerance, pitch_tolerance,
                  measured > 1 || simulated > 1 ? "three numbers do not tell these combinations apart"
                  : measured + simulated == 0   ? "none of them is shown to be that of the paper"
                                                : "which is no proof, as others were not tried"));
  out.emplace_back(
      "The pitch after a third of the way and the depth at any place are in the paper's figures only. "
      "The replayed paths are reconstructions of ours, and the first table says how far they are apart in "
      "the force at the end.");
  out.emplace_back(
      "Wall friction, local damping, mass convention, porosity, and mass and inertia of the bucket are "
      "not stated for the paper's DEM: an effect that is large here says what could carry the gap, not "
      "what did.");
  out.emplace_back(
      "Levels are ours. An effect over a wider range is larger, and shares of the factor of three go "
      "with the levels.");
  out.emplace_back(
      "The forces themselves are not to be compared with the paper's at desk fidelity: its grains are "
      "coarser, softer and dragged faster. Ratios between runs are what is compared.");
  return out;
}

Json summary(const Report& r) {
  const Findings& f = r.findings;
  Json out;
  out["runs"] = {{"planned", r.planned}, {"done", r.runs.size()}, {"failed", f.failed}};
  out["failures"] = Json::array();
  for (const Done& run : r.runs) {
    if (!run.outcome) {
      out["failures"].push_back({{"run", run.run},
                                 {"in_design", run.in_design},
                                 {"motion", name(run.of.motion)},
                                 {"seed", run.of.seed},
                                 {"reason", run.failure}});
    }
  }
  out["density_of_dense_particles_over_loose"] = r.dense_density;
  for (const MotionFinding& m : f.motions) {
    Json one{{"runs", m.runs}};
    for (std::size_t k = 0; k < readings.size(); ++k) {
      one[readings[k].name] = json(m.mean[k]);
    }
    one["force_end_over_measured"] = m.mean[force_end].value / stated.force_end;
    out["motions"][name(m.motion)] = one;
  }
  for (std::size_t k = 0; k < f.log_force_end.main.size() && k < f.log_force_near.main.size(); ++k) {
    out["effects"][factors[k].name] = {{"low", factors[k].low},
                                       {"high", factors[k].high},
                                       {"force_near", json(f.log_force_near.main[k], f.log_force_near, true)},
                                       {"force_end", json(f.log_force_end.main[k], f.log_force_end, true)},
                                       {"share_of_the_factor_of_three", share(f.log_force_end.main[k])},
                                       {"pitch_near_deg", json(f.pitch_near.main[k], f.pitch_near, false)}};
  }
  for (std::size_t k = 0; k < f.log_force_end.interactions.size() && k < f.log_force_near.interactions.size();
       ++k) {
    out["effects_of_two"][f.log_force_end.interactions[k].name] = {
        {"force_near", json(f.log_force_near.interactions[k], f.log_force_near, true)},
        {"force_end", json(f.log_force_end.interactions[k], f.log_force_end, true)}};
  }
  out["scatter_of_log_force"] = {{"near", f.log_force_near.scatter},
                                 {"end", f.log_force_end.scatter},
                                 {"from", scatter_of(f.log_force_end)}};
  out["depth_from_pitch"] = {{"runs", f.depth.runs},
                             {"near_m", json(f.depth.found_near)},
                             {"near_by_pitch_m", json(f.depth.by_pitch_near)},
                             {"end_m", json(f.depth.found_end)},
                             {"end_by_pitch_m", json(f.depth.by_pitch_end)}};
  out["findings"] = sentences(r);
  out["cannot_decide"] = undecided(r);
  return out;
}

} // namespace paper_gap
