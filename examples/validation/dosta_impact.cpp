/// \file
/// Case 3 of Dosta et al. (2024): a steel ball strikes a bed of 25 000 or 50 000 beads at 5 m/s.

#include "cases.hpp"
#include "dosta.hpp"

#include "scree/neighbours/r_tree.hpp"
#include "scree/simulation/run.hpp"

namespace validation {

namespace {

constexpr double ball_radius = 0.01, drop_height = 0.06, drop_speed = 5.0, g = 9.81;

/// Where the ball is if nothing is in its way [m].
double free_fall(double t) {
  return drop_height - drop_speed * t - 0.5 * g * t * t;
}

/// A bed of the paper and what is asked of it; times in s.
struct Bed {
  std::string size;             ///< in the names of the files
  double start, end;            ///< the ball is let go in free fall, and watched
  std::vector<double> instants; ///< at which heights are compared
  bool deepest;                 ///< whether it gets that far
};

struct Fall {
  Series height; ///< m, over s
  double work;   ///< beads times steps
  double step;   ///< s
};

Fall fall_into(const std::vector<scree::Sphere>& beads, const Bed& bed, unsigned threads) {
  // The stable step for impacts at 1 m/s, 1.1e-6 s; the paper takes 5e-7 s. With that for 5 m/s, 6.2e-7 s,
  // the ball is within 0.04 mm of where it is now until 28 ms.
  scree::Simulation<dosta::Bulk<double, scree::RTree>> sim{{.neighbours = {.share = 0.6},
                                                            .gravity = {0.0, 0.0, -g},
                                                            .step_safety = 1.0,
                                                            .top_speed = 1.0,
                                                            .threads = threads}};
  const dosta::Materials of = dosta::add_materials(sim, 1.0);
  // The inside of the box of walls.txt. Its sides are 98 mm, not the paper's 100 mm, apart: so lie the beads.
  constexpr double x = 0.049, y = 0.03, bottom = -0.0902431;
  sim.add_wall({.name = "box",
                .surfaces = {{scree::Plane{{0.0, 0.0, bottom}, scree::Vector::UnitZ()}, of.steel},
                             {scree::Plane{{-x, 0.0, 0.0}, scree::Vector::UnitX()}, of.steel},
                             {scree::Plane{{x, 0.0, 0.0}, -scree::Vector::UnitX()}, of.steel},
                             {scree::Plane{{0.0, -y, 0.0}, scree::Vector::UnitY()}, of.steel},
                             {scree::Plane{{0.0, y, 0.0}, -scree::Vector::UnitY()}, of.steel}},
                .dynamics = scree::Fixed{}});
  const auto ball = scree::make_clump("ball", std::vector<scree::Sphere>{{scree::Vector::Zero(), 1.0}});
  for (const scree::Sphere& bead : beads) {
    sim.add({.clump = &ball, .material = of.m1, .position = bead.centre, .scale = bead.radius});
  }
  const auto id = sim.add({.clump = &ball,
                           .material = of.steel,
                           .position = {0.0, 0.0, free_fall(bed.start)},
                           .velocity = {0.0, 0.0, -drop_speed - g * bed.start},
                           .scale = ball_radius});
  Fall fall{{"scree", Origin::code, {}, {}}, 0.0, sim.time_step()};
  scree::run_for(sim, bed.end - bed.start, scree::Every{1e-4, [&](const auto& s) {
                                                          std::size_t b = 0;
                                                          while (s.bodies().id(b) != id) {
                                                            ++b;
                                                          }
                                                          fall.height.x.push_back(bed.start + s.time());
                                                          fall.height.y.push_back(s.bodies().position(b).z());
                                                        }});
  fall.work = static_cast<double>(sim.steps()) * static_cast<double>(sim.bodies().size());
  return fall;
}

/// LIGGGHTS' times begin at its first output, 99 steps of 5e-7 s after the start, as its free fall shows.
void put_right(std::vector<dosta::Code>& codes) {
  for (double& t : codes.front().table.data.front()) {
    t += 99 * 5e-7;
  }
}

void strike(const Inputs& inputs, const Bed& bed, Outcome& out) {
  const std::string name = "Dosta et al. 3, impact on a bed of " + bed.size;
  std::vector<dosta::Code> codes = dosta::read_codes(inputs, "case3_" + bed.size + "k");
  put_right(codes);
  const auto beads =
      dosta::read_spheres(inputs.file("dosta2024/initial/Penetration_" + bed.size + "KParticles.txt.gz"));
  const dosta::Stopwatch watch;
  const Fall fall = fall_into(beads, bed, inputs.threads);
  const double seconds = watch.seconds();

  for (const double t : bed.instants) {
    std::vector<double> theirs;
    for (const dosta::Code& code : codes) {
      theirs.push_back(1e3 * value_at(code.series("z"), t));
    }
    dosta::add_within_codes(out, name, fmt::format("height of the ball at {:.0f} ms", 1e3 * t), "mm", theirs,
                            1e3 * value_at(fall.height, t));
  }
  if (bed.deepest) {
    const auto lowest = [&](const Series& s) { return 1e3 * *std::min_element(s.y.begin(), s.y.end()); };
    std::vector<double> theirs;
    for (const dosta::Code& code : codes) {
      theirs.push_back(lowest(code.series("z")));
    }
    dosta::add_within_codes(out, name, "lowest height of the ball", "mm", theirs, lowest(fall.height));
  }
  Chart chart{"dosta_impact_" + bed.size, name, "time, ms", "height of the ball, mm", {}, {}};
  const auto in_ms = [&](Series series) {
    Series shown{series.label, series.origin, {}, {}};
    for (std::size_t k = 0; k < series.x.size(); ++k) {
      if (series.x[k] >= bed.start && series.x[k] <= bed.end) {
        shown.x.push_back(1e3 * series.x[k]);
        shown.y.push_back(1e3 * series.y[k]);
      }
    }
    return shown;
  };
  for (const dosta::Code& code : codes) {
    chart.references.push_back(in_ms(code.series("z")));
  }
  chart.simulated.push_back(in_ms(fall.height));
  out.draw(chart);
  // LIGGGHTS: 0.1 s in steps of 5e-7 s.
  out.notes.push_back(dosta::speed_note(inputs, fall.work, seconds, "case3_" + bed.size + "k_liggghts",
                                        2e5 * static_cast<double>(beads.size() + 1)));
}

} // namespace

/// The paper's moduli, densities, friction and restitution; its box and beds. The ball starts just above the
/// bed at the speed of its free fall, which needs no simulation. The rebound is not judged: the paper finds
/// it chaotic.
Outcome dosta_impact(const Inputs& inputs) {
  if (inputs.reference.empty()) {
    return dosta::no_reference("Dosta et al. 3", "the beds and the codes' curves");
  }
  Outcome out;
  // The ball meets the first bead of the small bed at 21.0 ms, of the deeper one at 14.5 ms.
  if (inputs.full) {
    strike(inputs, {"25", 0.0207, 0.1, {0.023, 0.024, 0.025, 0.026, 0.027, 0.028, 0.029}, true}, out);
    strike(inputs, {"50", 0.0135, 0.1, {0.018, 0.022, 0.026, 0.03, 0.034, 0.038}, true}, out);
  } else {
    // On the floor the grains below the ball decide; up to 27 ms it is 18 mm deep.
    strike(inputs, {"25", 0.0207, 0.02705, {0.023, 0.024, 0.025, 0.026, 0.027}, false}, out);
    out.notes.emplace_back(
        "Dosta et al. 3: until 27 ms; the floor, the rebound and the bed of 50 000 at full "
        "size");
  }
  out.notes.emplace_back(
      "Dosta et al. 3: the time step and the start of the ball at the end of its free fall "
      "are ours; the bed of 100 000 is not in the reference data");
  return out;
}

} // namespace validation
