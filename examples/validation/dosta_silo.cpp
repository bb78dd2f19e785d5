/// \file
/// Case 1 of Dosta et al. (2024): beads run out of a silo through an orifice of 60 mm.

#include "cases.hpp"
#include "dosta.hpp"

#include "scree/core/random.hpp"
#include "scree/simulation/run.hpp"

#include <numbers>

namespace validation {

namespace {

namespace shape = scree::tessellation;

/// The silo with the large orifice, a barrel on a cone, and its beads of M1, as in the driver of MercuryDPM
/// and in walls.txt [m].
struct Silo {
  double radius = 0.1, orifice = 0.03;
  double lip = -0.0554222, shoulder = 0.0145778;
  double bead = 0.002;

  /// Of the inside at a height.
  [[nodiscard]] double radius_at(double z) const {
    return z < shoulder ? orifice + (radius - orifice) * (z - lip) / (shoulder - lip) : radius;
  }

  [[nodiscard]] scree::TriangleMesh cone() const {
    constexpr std::size_t sides = 100, rows = 20; // the sides of walls.txt; facets about as long as wide
    const auto ring = [&](std::size_t row) {
      const double z = lip + (shoulder - lip) * static_cast<double>(row) / rows;
      shape::Polyline points;
      for (std::size_t k = 0; k <= sides; ++k) {
        const double angle = 2.0 * std::numbers::pi * static_cast<double>(k % sides) / sides;
        points.emplace_back(radius_at(z) * std::cos(angle), radius_at(z) * std::sin(angle), z);
      }
      return points;
    };
    scree::TriangleMesh mesh;
    for (std::size_t row = 0; row < rows; ++row) {
      shape::add_strip(mesh, ring(row), ring(row + 1));
    }
    return scree::weld(mesh, 1e-9);
  }

  template <class Simulation>
  void build(Simulation& sim, scree::MaterialId steel) const {
    sim.add_wall(
        {.name = "silo",
         .surfaces = {{cone(), steel},
                      {scree::Cylinder{{0.0, 0.0, shoulder}, scree::Vector::UnitZ(), radius}, steel}},
         .dynamics = scree::Fixed{}});
  }
};

struct Size {
  std::size_t beads;      ///< at the start
  double from, to, until; ///< beads left while the rate is measured, and when the run ends
  double softness;        ///< share of the paper's moduli
  unsigned threads;
};

using Beads = scree::Simulation<dosta::Bulk<float>>;

/// The step of a dense bed whose beads meet at 0.1 m/s. Those that fall faster are outside the bed, where a
/// contact stands a step more than twice as long (simulation/stable_step.hpp).
scree::Setup<dosta::Bulk<float>> setup(const Size& size) {
  return {.neighbours = {.share = 0.5}, .step_safety = 1.0, .top_speed = 0.1, .threads = size.threads};
}

/// Beads on a lattice with gaps of 5 % of a diameter, shaken by as much.
void place(const Silo& silo, std::size_t count, const scree::Clump& ball, scree::MaterialId of, Beads& sim) {
  scree::Random random{1, "dosta silo"};
  const double gap = 0.05 * 2.0 * silo.bead, pitch = 2.0 * silo.bead + gap;
  for (double z = silo.lip + 0.6 * pitch; sim.bodies().size() < count; z += pitch) {
    // A bead at 45 degrees to the cone is the root of two radii away from it in a level.
    const double room = silo.radius_at(z - 0.5 * pitch) - 1.5 * silo.bead;
    const double first = -std::floor(room / pitch) * pitch;
    for (double y = first; y < room; y += pitch) {
      for (double x = first; x < room && sim.bodies().size() < count; x += pitch) {
        if (std::hypot(x, y) < room) {
          const auto off = [&] { return random.uniform(-0.5 * gap, 0.5 * gap); };
          const double dx = off(), dy = off(), dz = off();
          sim.add({.clump = &ball, .material = of, .position = {x + dx, y + dy, z + dz}, .scale = silo.bead});
        }
      }
    }
  }
}

/// Where the beads come to rest in the closed silo. The paper's own fillings are not in the reference data.
std::vector<scree::Vector> fill(const Silo& silo, const Size& size) {
  Beads sim{setup(size)};
  sim.set_local_damping(0.3);
  const dosta::Materials of = dosta::add_materials(sim, size.softness);
  silo.build(sim, of.steel);
  sim.add_wall({.name = "plug",
                .surfaces = {{scree::Plane{{0.0, 0.0, silo.lip}, scree::Vector::UnitZ()}, of.steel}},
                .dynamics = scree::Fixed{}});
  const auto ball = scree::make_clump("ball", std::vector<scree::Sphere>{{scree::Vector::Zero(), 1.0}});
  place(silo, size.beads, ball, of.m1, sim);
  // Slow beside the 0.5 m/s at which they will leave.
  double mean_speed = 1.0;
  const auto look = [&](const auto& s) {
    mean_speed = 0.0;
    for (std::size_t b = 0; b < s.bodies().size(); ++b) {
      mean_speed += s.bodies().velocity(b).norm() / static_cast<double>(s.bodies().size());
    }
  };
  scree::run_while(
      sim, [&](const auto& s) { return s.time() < 0.05 || (mean_speed > 0.01 && s.time() < 0.5); },
      scree::Every{0.01, look});
  std::vector<scree::Vector> centres;
  for (std::size_t b = 0; b < sim.bodies().size(); ++b) {
    centres.push_back(sim.bodies().position(b));
  }
  return centres;
}

struct Discharge {
  Series left; ///< beads above the orifice, over s
  double work; ///< beads times steps
};

Discharge run_out(const Silo& silo, const std::vector<scree::Vector>& centres, const Size& size) {
  Beads sim{setup(size)};
  const dosta::Materials of = dosta::add_materials(sim, size.softness);
  silo.build(sim, of.steel);
  const auto ball = scree::make_clump("ball", std::vector<scree::Sphere>{{scree::Vector::Zero(), 1.0}});
  for (const scree::Vector& centre : centres) {
    sim.add({.clump = &ball, .material = of.m1, .position = centre, .scale = silo.bead});
  }
  Discharge found{{"scree", Origin::code, {0.0}, {static_cast<double>(centres.size())}}, 0.0};
  std::size_t counted = 0;
  const auto count = [&](auto& s) {
    std::size_t above = 0;
    for (std::size_t b = 0; b < s.bodies().size(); ++b) {
      above += s.bodies().position(b).z() > silo.lip ? 1 : 0;
    }
    found.left.x.push_back(s.time());
    found.left.y.push_back(static_cast<double>(above));
    found.work += static_cast<double>(s.bodies().size()) * static_cast<double>(s.steps() - counted);
    counted = s.steps();
    // Two and a half diameters below the orifice nothing holds them any more.
    s.remove_bodies([&](const auto& bodies, std::size_t b) {
      return bodies.position(b).z() < silo.lip - 5.0 * silo.bead;
    });
  };
  scree::run_while(
      sim, [&](const auto& s) { return found.left.y.back() > size.until && s.time() < 6.0; },
      scree::Every{0.005, count});
  return found;
}

/// When `beads` are left [s].
double time_of(const Series& left, double beads) {
  std::size_t k = 1;
  while (k + 1 < left.y.size() && left.y[k] > beads) {
    ++k;
  }
  const double share = (left.y[k - 1] - beads) / (left.y[k - 1] - left.y[k]);
  return left.x[k - 1] + share * (left.x[k] - left.x[k - 1]);
}

/// Beads in a second while `from` to `to` are left.
double rate(const Series& left, double from, double to) {
  return (from - to) / (time_of(left, to) - time_of(left, from));
}

/// Of the mean rate, from the scatter of its parts.
double standard_error(const Series& left, const Size& size) {
  constexpr int parts = 8; // of 20 ms or more, in which a bead falls by its diameter
  double mean = 0.0, square = 0.0;
  for (int p = 0; p < parts; ++p) {
    const double step = (size.from - size.to) / parts;
    const double part = rate(left, size.from - p * step, size.from - (p + 1) * step);
    mean += part / parts;
    square += part * part / parts;
  }
  return std::sqrt(std::max(0.0, square - mean * mean) / (parts - 1));
}

/// The curve from where `from` beads are left to where `until` are, over the time since.
Series since(const Series& left, const Size& size) {
  Series shown{left.label, left.origin, {}, {}};
  const double start = time_of(left, size.from);
  for (std::size_t k = 0; k < left.x.size(); ++k) {
    if (left.y[k] <= size.from && left.y[k] >= size.until) {
      shown.x.push_back(left.x[k] - start);
      shown.y.push_back(left.y[k]);
    }
  }
  return shown;
}

} // namespace

/// The rate does not depend on the filling but through what is left (Beverloo), so a lower filling is
/// compared while as many beads are left as in the codes' runs from 100 000.
Outcome dosta_silo(const Inputs& inputs) {
  const std::string name = "Dosta et al. 1, silo, large orifice, M1";
  if (inputs.reference.empty()) {
    return dosta::no_reference(name, "the codes' curves");
  }
  const Size size = inputs.full ? Size{100000, 90000.0, 20000.0, 500.0, 1.0, inputs.threads}
                                : Size{25000, 23500.0, 20000.0, 19900.0, 0.01, inputs.threads};
  const Silo silo;
  const auto centres = fill(silo, size);
  const dosta::Stopwatch watch;
  const Discharge found = run_out(silo, centres, size);
  const double seconds = watch.seconds();

  Outcome out;
  const auto codes = dosta::read_codes(inputs, "case1_large_M1");
  std::vector<double> theirs;
  Chart chart{"dosta_silo", name, fmt::format("time since {:.0f} were left, s", size.from),
              "beads left", {},   {}};
  for (const dosta::Code& code : codes) {
    theirs.push_back(rate(code.series("count"), size.from, size.to));
    chart.references.push_back(since(code.series("count"), size));
  }
  dosta::add_within_codes(out, name,
                          fmt::format("discharge while {:.0f} to {:.0f} are left", size.from, size.to), "1/s",
                          theirs, rate(found.left, size.from, size.to),
                          3.0 * standard_error(found.left, size), "three standard errors of eight parts");
  chart.simulated.push_back(since(found.left, size));
  out.draw(chart);
  // LIGGGHTS: steps of 1.5e-6 s, with what is left of 100 000 beads.
  const Series& of_liggghts = codes.front().series("count");
  double work = 0.0;
  for (std::size_t k = 1; k < of_liggghts.x.size(); ++k) {
    work += of_liggghts.y[k] * (of_liggghts.x[k] - of_liggghts.x[k - 1]) / 1.5e-6;
  }
  out.notes.push_back(dosta::speed_note(inputs, found.work, seconds, "case1_large_M1_liggghts", work));
  out.notes.push_back(name +
                      ": the filling, the time step, single precision velocities and forces are ours; the "
                      "paper's filling is not in the reference data");
  if (!inputs.full) {
    out.notes.emplace_back(name +
                           ": 25 000 of 100 000 beads with moduli of 1 % of the paper's (ours); all with "
                           "the paper's at full size");
  }
  return out;
}

} // namespace validation
