#include "diagnose/report.hpp"

#include "scree/io/xml_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>

namespace diagnose {

using namespace scree;
using Json = nlohmann::ordered_json;

namespace {

std::string names_of(const Case& c, const std::vector<std::size_t>& causes) {
  std::string out;
  for (const std::size_t k : causes) {
    out += (out.empty() ? "" : " + ") + c.diagnosed.space.causes()[k].name;
  }
  return out.empty() ? "the base model" : out;
}

/// The hypothesis that the report compares with the base model.
const Ranked& extended(const Case& c) {
  return c.diagnosed.diagnosis
      .ranking[c.diagnosed.diagnosis.named.empty() ? 0 : c.diagnosed.diagnosis.named.front()];
}
const Ranked& base(const Case& c) {
  return *std::find_if(c.diagnosed.diagnosis.ranking.begin(), c.diagnosed.diagnosis.ranking.end(),
                       [](const Ranked& r) { return r.causes.empty(); });
}

std::string value_text(const Case& c, const Ranked::Interval& p) {
  const Parameter& parameter = c.diagnosed.space.parameters()[static_cast<std::size_t>(p.parameter)];
  return fmt::format("{} = {:.3g}{}{} ({:.3g} to {:.3g})", parameter.name, p.value,
                     parameter.unit.empty() ? "" : " ", parameter.unit, p.low, p.high);
}
std::string values_text(const Case& c, const Ranked& r) {
  std::string out;
  for (const auto& p : r.parameters) {
    out += (out.empty() ? "" : ", ") + value_text(c, p);
  }
  return out;
}

double shown(const Measured& m, double compared) {
  return m.logarithmic ? std::exp(compared) : compared;
}

} // namespace

std::string sentence(const Case& c) {
  const Diagnosis& d = c.diagnosed.diagnosis;
  switch (d.finding) {
  case Finding::no_discrepancy:
    return fmt::format(
        "Nothing is wrong: the base model explains all {} observables as well as chance allows.",
        c.diagnosed.fitted.size());
  case Finding::insufficient_data:
    return "These data cannot tell whether anything is wrong.";
  case Finding::cause:
  case Finding::causes:
    return fmt::format("The simulation lacks {}: {}.", names_of(c, extended(c).causes),
                       values_text(c, extended(c)));
  case Finding::indistinguishable: {
    std::string out = "The simulation lacks one of these, and these data cannot tell which: ";
    for (std::size_t k = 0; k < d.named.size(); ++k) {
      out += (k == 0 ? "" : "; ") + names_of(c, d.ranking[d.named[k]].causes);
    }
    return out + ".";
  }
  default:
    return "The simulation is wrong, and none of the causes considered explains how.";
  }
}

std::vector<std::string> model_to_write(const Case& c) {
  std::vector<std::string> out;
  const bool named =
      c.diagnosed.diagnosis.finding == Finding::cause || c.diagnosed.diagnosis.finding == Finding::causes;
  if (!named) {
    return out;
  }
  auto parameter = extended(c).parameters.begin(); // of all causes, one after another
  for (const std::size_t k : extended(c).causes) {
    const Cause& cause = c.diagnosed.space.causes()[k];
    std::string values;
    for (std::size_t n = 0; n < cause.parameters.size(); ++n, ++parameter) {
      values += (n == 0 ? "" : ", ") + value_text(c, *parameter);
    }
    out.push_back(cause.extension + ": " + values);
  }
  return out;
}

std::string gain_of_runs(const Case& c) {
  if (!c.diagnosed.confirmation) {
    return "";
  }
  const Confirmation& there = *c.diagnosed.confirmation;
  if (!there.gain) {
    return fmt::format(
        "What was held out could be simulated to its end {} times with the base model and {} times "
        "with what is named: too few to tell a gain.",
        there.base_runs, there.extended_runs);
  }
  const Gain& gain = *there.gain;
  return fmt::format(
      "By runs of what was held out, {} with the base model and {} with what is named: error {:.3g} "
      "before, {:.3g} after, over the standard error of what was measured; gain {:.2f} ({:.2f} to "
      "{:.2f}).",
      there.base_runs, there.extended_runs, gain.before, gain.after, gain.share, gain.low, gain.high);
}

std::string next_experiment(const Case& c) {
  const Diagnosis& d = c.diagnosed.diagnosis;
  constexpr double telling = 2.0; // standard deviations of one measurement; ours
  if (!c.foreseen.empty() && c.foreseen.front().apart >= telling) {
    return fmt::format("{} ({}), in which no two of them are less than {:.1f} standard deviations of one "
                       "measurement apart",
                       c.foreseen.front().name, c.foreseen.front().kind, c.foreseen.front().apart);
  }
  if (d.finding == Finding::insufficient_data) {
    // The cause that stays hidden most easily.
    const auto least = std::min_element(d.power.begin(), d.power.end());
    if (least == d.power.end()) {
      return "";
    }
    const Cause& cause =
        c.diagnosed.space.causes()[static_cast<std::size_t>(std::distance(d.power.begin(), least))];
    return cause.separated_by.empty() ? "" : cause.separated_by.front();
  }
  if (d.finding != Finding::indistinguishable) {
    return "";
  }
  std::string out;
  for (const std::size_t r : d.named) {
    for (const std::size_t k : d.ranking[r].causes) {
      for (const std::string& one : c.diagnosed.space.causes()[k].separated_by) {
        out += out.find(one) == std::string::npos ? (out.empty() ? "" : "; ") + one : "";
      }
    }
  }
  return out;
}

namespace {

Json gain_json(const Gain& gain) {
  return {{"gain", gain.share},
          {"interval", {gain.low, gain.high}},
          {"before", gain.before},
          {"after", gain.after}};
}

} // namespace

Json verdict(const Case& c) {
  const Diagnosis& d = c.diagnosed.diagnosis;
  Json out;
  out["verdict"] = name_of(d.finding);
  out["sentence"] = sentence(c);
  out["reason"] = d.reason;
  out["causes"] = Json::array();
  out["parameters"] = Json::object();
  for (const std::size_t r : d.named) {
    for (const std::size_t k : d.ranking[r].causes) {
      const std::string& name = c.diagnosed.space.causes()[k].name;
      if (std::find(out["causes"].begin(), out["causes"].end(), name) == out["causes"].end()) {
        out["causes"].push_back(name);
      }
    }
  }
  for (const Ranked::Interval& p : extended(c).parameters) {
    const Parameter& parameter = c.diagnosed.space.parameters()[static_cast<std::size_t>(p.parameter)];
    out["parameters"][parameter.name] = {
        {"estimate", p.value}, {"interval", {p.low, p.high}}, {"unit", parameter.unit}};
  }
  for (Eigen::Index k = 0; k < c.diagnosed.space.base(); ++k) {
    const auto at = static_cast<std::size_t>(k);
    out["base"][c.diagnosed.space.parameters()[at].name] = {{"without", base(c).values[at]},
                                                            {"with", extended(c).values[at]}};
  }
  out["model"] = model_to_write(c);
  out["alarm"] = {{"p", d.alarm.p}, {"omnibus", d.alarm.omnibus}, {"directed", d.alarm.directed}};
  out["where"] = {{"observable", c.diagnosed.fitted[d.where.observable].name},
                  {"range", {c.diagnosed.fitted[d.where.onset].name, c.diagnosed.fitted[d.where.end].name}},
                  {"standardised_residual", d.where.residuals[d.where.observable]}};
  for (const Ranked& r : d.ranking) {
    Json one{{"causes", Json::array()}, {"log_odds_over_base", r.log_odds}, {"deviance", r.deviance}};
    for (const std::size_t k : r.causes) {
      one["causes"].push_back(c.diagnosed.space.causes()[k].name);
    }
    for (const Ranked::Interval& p : r.parameters) {
      one["parameters"][c.diagnosed.space.parameters()[static_cast<std::size_t>(p.parameter)].name] = {
          {"estimate", p.value}, {"interval", {p.low, p.high}}};
    }
    if (r.adequacy) {
      one["adequacy"] = *r.adequacy;
    }
    out["evidence"].push_back(std::move(one));
  }
  const auto alike = std::count(d.scatter.holds.begin(), d.scatter.holds.end(), true);
  out["scatter"] = {{"observables", alike},
                    {"measured_over_simulated_variance", d.scatter.ratio},
                    {"freedom", d.scatter.freedom}};
  out["adequacy"]["base"] = d.base_adequacy;
  if (d.ranking.front().adequacy) {
    out["adequacy"]["best"] = *d.ranking.front().adequacy;
  }
  for (std::size_t a = 0; a < d.confusion.size(); ++a) {
    const std::string truth =
        a < c.diagnosed.space.causes().size() ? c.diagnosed.space.causes()[a].name : "none";
    for (std::size_t b = 0; b < d.confusion[a].size(); ++b) {
      const std::string taken =
          b < c.diagnosed.space.causes().size() ? c.diagnosed.space.causes()[b].name : "none";
      out["confusion_at_half_range"][truth][taken] = d.confusion[a][b];
    }
  }
  if (d.held_out) {
    const HeldOutGain& h = *d.held_out;
    out["held_out_gain"] = gain_json(h.gain);
    out["held_out_gain"].update({{"p", h.p}, {"log_odds_over_base", h.log_odds}});
    for (std::size_t k = 0; k < c.diagnosed.held_out.size(); ++k) {
      out["held_out_gain"]["residuals"][c.diagnosed.held_out[k].name] = {
          {"before", h.residuals_before[static_cast<Eigen::Index>(k)]},
          {"after", h.residuals_after[static_cast<Eigen::Index>(k)]}};
    }
  }
  if (const auto& confirmation = c.diagnosed.confirmation) {
    Json& runs = out["held_out_gain"]["by_runs"];
    runs["runs"] = {{"before", confirmation->base_runs}, {"after", confirmation->extended_runs}};
    if (const auto& gain = confirmation->gain) {
      runs.update(gain_json(*gain));
    }
  }
  out["next_experiment"] = next_experiment(c);
  for (const ForeseenExperiment& e : c.foreseen) {
    Json one{{"experiment", e.name}, {"kind", e.kind}, {"apart", e.apart}};
    for (const Foreseen& f : e.observables) {
      Json& there = one["observables"][f.observable];
      there = {{"apart", f.apart}, {"scatter", f.scatter}};
      for (std::size_t r = 0; r < f.mean.size(); ++r) {
        there["by"][names_of(c, d.ranking[d.named[r]].causes)] = f.mean[r];
      }
    }
    if (!e.failure.empty()) {
      one["failure"] = e.failure;
    }
    out["foreseen"].push_back(std::move(one));
  }
  out["runs"] = {{"asked", c.diagnosed.log.asked()},
                 {"failed", c.diagnosed.log.failed()},
                 {"reasons", c.diagnosed.log.failures()}};
  out["seconds"] = c.seconds;
  return out;
}

namespace {

/// A bar from zero to `share` of the half width, to either side.
std::string bar(double share, const char* colour) {
  const double length = 90.0 * std::clamp(share, -1.0, 1.0);
  return fmt::format("<svg width=184 height=12><line x1=92 x2=92 y1=0 y2=12 stroke='#999'/>"
                     "<rect x='{:.1f}' y=2 width='{:.1f}' height=8 fill='{}'/></svg>",
                     92.0 + std::min(0.0, length), std::abs(length), colour);
}

std::string observables_table(const Case& c) {
  std::string out =
      "<table><tr><th>observable<th>measured<th>standard error<th>base model<th>extended<th>base "
      "model less measured, over the standard error<th>extended</tr>\n";
  const auto& without = base(c).simulated;
  const auto& with = extended(c).simulated;
  const Where& where = c.diagnosed.diagnosis.where;
  for (std::size_t k = 0; k < c.diagnosed.fitted.size(); ++k) {
    const Measured& m = c.diagnosed.fitted[k];
    const double error = std::sqrt(variance_of(m));
    const double a = (without[k] - m.mean()) / error, b = (with[k] - m.mean()) / error;
    out += fmt::format("<tr{}><td>{}<td class=n>{:.5g}<td class=n>{:.2g}<td class=n>{:.5g}<td class=n>{:.5g}"
                       "<td>{}{:+.1f}<td>{}{:+.1f}</tr>\n",
                       k >= where.onset && k <= where.end ? " class=no" : "", xml_escaped(m.name),
                       shown(m, m.mean()), m.logarithmic ? error * shown(m, m.mean()) : error,
                       shown(m, without[k]), shown(m, with[k]), bar(a / 10.0, "#d55e00"), a,
                       bar(b / 10.0, "#0072b2"), b);
  }
  return out + "</table>\n";
}

std::string evidence_table(const Case& c) {
  std::string out =
      "<table><tr><th>hypothesis<th>log10 of its odds over the base model<th>chance to leave as much"
      "<th>parameters</tr>\n";
  double most = 1.0;
  for (const Ranked& r : c.diagnosed.diagnosis.ranking) {
    most = std::max(most, std::abs(r.log_odds) / std::log(10.0));
  }
  for (const Ranked& r : c.diagnosed.diagnosis.ranking) {
    const double decades = r.log_odds / std::log(10.0);
    out += fmt::format("<tr><td>{}<td>{}{:+.1f}<td>{}<td>{}</tr>\n", xml_escaped(names_of(c, r.causes)),
                       bar(decades / most, "#0072b2"), decades,
                       r.adequacy ? fmt::format("{:.2g}", *r.adequacy) : "", xml_escaped(values_text(c, r)));
  }
  return out + "</table>\n";
}

std::string confusion_table(const Case& c) {
  const auto& matrix = c.diagnosed.diagnosis.confusion;
  const auto name = [&](std::size_t k) {
    return k < c.diagnosed.space.causes().size() ? c.diagnosed.space.causes()[k].name : std::string{"none"};
  };
  std::string out = "<table class=m><tr><th>truth, half its range";
  for (std::size_t b = 0; b < matrix.size(); ++b) {
    out += "<th>" + xml_escaped(name(b));
  }
  out += "</tr>\n";
  for (std::size_t a = 0; a < matrix.size(); ++a) {
    out += "<tr><td>" + xml_escaped(name(a));
    for (const double share : matrix[a]) {
      out += fmt::format("<td class=n style='background:rgba(0,114,178,{:.2f})'>{}", 0.8 * share,
                         share < 0.005 ? "" : fmt::format("{:.0f} %", 100.0 * share));
    }
    out += "</tr>\n";
  }
  return out + "</table>\n";
}

/// What each rival says of what was not measured yet.
std::string foreseen_table(const Case& c) {
  const Diagnosis& d = c.diagnosed.diagnosis;
  std::string out = "<table><tr><th>not measured yet<th>observable";
  for (const std::size_t r : d.named) {
    out += "<th>with " + xml_escaped(names_of(c, d.ranking[r].causes));
  }
  out += "<th>scatter of one measurement<th>the two that are closest, over that</tr>\n";
  for (const ForeseenExperiment& e : c.foreseen) {
    if (!e.failure.empty()) {
      out += fmt::format("<tr><td>{}<td>{}</tr>\n", xml_escaped(e.name), xml_escaped(e.failure));
    }
    for (const Foreseen& f : e.observables) {
      out += fmt::format("<tr><td>{}<td>{}", xml_escaped(e.name), xml_escaped(f.observable));
      for (const double mean : f.mean) {
        out += fmt::format("<td class=n>{:.4g}", mean);
      }
      out += fmt::format("<td class=n>{:.2g}<td class=n>{:.1f}</tr>\n", f.scatter, f.apart);
    }
  }
  return out + "</table>\n";
}

std::string held_out_table(const Case& c) {
  if (!c.diagnosed.diagnosis.held_out) {
    return "<p>No experiment was held out, or there is no cause to be tried on it.</p>\n";
  }
  const HeldOutGain& h = *c.diagnosed.diagnosis.held_out;
  std::string out =
      fmt::format("<p>Root mean square error, over the standard error of what was measured: {:.2f} "
                  "before, {:.2f} after; gain {:.0f} % ({:.0f} to {:.0f} %), as predicted from the runs of "
                  "this diagnosis. {}</p>\n<table><tr><th>held out<th>before<th>after<th></tr>\n",
                  h.gain.before, h.gain.after, 100.0 * h.gain.share, 100.0 * h.gain.low, 100.0 * h.gain.high,
                  gain_of_runs(c));
  for (std::size_t k = 0; k < c.diagnosed.held_out.size(); ++k) {
    const double a = h.residuals_before[static_cast<Eigen::Index>(k)],
                 b = h.residuals_after[static_cast<Eigen::Index>(k)];
    out += fmt::format("<tr><td>{}<td>{}{:+.1f}<td>{}{:+.1f}<td>{}</tr>\n",
                       xml_escaped(c.diagnosed.held_out[k].name), bar(a / 10.0, "#d55e00"), a,
                       bar(b / 10.0, "#0072b2"), b, std::abs(b) > std::abs(a) + 1.0 ? "worse" : "");
  }
  return out + "</table>\n";
}

} // namespace

std::string page(const Case& c) {
  const Diagnosis& d = c.diagnosed.diagnosis;
  std::string out = fmt::format(
      "<!doctype html>\n<html lang='en'><head><meta charset='utf-8'><title>scree: diagnosis</title><style>\n"
      "body{{font:14px/1.45 sans-serif;margin:2em auto;max-width:1120px;color:#222}}\n"
      "table{{border-collapse:collapse;width:100%;font-size:12.5px}}\n"
      "td,th{{border-bottom:1px solid #ddd;padding:3px 7px;text-align:left}}\n"
      "table.m th{{font-size:10px;vertical-align:bottom}}\n"
      "td.n{{text-align:right;font-variant-numeric:tabular-nums;white-space:nowrap}}\n"
      "tr.no td{{background:#fdeee6}}\n.verdict{{font-size:19px;padding:.7em 1em;background:#eef4f9;"
      "border-left:5px solid #0072b2}}\n</style></head><body>\n<h1>Diagnosis</h1>\n"
      "<p class=verdict>{}</p>\n<p>{}</p>\n",
      xml_escaped(sentence(c)), xml_escaped(d.reason));
  for (const std::string& line : model_to_write(c)) {
    out += "<p>To be written: <code>" + xml_escaped(line) + "</code></p>\n";
  }
  if (const std::string next = next_experiment(c); !next.empty()) {
    out += "<p>To be measured next: " + xml_escaped(next) + ".</p>\n";
  }
  if (!c.foreseen.empty()) {
    out += "<h2>What is said of experiments that were not done yet</h2>\n<p>Simulated with each of what is "
           "named, at its best point; the experiment that tells all of them apart best comes first.</p>\n" +
           foreseen_table(c);
  }
  out +=
      fmt::format("<h2>Measured and simulated</h2>\n<p>By chance alone, so great a misfit of the base model "
                  "comes with p = {:.3g}, and so much evidence for a cause with p = {:.3g}. The observable "
                  "that all others predict worst is marked, with the stretch of its curve ({:+.1f} standard "
                  "errors).</p>\n",
                  d.alarm.omnibus, d.alarm.directed, d.where.residuals[d.where.observable]);
  out += observables_table(c);
  out += "<h2>Evidence</h2>\n<p>Two causes together are tried where none alone suffices, and listed where "
         "they come "
         "near the best.</p>\n" +
         evidence_table(c);
  out += "<h2>Held out</h2>\n" + held_out_table(c);
  out += "<h2>What these data could tell apart</h2>\n<p>Of data drawn from each cause at half its range: how "
         "often "
         "they are taken for what. By the models fitted here, not by more simulations.</p>\n" +
         confusion_table(c);
  out += fmt::format(
      "<h2>Assumptions and cost</h2>\n<p>{} runs of all experiments, {} failed, {:.0f} s. Means of "
      "replicates are "
      "taken as Student-distributed; what was measured on the same specimens scatters together as simulated "
      "runs do. Of {} observables the scatter is known beforehand too, from simulated specimens, as surely "
      "as from {:.1f} more. Each cause is as likely beforehand as any other, and its parameter anywhere in "
      "its range; "
      "two "
      "together are less likely.</p>\n<table><tr><th>cause<th>parameter<th>range<th>null</tr>\n",
      c.diagnosed.log.asked(), c.diagnosed.log.failed(), c.seconds,
      std::count(c.diagnosed.diagnosis.scatter.holds.begin(), c.diagnosed.diagnosis.scatter.holds.end(),
                 true),
      c.diagnosed.diagnosis.scatter.freedom);
  for (const Cause& cause : c.diagnosed.space.causes()) {
    for (std::size_t k = 0; k < cause.parameters.size(); ++k) {
      const Parameter& p = cause.parameters[k];
      out += fmt::format("<tr><td>{}<td>{}<td class=n>{:.4g} to {:.4g} {}<td class=n>{:.4g}</tr>\n",
                         xml_escaped(cause.name), xml_escaped(p.name), p.least, p.most, xml_escaped(p.unit),
                         cause.null[k]);
    }
  }
  return out + "</table>\n</body></html>\n";
}

} // namespace diagnose
