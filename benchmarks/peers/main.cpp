// What run.sh needs in C++: makes the beds, times scree, checks that two codes compute the same, makes the
// tables.

#include "bed_file.hpp"
#include "goals.hpp"
#include "rows.hpp"
#include "same_results.hpp"
#include "timed_steps.hpp"

#include "scree/io/stl.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <map>
#include <numbers>
#include <string>
#include <utility>

namespace {

using namespace scree;
using namespace scree::benchmarks;

constexpr double squeeze_rate = 0.1; // 1/s
const std::map<std::string, BucketDetail> bucket_details{{"simplified", BucketDetail::simplified},
                                                         {"detailed", BucketDetail::detailed}};

Timed timed(PeriodicBed bed, const std::string& real, bool audit, const TimedRun& run) {
  if (real == "float") {
    return audit ? timed_steps<TimedModel<float, true>>(std::move(bed), run)
                 : timed_steps<TimedModel<float, false>>(std::move(bed), run);
  }
  return audit ? timed_steps<TimedModel<double, true>>(std::move(bed), run)
               : timed_steps<TimedModel<double, false>>(std::move(bed), run);
}

/// The bed as it flows after some steps under tilted gravity, with all motion.
PeriodicBed flowing(PeriodicBed bed, const TimedRun& run) {
  TimedScene<TimedModel<double, false>> scene{bed, run};
  scene.advance(run.steps);
  place_as_in(scene.simulation, bed);
  const auto& bodies = scene.simulation.bodies();
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    PackedBody& body = bed.packing.bodies.at(bodies.id(b));
    body.velocity = bodies.velocity(b);
    body.angular_velocity = bodies.angular_velocity(b);
  }
  return bed;
}

/// The bed without the grains that a bucket set into it, of either detail, would touch.
PeriodicBed with_room_for_bucket(PeriodicBed bed) {
  const MeshSurface simplified{make_dragline_bucket({}, BucketDetail::simplified)};
  const MeshSurface detailed{make_dragline_bucket({}, BucketDetail::detailed)};
  const Vector at = bucket_place(bed);
  std::vector<std::uint32_t> facets;
  const auto near = [&](const MeshSurface& bucket, const Sphere& sphere) {
    facets.clear();
    bucket.facets_near(sphere.centre - at, sphere.radius, facets);
    return !facets.empty();
  };
  const auto touches = [&](const PackedBody& body) {
    const auto spheres = spheres_in_space(bed.packing, body);
    return std::any_of(spheres.begin(), spheres.end(), [&](const Sphere& sphere) {
      return near(simplified, sphere) || near(detailed, sphere);
    });
  };
  std::erase_if(bed.packing.bodies, touches);
  return bed;
}

/// Largest difference of the first forces by two codes over their root mean square.
/// \throws Error where it is above `most`.
void require_same_forces(const char* what, const Vectors& ours, const Vectors& theirs, double most) {
  const double off = largest(difference(ours, theirs)) / root_mean_square(ours);
  std::cout << "forces of the first step, " << what << ": differ by at most " << off
            << " of their root mean square\n";
  if (!(off < most)) {
    throw Error(message("the two codes do not compute the same (at most ", most,
                        " is asked for): no time would mean anything"));
  }
}

} // namespace

int main(int argc, char** argv) {
  CLI::App app{"Side by side with other programs; benchmarks/peers/run.sh calls it."};
  app.require_subcommand(1);
  std::string in_path, out_path, more_path, real = "double", shape = "ball", bucket;
  double tilt = 0.0;
  bool audit = false, flag = false;
  std::size_t nx = 1, ny = 1;
  TimedRun run;

  auto* make = app.add_subcommand("make", "settle a cell of 5,000 balls or 1,250 clumps");
  make->add_option("bed", out_path)->required();
  make->add_option("--shape", shape)->check(CLI::IsMember({"ball", "tetrahedron"}));
  make->add_option("--threads", run.threads);
  make->callback([&] {
    const bool balls = shape == "ball";
    write_bed(out_path, settled_bed(shape_named(shape), balls ? Sizes{0.005, 0.0095} : Sizes{1.0, 1.0},
                                    balls ? 5000 : 1250, balls ? 0.25 : 0.2, run.threads));
  });

  auto* tile = app.add_subcommand("tile", "repeat a bed in x and y");
  tile->add_option("bed", in_path)->required();
  tile->add_option("out", out_path)->required();
  tile->add_option("nx", nx)->required();
  tile->add_option("ny", ny)->required();
  tile->callback([&] { write_bed(out_path, tiled(read_bed(in_path), nx, ny)); });

  auto* flow = app.add_subcommand("flow", "let a bed flow under tilted gravity");
  flow->add_option("bed", in_path)->required();
  flow->add_option("out", out_path)->required();
  flow->add_option("--tilt", tilt, "degrees")->required();
  flow->add_option("--steps", run.steps)->required();
  flow->add_option("--threads", run.threads);
  flow->callback([&] {
    run.tilt = tilt * std::numbers::pi / 180.0;
    write_bed(out_path, flowing(read_bed(in_path), run));
  });

  auto* room = app.add_subcommand("room", "take the grains away that a bucket would touch");
  room->add_option("bed", in_path)->required();
  room->add_option("out", out_path)->required();
  room->add_option("stl", more_path, "of the simplified bucket where it starts")->required();
  room->callback([&] {
    const PeriodicBed bed = read_bed(in_path);
    write_bed(out_path, with_room_for_bucket(bed));
    TriangleMesh mesh = make_dragline_bucket({}, BucketDetail::simplified);
    for (Vector& vertex : mesh.vertices) {
      vertex += bucket_place(bed);
    }
    write_stl_text(more_path, mesh);
  });

  auto* data = app.add_subcommand("data", "write the bed for LAMMPS and LIGGGHTS");
  data->add_option("bed", in_path)->required();
  data->add_option("data", out_path)->required();
  data->add_flag("--squeezed", flag, "in motion, for `same`");
  data->callback([&] {
    const PeriodicBed bed = read_bed(in_path);
    write_peers_data(out_path, flag ? squeezed(bed, squeeze_rate) : bed);
  });

  auto* same = app.add_subcommand("same", "compare first forces with those of another code");
  same->add_option("bed", in_path)->required();
  same->add_option("forces", out_path, "dump of id fx fy fz on the squeezed bed")->required();
  same->callback([&] {
    const PeriodicBed moving = squeezed(read_bed(in_path), squeeze_rate);
    const Vectors theirs = lammps_forces(out_path, moving);
    require_same_forces("double", first_forces<TimedModel<double, false>>(moving), theirs, 1e-9);
    require_same_forces("float", first_forces<TimedModel<float, false>>(moving), theirs, 1e-4);
  });

  auto* places = app.add_subcommand("places", "compare where some steps from rest lead");
  places->add_option("bed", in_path)->required();
  places->add_option("places", out_path, "dump of id xu yu zu after the steps")->required();
  places->add_option("--steps", run.steps)->required();
  places->callback([&] {
    const PeriodicBed bed = read_bed(in_path);
    const Vectors moved = displacements(bed, run.steps);
    const double path = root_mean_square(difference(moved, lammps_displacements(out_path, bed)));
    std::cout << "after " << run.steps << " steps from rest, in which spheres moved by "
              << 1e6 * root_mean_square(moved) << " um, their places differ by " << 1e6 * path
              << " um (root mean square)\n";
  });

  auto* time = app.add_subcommand("time", "time scree: prints grains;contacts;steps;MB;renewals;seconds");
  time->add_option("bed", in_path)->required();
  time->add_option("--real", real)->check(CLI::IsMember({"double", "float"}));
  time->add_flag("--audit", audit, "sum the work of friction and dashpots");
  time->add_option("--threads", run.threads);
  time->add_option("--tilt", tilt, "degrees");
  time->add_option("--bucket", bucket)->check(CLI::IsMember(bucket_details));
  time->add_option("--warm", run.warm, "steps before the timed ones");
  time->add_option("--steps", run.steps);
  time->callback([&] {
    run.tilt = tilt * std::numbers::pi / 180.0;
    if (!bucket.empty()) {
      run.bucket = bucket_details.at(bucket);
    }
    const Timed t = timed(read_bed(in_path), real, audit, run);
    std::cout << t.grains << ';' << t.contacts << ';' << run.steps << ';' << t.megabytes << ';'
              << t.list_renewals << ';' << t.seconds << '\n';
  });

  auto* table = app.add_subcommand("table", "write the tables of all repeats");
  table->add_option("repeats", in_path)->required();
  table->add_option("out", out_path, "folder")->required();
  table->callback([&] {
    const Rows rows = read_repeats(in_path);
    const std::filesystem::path out = out_path;
    write_rows(rows, out / "peers.csv", out / "peers.md");
    write_goals(rows, out / "goals.md", out / "goals.csv");
    write_chart(rows, out / "chart.csv");
  });

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error);
  } catch (const std::exception& error) {
    std::cerr << "error: " << error.what() << '\n';
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
