#pragma once
/// \file
/// What the three cases of Dosta et al., "Comparing open-source DEM frameworks for simulations of common bulk
/// processes", Comput. Phys. Commun. 296:109066 (2024), share: materials, files and the spread of the codes.

#include "finding.hpp"
#include "gzip_text.hpp"
#include "number_rows.hpp"
#include "reference_curve.hpp"

#include "scree/contact/hertz_mindlin.hpp"
#include "scree/geometry/tessellation.hpp"
#include "scree/simulation/simulation.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace validation::dosta {

/// \tparam Number of velocities and forces \tparam Search for neighbours; the result is the same for any
template <class Number, class Search = scree::CellGrid>
struct Bulk : scree::DefaultModel {
  using Real = Number;
  using Contact = scree::HertzMindlin<>;
  using Neighbours = scree::VerletList<Search>;
  static constexpr bool energy_audit = false;
};

/// The paper's materials.
struct Materials {
  scree::MaterialId m1, m2, steel;
};

/// Adds the materials of the paper as MercuryDPM's drivers for it (Drivers/Papers/OSBenchmark) have them. A
/// pair's restitution and friction are its own, not mixed.
/// \param softness share of the moduli that is taken, 1 in the paper
template <class Simulation>
Materials add_materials(Simulation& sim, double softness) {
  const auto add = [&](const char* name, double density, double modulus) {
    return sim.add_material({.name = name,
                             .density = density,
                             .youngs_modulus = softness * modulus,
                             .poisson_ratio = 0.2,
                             .friction = 0.0});
  };
  const Materials m{add("M1", 2500.0, 1e9), add("M2", 2000.0, 5e8), add("steel", 7200.0, 2.1e11)};
  const auto pair = [&](scree::MaterialId a, scree::MaterialId b, double restitution, double friction) {
    sim.set_pair(a, b, {.friction = friction, .restitution = restitution});
  };
  pair(m.m1, m.m1, 0.5, 0.3);
  pair(m.m1, m.m2, 0.45, 0.2);
  pair(m.m2, m.m2, 0.4, 0.4);
  pair(m.m1, m.steel, 0.4, 0.2);
  pair(m.m2, m.steel, 0.4, 0.2);
  pair(m.steel, m.steel, 0.6, 0.5);
  return m;
}

/// Rows of `count` numbers below a header. A row of another length is left out: the impact's files end in
/// one for the steel ball, "5 0.01 0.01 0 0 0.06".
inline Rows read_rows(const std::filesystem::path& file, std::size_t count) {
  std::istringstream text{read_packed_text(file)};
  Rows rows = rows_of(text, count);
  if (rows.empty()) {
    throw scree::Error(scree::message(file.string(), ": has no rows of ", count, " numbers"));
  }
  return rows;
}

/// The spheres of an initial state.
inline std::vector<scree::Sphere> read_spheres(const std::filesystem::path& file) {
  std::vector<scree::Sphere> spheres;
  for (const auto& row : read_rows(file, 4)) {
    spheres.push_back({{row[1], row[2], row[3]}, row[0]});
  }
  return spheres;
}

/// Triangles as a mesh.
inline scree::TriangleMesh read_mesh(const std::filesystem::path& file) {
  scree::TriangleMesh mesh;
  for (const auto& row : read_rows(file, 9)) {
    scree::tessellation::add_triangle(mesh, {row[0], row[1], row[2]}, {row[3], row[4], row[5]},
                                      {row[6], row[7], row[8]});
  }
  // The coordinates have six digits: 1 um is their rounding.
  return scree::without_collapsed_facets(scree::weld(mesh, 1e-6));
}

/// What one of the codes found, as columns of a table.
struct Code {
  std::string name;
  scree::CsvTable table;

  [[nodiscard]] Series series(const std::string& y) const {
    const auto x = table.column("t"), values = table.column(y);
    return {name, Origin::code, {x.begin(), x.end()}, {values.begin(), values.end()}};
  }
};

/// The codes' curves of one case, e.g. "case2".
inline std::vector<Code> read_codes(const Inputs& inputs, const std::string& stem) {
  std::vector<Code> codes;
  for (const auto& [name, file] : {std::pair<std::string, std::string>{"LIGGGHTS", "liggghts"},
                                   {"MUSEN", "musen"},
                                   {"peclet, Hertz", "peclet_hertz"}}) {
    codes.push_back({name, scree::read_csv(inputs.file("dosta2024/" + stem + "_" + file + ".csv"))});
  }
  return codes;
}

/// Measures wall time.
class Stopwatch {
public:
  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Beads times steps in a second of wall time, beside LIGGGHTS on 24 ranks of a Threadripper PRO 5965WX.
/// \param key of the run in timings.json \param work of LIGGGHTS, beads times steps
inline std::string speed_note(const Inputs& inputs, double simulated, double seconds, const std::string& key,
                              double work) {
  const auto file = inputs.file("dosta2024/timings.json");
  const double theirs = nlohmann::json::parse(read_packed_text(file)).at(key).get<double>();
  return fmt::format(
      "{}: scree {:.2g} beads x steps in {:.0f} s of wall time, {:.2g}/s, threads {} (0: all); "
      "LIGGGHTS on 24 ranks {:.2g} in {:.0f} s, {:.2g}/s (timings.json; other machine, "
      "partly shared)",
      key, simulated, seconds, simulated / seconds, inputs.threads, work, theirs, work / theirs);
}

/// What is said where the reference data is not there.
inline Outcome no_reference(const std::string& name, const std::string& lacking) {
  Outcome out;
  out.notes.push_back(name + ": not run, " + lacking + " need the reference data");
  return out;
}

/// The range of what several codes found.
struct Range {
  double low, high;

  explicit Range(const std::vector<double>& values)
      : low{*std::min_element(values.begin(), values.end())},
        high{*std::max_element(values.begin(), values.end())} {}
  [[nodiscard]] double middle() const { return 0.5 * (low + high); }
  [[nodiscard]] double width() const { return high - low; }
};

/// Adds a finding beside the codes' range, which a further code may leave by its width.
/// \param noise of the simulated value itself, measured or counted, in its unit
/// \param of_noise where that comes from
inline void add_within_codes(Outcome& out, const std::string& name, const std::string& quantity,
                             const std::string& unit, const std::vector<double>& codes, double simulated,
                             double noise = 0.0, const std::string& of_noise = {}) {
  const Range range{codes};
  std::string grounds =
      fmt::format("range of the codes, {:.5g} to {:.5g}, widened by its width", range.low, range.high);
  if (noise > 0.0) {
    grounds += fmt::format(", and {:.2g} by {}", noise, of_noise);
  }
  out.add(name, quantity, unit, range.middle(),
          {Origin::code, "LIGGGHTS, MUSEN and peclet, case of Dosta et al. (2024), middle"}, simulated,
          {1.5 * range.width() + noise, false, grounds});
}

} // namespace validation::dosta
