#include "report.hpp"
#include "wording.hpp"

#include "scree/geometry/mesh_measures.hpp"
#include "scree/io/xml_text.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace paper_gap {

using namespace scree;

namespace {

const char* level_of(const Levels& levels, std::size_t f) {
  return levels[f] > 0 ? factors[f].high : factors[f].low;
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
    out +=
        "<tr>" + cell(name(m.motion)) + cell(fmt::format("{}", m.runs)) +
        cell(text(m.mean[force_near], "{:.0f}")) +
        cell(text(m.mean[force_near].scaled(1.0 / stated.force_near), "{:.2f}")) +
        cell(text(m.mean[force_end], "{:.0f}")) +
        cell(text(m.mean[force_end].scaled(1.0 / stated.force_end), "{:.2f}")) +
        cell(text(m.mean[pitch_near], "{:.1f}")) + cell(text(m.mean[depth_near].scaled(1e3), "{:.0f}")) +
        cell(text(m.mean[depth_end].scaled(1e3), "{:.0f}")) + cell(text(m.mean[mass_end], "{:.1f}")) +
        cell(text(m.mean[mass_end].scaled(1.0 / (interior * m.mean[bulk_density_kg_m3].value)), "{:.2f}")) +
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
  out += fmt::format(
      "</ul>\n<h2>First: the bucket's motion</h2>\n{}<p>The replayed pitch goes through the few "
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
      motions_table(r), w.up, w.up_at, w.measured, w.simulated, w.down_at, w.end, 1e3 * (w.lip - w.heel),
      f.depth.runs, text(f.depth.by_pitch_near.scaled(1e3), "{:.0f}"),
      text(f.depth.by_pitch_end.scaled(1e3), "{:.0f}"), text(f.depth.found_near.scaled(1e3), "{:.0f}"),
      text(f.depth.found_end.scaled(1e3), "{:.0f}"), figure);
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
