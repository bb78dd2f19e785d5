#include "report.hpp"

#include "scree/geometry/mesh_measures.hpp"
#include "scree/io/csv.hpp"
#include "scree/io/xml_text.hpp"
#include "support/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace paper_gap {

using namespace scree;
using Json = nlohmann::ordered_json;

namespace {

constexpr double gap = 3.0; ///< of the forces at the end, simulated over measured

/// "1.20 (1.05 to 1.38)": what a difference of logarithms says as a factor, with its 95 % interval.
struct Interval {
  double value, low, high;
};
Interval interval(const Effect& e, double freedom, bool as_factor) {
  const double reach = freedom > 0.0 ? student95(freedom) * e.error : std::nan("");
  if (as_factor) {
    return {std::exp(e.value), std::exp(e.value - reach), std::exp(e.value + reach)};
  }
  return {e.value, e.value - reach, e.value + reach};
}
std::string text(const Interval& i, const char* form) {
  const auto number = [&](double v) { return fmt::format(fmt::runtime(form), v); };
  if (!std::isfinite(i.low)) {
    return number(i.value) + " (no interval)";
  }
  return number(i.value) + " (" + number(i.low) + " to " + number(i.high) + ")";
}
std::string text(const Mean& m, const char* form) {
  const auto number = [&](double v) { return fmt::format(fmt::runtime(form), v); };
  return std::isfinite(m.error) ? number(m.value) + " ± " + number(m.error) : number(m.value);
}
bool clear(const Interval& i, double null) {
  return i.low > null || i.high < null;
}

/// Of the gap, in logarithms, so that shares of factors that multiply add up.
double share(const Effect& e) {
  return e.value / std::log(gap);
}

const char* scatter_of(const Analysis& a) {
  return a.replicated ? "replicates" : "what main effects leave, as there are no replicates";
}

const char* level_of(const Levels& levels, std::size_t f) {
  return levels[f] > 0 ? factors[f].high : factors[f].low;
}

void write_runs(const Report& r, const std::filesystem::path& file) {
  std::vector<std::string> columns{"run", "in_design", "seed", "motion"};
  for (const Factor& f : factors) {
    std::string column = f.name;
    std::replace(column.begin(), column.end(), ' ', '_');
    columns.push_back("level_" + column);
  }
  for (const Reading& reading : readings) {
    columns.emplace_back(reading.name);
  }
  std::string comment = "One line a run that came to its end. Levels: -1 and 1.";
  for (std::size_t f = 0; f < factor_count; ++f) {
    comment += message("\n", factors[f].name, ": ", factors[f].low, ", ", factors[f].high);
  }
  comment += "\nmotion:";
  for (std::size_t m = 0; m < motions.size(); ++m) {
    comment += message(" ", m, " ", name(motions[m]), ";");
  }
  CsvWriter table{file, columns, comment};
  for (const Done& run : r.runs) {
    if (!run.outcome) {
      continue; // its reason is in summary.json
    }
    const bool replayed = run.of.motion == Motion::free && run.of.levels[5] > 0;
    const Motion motion = replayed ? Motion::measured : run.of.motion;
    std::vector<double> row{static_cast<double>(run.run), run.in_design ? 1.0 : 0.0,
                            static_cast<double>(run.of.seed), static_cast<double>(motion)};
    for (const int level : run.of.levels) {
      row.push_back(level);
    }
    for (const Reading& reading : readings) {
      row.push_back(reading.of(*run.outcome));
    }
    table.row(row);
  }
}

/// Means over the replicates with all factors low, by motion; of those that came to their end.
std::string write_curves(const Report& r, const std::filesystem::path& folder) {
  struct Column {
    const char* name;
    std::vector<double> Outcome::*curve;
  };
  static constexpr std::array columns{Column{"force_N", &Outcome::force},
                                      Column{"pitch_deg", &Outcome::pitch},
                                      Column{"depth_m", &Outcome::depth}, Column{"mass_kg", &Outcome::mass}};
  std::vector<Motion> there;
  for (const MotionFinding& m : r.findings.motions) {
    if (m.runs > 0) {
      there.push_back(m.motion);
    }
  }
  const auto column = [](const Column& c, Motion motion) {
    return message(c.name, "_", static_cast<std::size_t>(motion));
  };
  std::vector<std::string> names{"drag_m"};
  for (const Column& c : columns) {
    for (const Motion motion : there) {
      names.push_back(column(c, motion));
    }
  }
  {
    CsvWriter table{
        folder / "curves.csv", names,
        "Means over pieces of the way and over replicates, all factors low, by motion as in runs.csv."};
    for (std::size_t k = 0; k < pieces; ++k) {
      std::vector<double> row{r.base.dragline.setup.drag_distance * (static_cast<double>(k) + 0.5) / pieces};
      for (const Column& c : columns) {
        for (const Motion motion : there) {
          std::vector<double> values;
          for (const Done& run : r.runs) {
            if (run.run == 0 && run.of.motion == motion && run.outcome) {
              values.push_back(((*run.outcome).*(c.curve))[k]);
            }
          }
          row.push_back(mean_of(values).value);
        }
      }
      table.row(row);
    }
  }
  const double way = r.base.dragline.setup.drag_distance;
  std::vector<examples::Panel> panels;
  // Four colours: the path that stays steep is in the table only.
  struct Drawn {
    Motion motion;
    const char* label;
  };
  static constexpr std::array drawn{Drawn{Motion::free, "free"}, Drawn{Motion::measured, "measured pitch"},
                                    Drawn{Motion::simulated, "the DEM's pitch"},
                                    Drawn{Motion::measured_sinks, "measured, free depth"}};
  static constexpr std::array<const char*, columns.size()> labels{"force, N", "pitch, degrees", "depth, m",
                                                                  "mass in the bucket, kg"};
  for (std::size_t c = 0; c < columns.size(); ++c) {
    examples::Panel panel{labels[c], "drag, m", labels[c], {}};
    for (const Drawn& one : drawn) {
      if (std::find(there.begin(), there.end(), one.motion) != there.end()) {
        panel.curves.push_back({"curves.csv", "drag_m", column(columns[c], one.motion), one.label});
      }
    }
    panels.push_back(std::move(panel));
  }
  panels[0].points = {{0.3 * way, stated.force_near, "stated, measured"},
                      {way, stated.force_end, "stated, measured"},
                      {way, stated.simulated_end, "stated, DEM", 1}};
  panels[1].points = {{0.3 * way, stated.pitch_near, "stated, measured"},
                      {0.3 * way, stated.simulated_near, "stated, DEM", 1}};
  if (there.empty()) {
    return {};
  }
  return examples::draw_plot(folder, "paper_gap", "All factors low: free, and along replayed paths", panels);
}

void write_effects(const Report& r, const std::filesystem::path& file) {
  const Findings& f = r.findings;
  std::string comment =
      "Change from low to high, with standard errors: of the logarithm of force, and of pitch.\n"
      "Rows: main effects 1 to 6, then groups of effects of two factors that are not told apart.";
  for (const AliasGroup& group : alias_groups()) {
    comment += "\n" + group.name;
  }
  CsvWriter table{
      file,
      {"row", "log_force_near", "error", "log_force_end", "error_end", "pitch_near_deg", "error_pitch"},
      comment};
  const auto rows = [&](const std::vector<Effect>& near, const std::vector<Effect>& end,
                        const std::vector<Effect>& pitch, std::size_t first) {
    for (std::size_t k = 0; k < std::min({near.size(), end.size(), pitch.size()}); ++k) {
      const std::vector<double> row{static_cast<double>(first + k),
                                    near[k].value,
                                    near[k].error,
                                    end[k].value,
                                    end[k].error,
                                    pitch[k].value,
                                    pitch[k].error};
      if (std::all_of(row.begin(), row.end(), [](double v) { return std::isfinite(v); })) {
        table.row(row);
      }
    }
  };
  rows(f.log_force_near.main, f.log_force_end.main, f.pitch_near.main, 1);
  rows(f.log_force_near.interactions, f.log_force_end.interactions, f.pitch_near.interactions,
       1 + factor_count);
}

Json json(const Mean& m) {
  return {{"mean", m.value}, {"standard_error", m.error}};
}
Json json(const Effect& e, const Analysis& of, bool as_factor) {
  const Interval i = interval(e, of.freedom, as_factor);
  return {{as_factor ? "factor" : "change", i.value}, {"interval_95", {i.low, i.high}}};
}

std::string cell(const std::string& s) {
  return "<td>" + xml_escaped(s);
}

std::string motions_table(const Report& r) {
  std::string out =
      "<table><tr><th>bucket<th>runs<th>force at 0.3 of the way, N<th>over 150 N<th>force over the "
      "last tenth, N<th>over 500 N<th>pitch at 0.3, degrees<th>depth at 0.3, mm<th>depth at the "
      "end, mm<th>mass, kg<th>of a full bucket<th>lift at the end, N</tr>\n";
  std::vector<std::string> remarks;                                         // in the program `drag`
  const double interior = volume(r.base.dragline.bucket(remarks).interior); // m3
  for (const MotionFinding& m : r.findings.motions) {
    const auto scaled = [](const Mean& mean, double factor) {
      return Mean{mean.value * factor, mean.error * factor};
    };
    out +=
        "<tr>" + cell(name(m.motion)) + cell(fmt::format("{}", m.runs)) +
        cell(text(m.mean[force_near], "{:.0f}")) +
        cell(text(scaled(m.mean[force_near], 1.0 / stated.force_near), "{:.2f}")) +
        cell(text(m.mean[force_end], "{:.0f}")) +
        cell(text(scaled(m.mean[force_end], 1.0 / stated.force_end), "{:.2f}")) +
        cell(text(m.mean[pitch_near], "{:.1f}")) + cell(text(scaled(m.mean[depth_near], 1e3), "{:.0f}")) +
        cell(text(scaled(m.mean[depth_end], 1e3), "{:.0f}")) + cell(text(m.mean[mass_end], "{:.1f}")) +
        cell(text(scaled(m.mean[mass_end], 1.0 / (interior * m.mean[bulk_density_kg_m3].value)), "{:.2f}")) +
        cell(text(m.mean[lift_end], "{:.0f}")) + "</tr>\n";
  }
  return out + "</table>\n";
}

std::string effects_table(const Report& r) {
  const Findings& f = r.findings;
  std::string out =
      "<table><tr><th>factor<th>low<th>high<th>force at 0.3 of the way, high over low<th>force over the "
      "last tenth, high over low<th>share of the factor of three<th>pitch at 0.3, degrees</tr>\n";
  for (std::size_t k = 0;
       k < std::min({f.log_force_near.main.size(), f.log_force_end.main.size(), f.pitch_near.main.size()});
       ++k) {
    const Interval end = interval(f.log_force_end.main[k], f.log_force_end.freedom, true);
    out += message(
        clear(end, 1.0) ? "<tr class='clear'>" : "<tr>", cell(factors[k].name), cell(factors[k].low),
        cell(factors[k].high),
        cell(text(interval(f.log_force_near.main[k], f.log_force_near.freedom, true), "{:.2f}")),
        cell(text(end, "{:.2f}")), cell(fmt::format("{:+.0f} %", 100.0 * share(f.log_force_end.main[k]))),
        cell(text(interval(f.pitch_near.main[k], f.pitch_near.freedom, false), "{:+.1f}")), "</tr>\n");
  }
  out +=
      "</table>\n<h3>Effects of two factors together</h3>\n<p>Those of one line cannot be told apart by this "
      "design; main effects are clear of them, but not of effects of three "
      "factors.</p>\n<table><tr><th>of<th>"
      "force at 0.3, factor<th>force over the last tenth, factor</tr>\n";
  for (std::size_t k = 0;
       k < std::min(f.log_force_near.interactions.size(), f.log_force_end.interactions.size()); ++k) {
    const Effect& end = f.log_force_end.interactions[k];
    out += "<tr>" + cell(end.name) +
           cell(text(interval(f.log_force_near.interactions[k], f.log_force_near.freedom, true), "{:.2f}")) +
           cell(text(interval(end, f.log_force_end.freedom, true), "{:.2f}")) + "</tr>\n";
  }
  return out + "</table>\n";
}

std::string runs_table(const Report& r) {
  std::string out = "<table><tr><th>run";
  for (const Factor& f : factors) {
    out += message("<th>", xml_escaped(f.name));
  }
  out += "<th>force at 0.3, N<th>last tenth, N<th>pitch at 0.3<th>agrees with</tr>\n";
  const std::vector<Levels> runs = design();
  for (const Agreement& a : r.findings.agreements) {
    out += "<tr>" + cell(fmt::format("{}", a.run));
    for (std::size_t f = 0; f < factor_count; ++f) {
      out += cell(level_of(runs[a.run], f));
    }
    out += cell(text(a.force_near, "{:.0f}")) + cell(text(a.force_end, "{:.0f}")) +
           cell(text(a.pitch_near, "{:.1f}")) +
           cell(a.with_measured    ? (a.with_simulated ? "both" : "what was measured")
                : a.with_simulated ? "the paper's DEM"
                                   : "neither") +
           "</tr>\n";
  }
  return out + "</table>\n";
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
    return Mean{std::nan(""), std::nan("")};
  };
  const auto over = [&](Motion motion) {
    const Mean force = force_of(motion);
    return text(Mean{force.value / stated.force_end, force.error / stated.force_end}, "{:.2f}");
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

namespace {

/// What the published figures leave open, in numbers where there are some.
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

} // namespace

std::string write_tables(const Report& report, const std::filesystem::path& folder) {
  write_runs(report, folder / "runs.csv");
  write_effects(report, folder / "effects.csv");
  return write_curves(report, folder);
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

std::string page(const Report& r, const std::string& figure) {
  const Findings& f = r.findings;
  std::string out =
      "<!doctype html>\n<html lang='en'><head><meta charset='utf-8'><title>scree: the paper's "
      "gap</title><style>\n"
      "body{font:14px/1.45 sans-serif;margin:2em auto;max-width:1120px;color:#222}\n"
      "table{border-collapse:collapse;width:100%;font-size:12.5px}\n"
      "td,th{border-bottom:1px solid #ddd;padding:3px 7px;text-align:left;vertical-align:top}\n"
      "tr.clear td{background:#fdeee6}\nsvg{max-width:100%;height:auto}\n</style></head><body>\n"
      "<h1>What carries the paper's gap</h1>\n<p>Coetzee, Els &amp; Dymond (2010) measured 150 N at a drag "
      "of 0.3 m and 500 "
      "N at 1 m. Their simulation gave the first and almost three times the second, with a pitch of -10 "
      "degrees at 0.3 m "
      "where -6.5 degrees was measured.</p>\n";
  out += fmt::format(
      "<p>At {} fidelity; {} of {} runs, {} of them failed. Intervals hold 95 %, from the scatter "
      "of {}.</p>\n<ul>\n",
      xml_escaped(r.fidelity), r.runs.size(), r.planned, f.failed, scatter_of(f.log_force_end));
  for (const std::string& s : sentences(r)) {
    out += "<li>" + xml_escaped(s) + "</li>\n";
  }
  out += "</ul>\n<h2>What these figures cannot decide</h2>\n<ul>\n";
  for (const std::string& s : undecided(r)) {
    out += "<li>" + xml_escaped(s) + "</li>\n";
  }
  const PathWords& w = r.base.path;
  out +=
      fmt::format("</ul>\n<h2>First: the bucket's motion</h2>\n{}<p>The replayed pitch goes through the few "
                  "values stated: it rises "
                  "to {} degrees (ours: at {} of the way), is {} or {} degrees at {} of the way, and then "
                  "goes to {} degrees at the "
                  "end or stays; monotone cubics between. Its depth is ours: that of the free bucket, or by "
                  "the pitch: the lip cuts, and the heel, "
                  "{:.0f} mm behind it, rides on "
                  "what the lip has left. In {} runs with a free bucket the depth so found from the bucket's "
                  "own pitch is {} mm at 0.3 of "
                  "the way and {} mm at 0.95, the true one {} mm and {} mm. A lift far from that of the free "
                  "bucket's ropes says that "
                  "the bucket would not go this way by itself.</p>\n{}<h2>Then: six factors</h2>\n",
                  motions_table(r), w.up, w.up_at, w.measured, w.simulated, w.down_at, w.end,
                  1e3 * (w.lip - w.heel), f.depth.runs,
                  text(Mean{1e3 * f.depth.by_pitch_near.value, 1e3 * f.depth.by_pitch_near.error}, "{:.0f}"),
                  text(Mean{1e3 * f.depth.by_pitch_end.value, 1e3 * f.depth.by_pitch_end.error}, "{:.0f}"),
                  text(Mean{1e3 * f.depth.found_near.value, 1e3 * f.depth.found_near.error}, "{:.0f}"),
                  text(Mean{1e3 * f.depth.found_end.value, 1e3 * f.depth.found_end.error}, "{:.0f}"), figure);
  out += fmt::format(
      "<p>Wall friction {} and {}; local damping {}; dense beds poured with {} times the friction, their "
      "particles {:.3f} times as dense, for one bulk density.</p>\n",
      r.base.friction_low, r.base.friction_high, r.base.damping, r.base.dense_friction, r.dense_density);
  out += effects_table(r) + "<h3>Runs of the design</h3>\n" + runs_table(r);
  if (f.failed > 0) {
    out += "<h3>Runs that failed</h3>\n<ul>\n";
    for (const Done& run : r.runs) {
      if (!run.outcome) {
        out += fmt::format("<li>run {}, {}, seed {}: {}</li>\n", run.run, name(run.of.motion), run.of.seed,
                           xml_escaped(run.failure));
      }
    }
    out += "</ul>\n";
  }
  return out + "</body></html>\n";
}

} // namespace paper_gap
