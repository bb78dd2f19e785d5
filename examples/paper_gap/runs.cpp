#include "runs.hpp"

#include "support/default_simulation.hpp"
#include "support/degree.hpp"

#include "scree/core/monotone_cubic.hpp"
#include "scree/laboratory/digging_path.hpp"
#include "scree/laboratory/drag_test.hpp"

#include <utility>

namespace paper_gap {

using namespace scree;
using examples::degree;

namespace {

/// Makes a watcher of a run that ends it where it takes too long.
auto limited(double limit) {
  return [limit](const auto& simulation, const auto&...) {
    if (simulation.time() > limit) {
      throw Error(message("not done after ", limit, " s of simulated time"));
    }
  };
}

DragTestSetup setup_of(const Base& base, const Case& of, double dense_density) {
  const auto high = [&](std::size_t f) { return of.levels[f] > 0; };
  examples::RockOptions rock = base.rock;
  rock.set_mass_convention(high(4) ? MassConvention::union_of_spheres : MassConvention::sum_of_spheres);
  std::vector<std::string> remarks; // of the bucket, in the program `drag`
  DragTestSetup out{.sample = rock.sample(base.rig),
                    .rig = base.dragline.setup,
                    .bucket = base.dragline.bucket(remarks),
                    .interval = base.interval,
                    .seed = of.seed,
                    .threads = 1};
  out.rig.shaped_bed = !high(0);
  if (high(1)) {
    out.rig.bed.packing_friction *= base.dense_friction;
    out.sample.rock.density *= dense_density;
  }
  out.sample.rig.friction = high(2) ? base.friction_high : base.friction_low;
  out.rig.local_damping = high(3) ? base.damping : 0.0;
  return out;
}

BucketFloor floor_of(const Base& base) {
  std::vector<std::string> remarks;
  const BucketBody bucket = base.dragline.bucket(remarks);
  const Vector& centre = bucket.body.centre;
  return {base.path.heel - centre.x(), base.path.lip - centre.x(), -centre.z()};
}

template <class Test>
Outcome observed(Test test, const Base& base) {
  const DragTestResult& run = test.run(limited(base.limit));
  const double distance = base.dragline.setup.drag_distance;
  std::vector<DragRow> lifts = run.rows;
  for (std::size_t k = 0; k < lifts.size(); ++k) {
    lifts[k].force = run.curve[k].lift;
  }
  const DragPieces p = pieces_of(run.rows, distance, pieces);
  Outcome out{p.force,
              p.pitch,
              p.depth,
              p.mass,
              pieces_of(lifts, distance, pieces).force,
              run.bed.porosity,
              run.bed.bulk_density,
              static_cast<double>(run.bed.kept)};
  for (double& pitch : out.pitch) {
    pitch /= degree;
  }
  return out;
}

} // namespace

const char* name(Motion motion) {
  switch (motion) {
  case Motion::free:
    return "free on ropes";
  case Motion::measured:
    return "measured pitch, levels out";
  case Motion::measured_stays:
    return "measured pitch, stays";
  case Motion::simulated:
    return "pitch of the paper's DEM, levels out";
  case Motion::measured_sinks:
    return "measured pitch, levels out, as deep as the free bucket";
  }
  return "";
}

Base::Base(bool desk) : rock{desk}, rig{rock.rig()}, dragline{desk} {
  if (desk) {
    DragSetup& s = dragline.setup;
    s.bed_length = 1.75;
    s.bed_width = 0.36;
    s.bed_depth = 0.3;
    s.rope_stiffness = 2.5e4;
    rock.set_size_factor(1.6);
    rock.set_spring(5e4);
    rig.normal_stiffness = rig.shear_stiffness = 5e4;
  }
}

void Base::bind(examples::Options& options) {
  examples::bind(options, rock, rig);
  dragline.bind(options);
  options.group("Path that is replayed; places are shares of the drag distance");
  options.add("path.up", path.up, {0.0, 45.0, "degrees"}, "pitch at its most, before the bucket digs in",
              examples::Provenance::paper);
  options.add("path.up_at", path.up_at, {0.001, 0.9}, "where");
  options.add("path.measured", path.measured, {-45.0, 0.0, "degrees"}, "pitch measured a third of the way on",
              examples::Provenance::paper);
  options.add("path.simulated", path.simulated, {-45.0, 0.0, "degrees"}, "pitch of the paper's DEM there",
              examples::Provenance::paper);
  options.add("path.down_at", path.down_at, {0.002, 0.95}, "where", examples::Provenance::paper);
  options.add("path.end", path.end, {-45.0, 45.0, "degrees"}, "pitch at the end, unless it stays");
  options.add("path.heel", path.heel, {-100.0, 100.0, "m"},
              "rear end of the bucket's flat floor, in its frame: depth follows from pitch by it");
  options.add("path.lip", path.lip, {-100.0, 100.0, "m"}, "front end of the floor, likewise");
  options.group("Levels of the design");
  options.add("level.friction_low", friction_low, {0.0, 10.0}, "of bucket and trough");
  options.add("level.friction_high", friction_high, {0.0, 10.0}, "of bucket and trough");
  options.add("level.damping", damping, {0.0, 0.99}, "local, while the bucket digs, where it is on");
  options.add("level.dense_friction", dense_friction, {1e-3, 1.0},
              "times the rock's, while a dense bed is poured");
  options.group("Record");
  options.add("record.interval", interval, {1e-6, 10.0, "s"},
              "between two lines, over which forces are means");
  options.add("record.limit", limit, {1e-3, 1e6, "s"}, "of simulated time, beyond which a run has failed");
}

BucketPath path_of(const Base& base, const Case& of) {
  const PathWords& w = base.path;
  const double distance = base.dragline.setup.drag_distance;
  const double down = of.motion == Motion::simulated ? w.simulated : w.measured;
  const double end = of.motion == Motion::measured_stays ? down : w.end;
  if (!(w.down_at > w.up_at)) {
    throw Error(message("path.down_at = ", w.down_at, " must be above path.up_at = ", w.up_at));
  }
  // Beyond the end for the floor's length that the path may exceed it by.
  std::vector<double> at{0.0, w.up_at * distance, w.down_at * distance, distance, 2.0 * distance + 1.0};
  std::vector<double> angle{0.0, w.up, down, end, end};
  for (double& a : angle) {
    a *= degree;
  }
  const MonotoneCubic curve = monotone_cubic(std::move(at), std::move(angle));
  const auto pitch = [&](double drag) { return drag > 0.0 ? curve(drag) : 0.0; };
  if (of.motion != Motion::measured_sinks) {
    return digging_path(pitch, distance, floor_of(base));
  }
  if (of.free_depth.size() != pieces) {
    throw Error("the free bucket whose depth is asked for did not come to its end");
  }
  std::vector<PathPoint> points{{}};
  for (std::size_t k = 0; k < pieces; ++k) {
    const double drag = distance * (static_cast<double>(k) + 0.5) / pieces;
    points.push_back({drag, pitch(drag), of.free_depth.at(k)});
  }
  const double rise = 0.5 * (of.free_depth[pieces - 1] - of.free_depth[pieces - 2]);
  points.push_back({distance, pitch(distance), of.free_depth[pieces - 1] + rise});
  return BucketPath{points};
}

std::vector<double> Outcome::values() const {
  std::vector<double> out;
  for (const auto* curve : {&force, &pitch, &depth, &mass, &lift}) {
    out.insert(out.end(), curve->begin(), curve->end());
  }
  out.insert(out.end(), {porosity, bulk_density, grains});
  return out;
}

Outcome Outcome::from(const std::vector<double>& values) {
  Outcome out{};
  auto at = values.begin();
  for (auto* curve : {&out.force, &out.pitch, &out.depth, &out.mass, &out.lift}) {
    curve->assign(at, at + pieces);
    at += pieces;
  }
  out.porosity = *at++;
  out.bulk_density = *at++;
  out.grains = *at;
  return out;
}

Outcome dragged(const Base& base, Case of, double dense_density) {
  DragTestSetup setup = setup_of(base, of, dense_density);
  if (of.motion == Motion::free && of.levels[5] > 0) {
    of.motion = Motion::measured;
  }
  if (of.motion == Motion::free) {
    return observed(DragTest<>{std::move(setup)}, base);
  }
  return observed(DragTest<DefaultModel, PathHaul>{std::move(setup), {}, PathHaul{path_of(base, of)}}, base);
}

double bulk_density(const Base& base, bool dense, std::uint64_t seed) {
  Case of{.levels = {-1, dense ? 1 : -1, -1, -1, -1, -1}, .seed = seed};
  const DragTestSetup setup = setup_of(base, of, 1.0);
  DragSetup rig = setup.rig;
  rig.seed = seed;
  rig.threads = 1;
  rig.rock = setup.sample.rock;
  rig.steel = rig.floor = setup.sample.rig;
  rig.stiffness = setup.sample.stiffness;
  DragRig<DefaultModel> bed{rig, setup.bucket};
  return bed.make_bed(setup.sample.assembly, limited(base.limit)).bulk_density;
}

double depth_by_pitch(const Base& base, const Outcome& run, double share) {
  const double distance = base.dragline.setup.drag_distance;
  std::vector<double> at{0.0}, pitch{0.0};
  for (std::size_t k = 0; k < pieces; ++k) {
    at.push_back(distance * (static_cast<double>(k) + 0.5) / pieces);
    pitch.push_back(run.pitch[k] * degree);
  }
  at.push_back(2.0 * distance + 1.0);
  pitch.push_back(pitch.back());
  const MonotoneCubic curve = monotone_cubic(std::move(at), std::move(pitch));
  return digging_path([&](double drag) { return drag > 0.0 ? curve(drag) : 0.0; }, distance, floor_of(base))
      .at(share * distance)
      .depth;
}

} // namespace paper_gap
