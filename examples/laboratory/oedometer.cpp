#include "laboratory/experiment.hpp"
#include "support/recipe_options.hpp"

#include "scree/compare/stiffness.hpp"
#include "scree/io/csv.hpp"
#include "scree/laboratory/oedometer.hpp"
#include "scree/laboratory/oedometer_branches.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

namespace scree::examples {

namespace {

void write_curve(const std::filesystem::path& folder, const OedometerResult& r, double area) {
  CsvWriter curve{folder / "oedometer.csv",
                  {"time_s", "displacement_m", "strain", "lid_force_N", "lid_stress_Pa", "base_force_N",
                   "mantle_force_N", "cycle", "loading"},
                  "Zero where the lid carried the low load first; forces are means between two rows."};
  for (const OedometerPoint& p : r.curve) {
    curve.row({p.time, p.displacement, p.displacement / r.height, p.lid_force, p.lid_force / area,
               p.base_force, p.mantle_force, static_cast<double>(p.cycle + 1), p.loading ? 1.0 : 0.0});
  }
}

/// The branches that a curve is looked at in, by name.
constexpr std::array branches{"loading", "unloading", "reloading"};
/// Stresses between which a branch is cut into pieces, over the highest; ours.
constexpr double lowest_level = 0.1, highest_level = 0.98;

/// Strains of each piece of the first loading, the first unloading and the second loading; not a number for
/// a branch that there is not. \param pieces of each branch, between stresses that grow by the same factor
std::vector<double> strains_of_pieces(std::span<const OedometerPoint> rows, std::size_t pieces, double height,
                                      double highest_force) {
  std::array<StressStrain, branches.size()> curve;
  const OedometerPoint* turn = nullptr; // the last of the branch before
  for (const OedometerPoint& p : rows) {
    const std::size_t branch = p.cycle == 0 ? (p.loading ? 0 : 1) : 2;
    if (p.cycle > 1 || (p.cycle == 1 && !p.loading)) {
      break;
    }
    if (turn != nullptr && curve[branch].stress.empty()) {
      curve[branch].stress.push_back(turn->lid_force / highest_force);
      curve[branch].strain.push_back(turn->displacement / height);
    }
    curve[branch].stress.push_back(p.lid_force / highest_force);
    curve[branch].strain.push_back(p.displacement / height);
    turn = &p;
  }
  std::vector<double> out;
  for (const StressStrain& branch : curve) {
    for (std::size_t k = 0; k < pieces; ++k) {
      const auto level = [&](std::size_t n) {
        return lowest_level *
               std::pow(highest_level / lowest_level, static_cast<double>(n) / static_cast<double>(pieces));
      };
      out.push_back(branch.stress.empty() ? std::numeric_limits<double>::quiet_NaN()
                                          : strain_at(branch, level(k + 1)) - strain_at(branch, level(k)));
    }
  }
  return out;
}

/// In the order of the observables, without the pieces of the curve; not a number where there is no
/// unloading.
std::vector<double> observables_of(const std::vector<OedometerCycle>& cycles, double height) {
  const auto full =
      std::find_if(cycles.rbegin(), cycles.rend(), [](const OedometerCycle& c) { return c.unloaded; });
  const bool any = full != cycles.rend();
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  return {cycles.back().modulus,
          cycles.front().modulus,
          any ? full->unloading_modulus : none,
          cycles.front().compressed / height,
          any ? full->hysteresis : none,
          cycles.front().base_share};
}

class OedometerExperiment final : public Experiment {
public:
  explicit OedometerExperiment(bool desk) {
    if (desk) {
      setup_ = desk_oedometer();
    }
  }

  void bind(Options& options) override {
    options.group("Container and lid");
    const auto source = [](double value, double of_paper) {
      return value == of_paper ? Provenance::paper : Provenance::ours;
    };
    const RoundContainer paper{};
    options.add("container.radius", setup_.container.radius, {0.001, 100.0, "m"}, "of the tube",
                source(setup_.container.radius, paper.radius));
    options.add("container.height", setup_.container.height, {0.001, 100.0, "m"}, "to which it is filled",
                source(setup_.container.height, paper.height));
    options.add("load.low_stress", setup_.low_stress, {1e-3, 1e12, "Pa"},
                "on the lid, at the end of unloading");
    options.add("load.high_stress", setup_.high_stress, {1e-3, 1e12, "Pa"}, "at the end of loading");
    options.add("load.cycles", setup_.cycles, {1.0, 1000.0}, "loadings");
    options.add("load.strain_rate", setup_.strain_rate, {1e-9, 1e3, "1/s"}, "of the lid");
    options.add("load.most_inertial_number", setup_.most_inertial_number, {1e-9, 1e3},
                "above which it is refused, as not quasi-static");
    options.add("load.approach", setup_.approach, {1.0, 1e3},
                "times as fast the lid comes down on the grains");
    options.add("load.approach_to", setup_.approach_to, {1e-6, 1.0},
                "share of the low stress up to which it does");
    options.add("load.seated", setup_.seated,
                "grains keep the friction that they were poured with until the lid carries the low load");
    options.add("load.slope_from", setup_.slope_from, {0.0, 1.0},
                "share of the way to high load at which the slope begins");
    options.add("load.slope_to", setup_.slope_to, {0.0, 1.0}, "and ends");
    options.add("load.points", setup_.points, {10.0, 1e6}, "of the curve, in each branch");
    options.add(
        "specimen.height", measured_height_, {0.0, 100.0, "m"},
        "of the specimen when it carried the low load first, for measured curves; 0: the container's");
    options.add("load.pieces", pieces_, {0.0, 20.0},
                "of first loading, unloading and reloading, whose strains are observables too; 0: none");
    bind_fill(options, setup_.fill);
  }
  std::vector<Observable> observables() const override {
    std::vector<Observable> out{{"modulus_Pa"}, {"first_modulus_Pa"},    {"unloading_modulus_Pa"},
                                {"settlement"}, {"hysteresis_J", false}, {"base_share"}};
    for (const char* branch : branches) {
      for (std::size_t k = 1; k <= pieces_; ++k) {
        out.push_back({message(branch, "_", k)});
      }
    }
    return out;
  }
  CurveFile curve() const override {
    return {"oedometer.csv", "displacement_m", "lid_force_N", "Load on the lid", "displacement, m", "N"};
  }
  std::vector<double> observe(const Conditions& conditions,
                              const std::filesystem::path& folder) const override {
    return detail::with_physics_of(conditions, [&]<class Model>(const Setup<Model>& physics) {
      Oedometer<Model> oedometer{detail::prepared(setup_, conditions), physics};
      const OedometerResult& r = oedometer.run(detail::limited(conditions));
      if (!folder.empty()) {
        write_curve(folder, r, setup_.container.area());
      }
      return all_observables_of(r.cycles, r.curve, r.height);
    });
  }
  std::vector<double> reduce(const CsvTable& curve) const override {
    const double area = setup_.container.area(), low = setup_.low_stress * area,
                 range = setup_.high_stress * area - low;
    auto all = oedometer_branches(curve.column("displacement_m"), curve.column("lid_force_N"), 0.2 * range);
    const bool with_base =
        std::find(curve.columns.begin(), curve.columns.end(), "base_force_N") != curve.columns.end();
    for (std::size_t k = 0; k < all.size(); ++k) {
      all[k].base_force =
          with_base ? curve.column("base_force_N")[k] : std::numeric_limits<double>::quiet_NaN();
    }
    // Zero where the low load is carried first, as in the simulation.
    const auto begin =
        std::find_if(all.begin(), all.end(), [&](const auto& p) { return p.lid_force >= low; });
    if (begin == all.end()) {
      throw Error(message(curve.file.string(), ": the force never reaches the low load of ", low, " N"));
    }
    std::vector<OedometerPoint> rows{begin, all.end()};
    const double zero = begin->displacement;
    for (OedometerPoint& p : rows) {
      p.displacement -= zero;
    }
    const SlopeWindow window{.low_force = low + setup_.slope_from * range,
                             .high_force = low + setup_.slope_to * range,
                             .height = measured_height_ > 0.0 ? measured_height_ : setup_.container.height,
                             .area = area};
    std::vector<OedometerCycle> cycles;
    for (std::size_t c = 0; c <= rows.back().cycle; ++c) {
      cycles.push_back(oedometer_cycle(rows, c, window));
    }
    return all_observables_of(cycles, rows, window.height);
  }
  void show(Workbench& bench) const override {
    Oedometer<> oedometer{detail::prepared(setup_, detail::conditions_of(bench)),
                          {.step_safety = bench.step_safety()}};
    const OedometerResult& r = bench.run(oedometer, setup_.container.domain());
    write_curve(bench.folder(), r, setup_.container.area());
    auto& summary = bench.summary();
    summary["slope_N_m"] = r.slope;
    const auto observed = all_observables_of(r.cycles, r.curve, r.height);
    const auto names = observables();
    for (std::size_t k = 0; k < names.size(); ++k) {
      summary[names[k].name] = observed[k];
    }
    summary["inertial_number"] = r.inertial_number;
    summary["height_m"] = r.height;
    summary["grains"] = r.fill.kept;
    summary["bulk_density_kg_m3"] = r.fill.bulk_density;
    for (const OedometerCycle& c : r.cycles) {
      auto& of_cycle = summary["cycles"].emplace_back();
      of_cycle = {{"slope_N_m", c.slope},
                  {"slope_standard_error_N_m", c.slope_error},
                  {"modulus_Pa", c.modulus},
                  {"compressed_m", c.compressed}};
      if (c.unloaded) {
        of_cycle["unloading_modulus_Pa"] = c.unloading_modulus;
        of_cycle["permanent_m"] = c.permanent;
        of_cycle["hysteresis_J"] = c.hysteresis;
      }
    }
    if (r.cycles.size() > 1) {
      summary["last_change_of_modulus"] = r.modulus / r.cycles[r.cycles.size() - 2].modulus - 1.0;
    }
    summarise_fill(summary, r.fill);
    bench.plot(
        "oedometer", bench.title("Confined compression"),
        {{"Load on the lid",
          "displacement, m",
          "N",
          {{"oedometer.csv", "displacement_m", "lid_force_N", "lid"},
           {"oedometer.csv", "displacement_m", "base_force_N", "base"}}},
         {"Stress and strain", "strain", "Pa", {{"oedometer.csv", "strain", "lid_stress_Pa", "lid"}}}});
    const double radius = setup_.container.radius, lid = oedometer.lid_height();
    bench.view("oedometer_view", oedometer.simulation(),
               {Vector{-radius, -radius, 0.0}, Vector{radius, radius, lid}}, true,
               fmt::format("lid at {:.1f} mm, {:.0f} N", 1e3 * lid, r.curve.back().lid_force),
               [&](auto& renderer) {
                 for (const double x : {-radius, radius}) {
                   renderer.line({x, 0.0, 0.0}, {x, 0.0, 1.1 * lid}, {90, 90, 90});
                 }
                 for (const double z : {0.0, lid}) {
                   renderer.line({-radius, 0.0, z}, {radius, 0.0, z}, {90, 90, 90}, 3.0);
                 }
               });
    bench.finish(oedometer.simulation());
    fmt::print("slope {:.4g} N/m, modulus {:.4g} Pa, inertial number {:.2g}\n", r.slope, r.modulus,
               r.inertial_number);
  }

private:
  [[nodiscard]] std::vector<double> all_observables_of(const std::vector<OedometerCycle>& cycles,
                                                       std::span<const OedometerPoint> rows,
                                                       double height) const {
    std::vector<double> out = observables_of(cycles, height);
    if (pieces_ > 0) {
      const auto strains =
          strains_of_pieces(rows, pieces_, height, setup_.high_stress * setup_.container.area());
      out.insert(out.end(), strains.begin(), strains.end());
    }
    return out;
  }

  OedometerSetup setup_;
  double measured_height_ = 0.0;
  std::uint64_t pieces_ = 0;
};

} // namespace

std::unique_ptr<Experiment> detail::make_oedometer(bool desk) {
  return std::make_unique<OedometerExperiment>(desk);
}

} // namespace scree::examples
