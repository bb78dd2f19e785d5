#include "report.hpp"

#include "scree/io/csv.hpp"
#include "support/plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace paper_gap {

using namespace scree;

namespace {

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
          row.push_back(Mean{values}.value);
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

} // namespace

std::string write_tables(const Report& report, const std::filesystem::path& folder) {
  write_runs(report, folder / "runs.csv");
  write_effects(report, folder / "effects.csv");
  return write_curves(report, folder);
}

} // namespace paper_gap
