/// \file
/// Case 2 of Dosta et al. (2024): 30 000 small and 8000 large beads mix in a drum that turns at 2 rad/s.

#include "cases.hpp"
#include "dosta.hpp"

#include "scree/simulation/run.hpp"

#include <array>

namespace validation {

namespace {

/// What is counted and summed up, as the codes' tables name it and in words. LIGGGHTS gives no centres.
struct Column {
  const char *key, *label;
};
constexpr std::array<Column, 8> columns{{{"z1_m1", "small beads in zone 1"},
                                         {"z1_m2", "large beads in zone 1"},
                                         {"z2_m1", "small beads in zone 2"},
                                         {"z2_m2", "large beads in zone 2"},
                                         {"com_m1_x", "centre of the small beads, x"},
                                         {"com_m1_z", "centre of the small beads, z"},
                                         {"com_m2_x", "centre of the large beads, x"},
                                         {"com_m2_z", "centre of the large beads, z"}}};
constexpr std::size_t zones = 4;

/// The columns over time [s]: numbers of beads and centres of mass [m].
struct Mixing {
  std::vector<double> time;
  std::array<std::vector<double>, columns.size()> values;
  double work = 0.0; ///< beads times steps

  /// Zone 1 is where x and z are above 0, zone 2 where both are below.
  template <class Bodies>
  void add(double t, const Bodies& bodies, scree::MaterialId m1) {
    std::array<double, columns.size()> sum{};
    std::array<double, 2> number{};
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      const auto at = bodies.position(b);
      const std::size_t kind = bodies.material(b) == m1 ? 0 : 1;
      if (at.x() > 0.0 && at.z() > 0.0) {
        ++sum[kind];
      } else if (at.x() < 0.0 && at.z() < 0.0) {
        ++sum[2 + kind];
      }
      sum[zones + 2 * kind] += at.x();
      sum[zones + 2 * kind + 1] += at.z();
      ++number[kind];
    }
    time.push_back(t);
    for (std::size_t k = 0; k < columns.size(); ++k) {
      values[k].push_back(k < zones ? sum[k] : sum[k] / number[(k - zones) / 2]);
    }
  }

  [[nodiscard]] Series series(std::size_t column) const {
    return {"scree", Origin::code, time, values[column]};
  }
};

struct Size {
  double softness;              ///< share of the paper's moduli
  double end;                   ///< s
  std::vector<double> instants; ///< s, at which is compared
};

Mixing mix_in_drum(const Inputs& inputs, const Size& size) {
  // The step of a dense bed whose beads meet at 0.1 m/s. One that falls faster is outside the bed, where a
  // contact stands a step more than twice as long (simulation/stable_step.hpp).
  scree::Simulation<dosta::Bulk<float>> sim{
      {.step_safety = 1.0, .top_speed = 0.1, .threads = inputs.threads}};
  const dosta::Materials of = dosta::add_materials(sim, size.softness);
  // The wall rises where x is above 0.
  sim.add_wall(
      {.name = "drum",
       .surfaces = {{dosta::read_mesh(inputs.file("dosta2024/initial/Drum_walls.txt.gz")), of.steel}},
       .dynamics = scree::Prescribed::constant_rotation({0.0, -2.0, 0.0})});
  const auto ball = scree::make_clump("ball", std::vector<scree::Sphere>{{scree::Vector::Zero(), 1.0}});
  for (const scree::Sphere& bead :
       dosta::read_spheres(inputs.file("dosta2024/initial/Drum_PartCoordinates.txt.gz"))) {
    sim.add({.clump = &ball,
             .material = bead.radius < 0.0015 ? of.m1 : of.m2,
             .position = bead.centre,
             .scale = bead.radius});
  }
  Mixing mixing;
  mixing.add(0.0, sim.bodies(), of.m1);
  constexpr double interval = 0.025;
  while (mixing.time.back() < size.end - 0.5 * interval) {
    scree::run_for(sim, interval * static_cast<double>(mixing.time.size()) - sim.time());
    mixing.add(sim.time(), sim.bodies(), of.m1);
  }
  mixing.work = static_cast<double>(sim.steps()) * static_cast<double>(sim.bodies().size());
  return mixing;
}

/// The codes that have a column, to the last row but one: MUSEN's last counts many beads twice.
std::vector<Series> curves(const std::vector<dosta::Code>& codes, std::size_t column) {
  std::vector<Series> found;
  for (const dosta::Code& code : codes) {
    const auto& names = code.table.columns;
    if (std::find(names.begin(), names.end(), columns[column].key) != names.end()) {
      found.push_back(code.series(columns[column].key));
      found.back().x.pop_back();
      found.back().y.pop_back();
    }
  }
  return found;
}

} // namespace

/// The paper's beads, drum and coordinates.
Outcome dosta_drum(const Inputs& inputs) {
  const std::string name = "Dosta et al. 2, rotating drum";
  if (inputs.reference.empty()) {
    return dosta::no_reference(name, "the beads, the drum and the codes' curves");
  }
  const Size size =
      inputs.full ? Size{1.0, 4.9, {0.1, 0.2, 0.3, 0.5, 0.7, 1.0, 1.5, 2.0}} : Size{0.2, 0.1, {0.1}};
  const auto codes = dosta::read_codes(inputs, "case2");
  const dosta::Stopwatch watch;
  const Mixing mixing = mix_in_drum(inputs, size);
  const double seconds = watch.seconds();

  Outcome out;
  for (const double t : size.instants) {
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const double scale = k < zones ? 1.0 : 1e3; // mm
      const bool vertical = k >= zones && (k - zones) % 2 == 1;
      std::vector<double> theirs;
      for (const Series& curve : curves(codes, k)) {
        theirs.push_back(scale * value_at(curve, t));
      }
      const double found = scale * value_at(mixing.series(k), t);
      const double crossed = std::abs(theirs.front() - mixing.values[k].front());
      if ((k < zones && crossed < 100.0) || (vertical && size.softness < 1.0)) {
        continue; // too few to say anything; softer beads lie lower
      }
      const std::string quantity = fmt::format("{} at {:.1f} s", columns[k].label, t);
      if (k < zones) {
        dosta::add_within_codes(out, name, quantity, "beads", theirs, found, 3.0 * std::sqrt(crossed),
                                "three roots of the number that has come or gone");
      } else {
        dosta::add_within_codes(out, name, quantity, "mm", theirs, found);
      }
    }
  }
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const auto [least, most] = std::minmax_element(mixing.values[k].begin(), mixing.values[k].end());
    if (*least == *most) {
      continue; // a zone that is still empty
    }
    Chart chart{fmt::format("dosta_drum_{}", columns[k].key),
                name,
                "time, s",
                fmt::format("{}{}", columns[k].label, k < zones ? "" : ", m"),
                {},
                {}};
    for (Series curve : curves(codes, k)) {
      const auto shown = static_cast<std::size_t>(
          std::upper_bound(curve.x.begin(), curve.x.end(), 1.5 * size.end) - curve.x.begin());
      curve.x.resize(shown);
      curve.y.resize(shown);
      chart.references.push_back(curve);
    }
    chart.simulated.push_back(mixing.series(k));
    out.draw(chart);
  }
  // LIGGGHTS: 5 s in steps of 8e-7 s.
  out.notes.push_back(dosta::speed_note(inputs, mixing.work, seconds, "case2_liggghts", 38000 * 5.0 / 8e-7));
  out.notes.emplace_back(name + ": single precision velocities and forces and the time step are ours; zone 1 "
                                "is where x and z are above 0, zone 2 where both are below");
  if (!inputs.full) {
    out.notes.emplace_back(name +
                           ": the first 0.1 s with moduli of 20 % of the paper's (ours), so heights are "
                           "not compared; 4.9 s with the paper's at full size");
  }
  return out;
}

} // namespace validation
