#pragma once
/// \file
/// The page of the validation: the table with what fails first, and the curves.

#include "finding.hpp"
#include "svg_chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

namespace validation {

/// All of it in one file, which needs nothing beside it.
inline std::string page(const std::vector<Outcome>& outcomes, const std::string& made_by) {
  std::vector<const Finding*> findings;
  for (const Outcome& o : outcomes) {
    for (const Finding& f : o.findings) {
      findings.push_back(&f);
    }
  }
  std::stable_partition(findings.begin(), findings.end(), [](const Finding* f) { return !f->pass(); });
  const auto failed =
      std::count_if(findings.begin(), findings.end(), [](const Finding* f) { return !f->pass(); });
  std::string out = fmt::format(
      "<!doctype html>\n<html lang='en'><head><meta charset='utf-8'><title>scree: validation</title><style>\n"
      "body{{font:14px/1.45 sans-serif;margin:2em auto;max-width:1120px;color:#222}}\n"
      "table{{border-collapse:collapse;width:100%;font-size:12.5px}}\n"
      "td,th{{border-bottom:1px solid #ddd;padding:3px 7px;text-align:left;vertical-align:top}}\n"
      "td.n{{text-align:right;font-variant-numeric:tabular-nums;white-space:nowrap}}\n"
      "tr.no td{{background:#fdeee6}}\nsvg{{margin:6px}}\nsvg text{{font:11px sans-serif;fill:#333}}\n"
      "svg .title{{font:bold 12px sans-serif}}\nsvg .grid{{stroke:#e2e2e2}}\n</style></head><body>\n"
      "<h1>scree: validation</h1>\n<p>{} quantities, {} outside their tolerance. "
      "{}</p>\n<h2>Table</h2>\n<table>"
      "<tr><th>case<th>quantity<th>reference<th>source<th>simulated<th>error<th>tolerance<th>within</tr>\n",
      findings.size(), failed, scree::xml_escaped(made_by));
  const auto error = [](const Finding& f, double value) {
    return f.tolerance.relative ? fmt::format("{:.3g} %", 100.0 * value)
                                : fmt::format("{:.3g} {}", value, f.unit);
  };
  for (const Finding* f : findings) {
    out += fmt::format(
        "<tr class='{}'><td>{}<td>{}<td class=n>{:.6g} {}<td>{}: {}<td class=n>{:.6g}<td class=n>{}"
        "<td>{}: {}<td>{}{}</tr>\n",
        f->pass() ? "yes" : "no", scree::xml_escaped(f->case_name), scree::xml_escaped(f->quantity),
        f->reference, scree::xml_escaped(f->unit), name(f->source.origin), scree::xml_escaped(f->source.text),
        f->simulated, error(*f, f->error()), error(*f, f->tolerance.size),
        scree::xml_escaped(f->tolerance.grounds), f->pass() ? "yes" : "<b>no</b> ",
        scree::xml_escaped(f->reason));
  }
  out += "</table>\n<h2>Not compared</h2>\n<ul>\n";
  for (const Outcome& o : outcomes) {
    for (const std::string& note : o.notes) {
      out += "<li>" + scree::xml_escaped(note) + "</li>\n";
    }
  }
  out += "</ul>\n<h2>Curves</h2>\n";
  for (const Outcome& o : outcomes) {
    for (const Chart& c : o.charts) {
      out += svg_chart(c);
    }
  }
  return out + "</body></html>\n";
}

} // namespace validation
