#pragma once
/// \file
/// Every number of the drag program.

#include "laboratory/dragline.hpp"
#include "scree/measure/watchdog.hpp"
#include "support/options.hpp"
#include "support/rock_options.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace drag {

using scree::examples::Options;
using scree::examples::Provenance;

/// What the program is given beside the experiment itself.
struct Parameters {
  std::string fidelity = "desk";
  scree::examples::RockOptions rock{true};
  std::string out;
  scree::examples::Dragline dragline{true};
  std::uint64_t threads = 0;

  double skin_share = 0.5;
  double step_safety = 0.8;
  double sample_interval = 0.01, frame_interval = 0.1, picture_interval = 0.25;
  double checkpoint_interval = 300.0;
  scree::SaneBounds bounds; // the domain is that of the trough
};

inline Parameters defaults(const std::string& fidelity) {
  Parameters p;
  p.fidelity = fidelity;
  p.rock = scree::examples::RockOptions{fidelity == "desk"};
  p.dragline = scree::examples::Dragline{fidelity == "desk"};
  return p;
}

/// Binds every parameter to its option.
inline void bind(Options& options, Parameters& p) {
  scree::DragSetup& s = p.dragline.setup;

  options.group("Run");
  options.add("fidelity", p.fidelity, {"desk", "lab"}, "which set of defaults");
  options.add("out", p.out, {}, "folder for the results; none: results/drag-FIDELITY-K");
  options.add("seed", s.seed, {0.0, 9e15}, "of all random numbers");
  options.add("threads", p.threads, {0.0, 1024.0},
              "0: one for each processor; the results are the same for any");
  options.add("sample_interval", p.sample_interval, {1e-6, 10.0, "s"},
              "simulated, between two lines of drag.csv");
  options.add("frame_interval", p.frame_interval, {1e-4, 1e3, "m"}, "of drag, between two VTK frames");
  options.add("picture_interval", p.picture_interval, {1e-3, 1e3, "m"}, "of drag, between two pictures");
  options.add("checkpoint_interval", p.checkpoint_interval, {0.0, 1e9, "s"},
              "of wall time, between two checkpoints; a stopped run goes on with --resume FOLDER");
  options.add("step_safety", p.step_safety, {0.01, 1.0}, "share of the critical time step");
  scree::RestingRegions& r = s.resting;
  options.add("resting.speed", r.speed, {0.0, 1e3, "m/s"},
              "grains slower than this, and in balance, are left alone while the bucket is pulled; 0: none");
  options.add("resting.force", r.force, {1e-9, 0.999},
              "imbalance that wakes a grain, over the sum of the normal forces on it");
  options.add("resting.window", r.window, {1.0, 1e9}, "steps over which that speed is a mean");
  options.add("resting.interval", r.interval, {1.0, 1e9}, "steps between two looks at grains left alone");
  options.add("skin_share", p.skin_share, {0.01, 10.0},
              "skin of the neighbour list over the smallest radius");

  options.group("Watch: what ends a run that has gone wrong");
  options.add("watch.overlap", p.bounds.overlap, {1e-6, 10.0},
              "of a contact, over the radius of the smallest sphere in it, at most");
  options.add("watch.speed", p.bounds.speed, {1e-6, 1e9, "m/s"}, "of a grain, at most");
  options.add("watch.rope_strain", p.bounds.rope_strain, {1e-6, 10.0},
              "stretch of a rope over its length, at most");
  options.add("watch.rope_slack", p.bounds.rope_slack, {1e-6, 1e9, "m"},
              "by which a rope hangs through, at most");

  p.rock.bind(options);
  options.add("rock.local_damping", s.local_damping, {0.0, 0.99}, "non-viscous, while the bucket digs");

  options.group("What the rock touches");
  scree::examples::add_contact_options(options, "steel", s.steel, Provenance::ours, Provenance::ours);
  scree::examples::add_contact_options(options, "trough", s.floor, Provenance::ours, Provenance::ours);

  p.dragline.bind(options);
}

/// Carries what is not bound to the setup itself over into it.
inline void apply(Parameters& p) {
  p.dragline.setup.threads = static_cast<unsigned>(p.threads);
  p.dragline.setup.rock = p.rock.material();
  p.dragline.setup.size_factor = p.rock.size_factor();
  p.dragline.setup.stiffness = p.rock.stiffness();
  p.dragline.setup.mass_convention = p.rock.mass_convention();
  // What is poured stands high above the trough; what is beside or below it has slipped through.
  const scree::DragSetup& s = p.dragline.setup;
  const double gap = 0.1 * s.bed_depth;
  p.bounds.domain = {scree::Vector{-gap, -0.5 * s.bed_width - gap, -s.bed_depth - gap},
                     scree::Vector{s.bed_length + gap, 0.5 * s.bed_width + gap, 100.0 * s.bed_depth}};
}

} // namespace drag
