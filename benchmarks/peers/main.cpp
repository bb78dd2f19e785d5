// What run.sh needs in C++: makes the bed, times scree, checks that two codes compute the same, makes the
// table.

#include "bed_file.hpp"
#include "same_results.hpp"
#include "table.hpp"
#include "timed_steps.hpp"

#include <CLI/CLI.hpp>

#include <cstdlib>
#include <exception>
#include <iostream>
#include <string>

namespace {

using namespace scree;
using namespace scree::benchmarks;

constexpr double squeeze_rate = 0.1; // 1/s

Timed timed(const PeriodicBed& bed, const std::string& real, bool audit, unsigned threads, int warm,
            int steps) {
  if (real == "float") {
    return timed_steps<TimedModel<float, true>>(bed, threads, warm, steps);
  }
  return audit ? timed_steps<TimedModel<double, true>>(bed, threads, warm, steps)
               : timed_steps<TimedModel<double, false>>(bed, threads, warm, steps);
}

} // namespace

int main(int argc, char** argv) {
  CLI::App app{"Side by side with other programs on a settled bed; benchmarks/peers/run.sh calls it."};
  app.require_subcommand(1);
  std::string bed_path, out_path, real = "double";
  unsigned threads = 1;
  int warm = 100, steps = 500;
  bool audit = false;
  std::size_t tiles = 2;
  Work work;

  auto* make = app.add_subcommand("make", "settle 5,000 spheres in a cell of 0.25 m, tile it, write it");
  make->add_option("bed", bed_path)->required();
  make->add_option("--tiles", tiles, "cells in x and in y");
  make->add_option("--threads", threads);
  make->callback([&] {
    const PeriodicBed cell = settled_bed(unit_ball(), {0.005, 0.0095}, 5000, 0.25, threads);
    write_bed(bed_path, tiled(cell, tiles, tiles));
  });

  auto* data = app.add_subcommand("data", "write the bed for LAMMPS");
  bool squeeze = false;
  data->add_option("bed", bed_path)->required();
  data->add_option("data", out_path)->required();
  data->add_flag("--squeezed", squeeze, "in motion, for `same`");
  data->callback([&] {
    const PeriodicBed bed = read_bed(bed_path);
    write_lammps_data(out_path, squeeze ? squeezed(bed, squeeze_rate) : bed);
  });

  auto* same = app.add_subcommand("same", "compare the first forces and a short run with those of LAMMPS");
  std::string moved_path;
  same->add_option("bed", bed_path)->required();
  same->add_option("forces", out_path, "dump of id fx fy fz on the squeezed bed")->required();
  same->add_option("places", moved_path, "dump of id xu yu zu after the steps, from rest")->required();
  same->add_option("--steps", steps)->required();
  same->callback([&] {
    const PeriodicBed bed = read_bed(bed_path);
    const PeriodicBed moving = squeezed(bed, squeeze_rate);
    const Vectors ours = first_forces(moving);
    const double forces = largest(difference(ours, lammps_forces(out_path, moving))) / root_mean_square(ours);
    const Vectors moved = displacements(bed, steps);
    const double path = root_mean_square(difference(moved, lammps_displacements(moved_path, bed)));
    std::cout << "Forces of the first step differ by at most " << forces << " of their root mean square;\n"
              << "after " << steps << " steps from rest, in which spheres moved by "
              << 1e6 * root_mean_square(moved) << " um, their places differ by " << 1e6 * path
              << " um (root mean square).\n";
    if (!(forces < 1e-9)) {
      throw Error("the two codes do not compute the same: no time would mean anything");
    }
  });

  auto* time = app.add_subcommand("time", "time scree: prints seconds, contacts and list renewals");
  time->add_option("bed", bed_path)->required();
  time->add_option("--real", real)->check(CLI::IsMember({"double", "float"}));
  time->add_flag("--audit", audit, "sum the work of friction and dashpots (always, in float)");
  time->add_option("--threads", threads);
  time->add_option("--warm", warm, "steps before the timed ones");
  time->add_option("--steps", steps);
  time->callback([&] {
    const Timed t = timed(read_bed(bed_path), real, audit, threads, warm, steps);
    std::cout << t.seconds << ' ' << t.contacts << ' ' << t.list_renewals << '\n';
  });

  auto* table = app.add_subcommand("table", "write a table of all repeats; prints it in Markdown");
  table->add_option("repeats", bed_path)->required();
  table->add_option("csv", out_path)->required();
  table->add_option("--grains", work.grains)->required();
  table->add_option("--contacts", work.contacts)->required();
  table->add_option("--steps", work.steps)->required();
  table->callback([&] { write_table(read_repeats(bed_path), work, out_path, std::cout); });

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
