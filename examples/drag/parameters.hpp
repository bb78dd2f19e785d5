#pragma once
/// \file
/// Every number of the drag program.

#include "scree/geometry/dragline_bucket.hpp"
#include "scree/laboratory/drag_setup.hpp"
#include "support/options.hpp"
#include "support/recipe_options.hpp"
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
  scree::DragSetup setup;
  std::uint64_t threads = 0;
  scree::DraglineBucket bucket;
  std::string bucket_stl, interior_stl, detail = "simplified";
  double stl_scale = 1.0, stl_weld = 1e-6;
  std::vector<double> hitch_left, hitch_right;
  double mass = 0.0;
  std::vector<double> centre{0.0, 0.0, 0.0}, inertia{0.0, 0.0, 0.0};

  double skin_share = 0.5;
  double step_safety = 0.8;
  double sample_interval = 0.01, frame_interval = 0.1, picture_interval = 0.25;
};

inline Parameters defaults(const std::string& fidelity) {
  Parameters p;
  p.fidelity = fidelity;
  p.rock = scree::examples::RockOptions{fidelity == "desk"};
  for (const auto& hitch : scree::hitch_points(p.bucket)) {
    (hitch.y() > 0.0 ? p.hitch_left : p.hitch_right) = {hitch.x(), hitch.y(), hitch.z()};
  }
  if (fidelity == "desk") {
    p.setup = scree::desk_drag();
  }
  return p;
}

/// Binds every parameter to its option.
inline void bind(Options& options, Parameters& p) {
  scree::DragSetup& s = p.setup;
  const bool lab = p.fidelity == "lab";
  const auto paper_in_lab = lab ? Provenance::paper : Provenance::ours;

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
  options.add("step_safety", p.step_safety, {0.01, 1.0}, "share of the critical time step");
  options.add("skin_share", p.skin_share, {0.01, 10.0},
              "skin of the neighbour list over the smallest radius");

  p.rock.bind(options);
  options.add("rock.local_damping", s.local_damping, {0.0, 0.99}, "non-viscous, while the bucket digs");

  options.group("What the rock touches");
  scree::examples::add_contact_options(options, "steel", s.steel, Provenance::ours, Provenance::ours);
  scree::examples::add_contact_options(options, "trough", s.floor, Provenance::ours, Provenance::ours);

  options.group("Bed");
  options.add("bed.length", s.bed_length, {0.01, 1e3, "m"}, "of the trough", paper_in_lab);
  options.add("bed.width", s.bed_width, {0.01, 1e3, "m"}, "of the trough", paper_in_lab);
  options.add("bed.depth", s.bed_depth, {0.01, 1e3, "m"}, "of the trough where it is deepest", paper_in_lab);
  options.add("bed.shaped", s.shaped_bed, "floor shaped along the path of the bucket, not a box",
              Provenance::paper);
  options.add("bed.drag_angle", s.drag_angle, {-1.2, 1.2, "rad"}, "by which the bed rises towards the winch");
  scree::examples::bind_bed(options, s.bed);

  options.group("Bucket: its shape");
  scree::DraglineBucket& b = p.bucket;
  options.add("bucket.stl", p.bucket_stl, {}, "STL file (x ahead, z up) in place of the parametric bucket");
  options.add("bucket.interior_stl", p.interior_stl, {},
              "closed STL of its interior; none: hull of its side view");
  options.add("bucket.stl_scale", p.stl_scale, {1e-6, 1e6}, "m per unit of the STL files");
  options.add("bucket.stl_weld", p.stl_weld, {0.0, 1.0, "m"}, "vertices closer than this are one");
  options.add("bucket.detail", p.detail, {"simplified", "detailed"}, "about 520 or about 5000 facets",
              Provenance::paper);
  options.add("bucket.width", b.width, {0.02, 20.0, "m"}, "over the cheeks", Provenance::paper);
  options.add("bucket.length", b.length, {0.02, 20.0, "m"}, "without the teeth", Provenance::paper);
  options.add("bucket.height", b.height, {0.02, 20.0, "m"}, "without the arch", Provenance::paper);
  const auto length = [&](const char* name, double& value, const char* doc) {
    options.add(std::string{"bucket."} + name, value, {0.0, 20.0, "m"}, doc);
  };
  length("plate_thickness", b.plate_thickness, "of floor, back and cheeks");
  options.add("bucket.mouth_rake", b.mouth_rake, {0.0, 0.8, "rad"},
              "by which the cheeks' front leans rearward");
  options.add("bucket.back_rake", b.back_rake, {0.0, 0.8, "rad"}, "by which the back leans rearward");
  length("heel_radius", b.heel_radius, "outside radius of the bend from floor to back");
  length("lip_length", b.lip_length, "of the thick front part of the floor");
  length("lip_bevel", b.lip_bevel, "over which the lip thins towards its edge");
  length("lip_thickness", b.lip_thickness, "of the lip where it is thickest");
  length("lip_edge", b.lip_edge, "of the lip at its front edge");
  length("tooth_length", b.tooth_length, "in front of the lip");
  length("tooth_width", b.tooth_width, "at the lip");
  length("tooth_tip_width", b.tooth_tip_width, "at the tip");
  length("tooth_height", b.tooth_height, "at the lip");
  length("tooth_tip_height", b.tooth_tip_height, "at the tip");
  options.add("bucket.tooth_angle", b.tooth_angle, {0.0, 0.8, "rad"},
              "by which the teeth lean down from the floor");
  length("hitch_height", b.hitch_height, "of the hitch points above the floor's underside");
  length("hitch_radius", b.hitch_radius, "of the ear's round front");
  length("hitch_reach", b.hitch_reach, "from the cheek's front edge to the hitch point");
  options.add("bucket.hitch_mass", b.hitch_mass, {0.0, 1e6, "kg"},
              "at each hitch point: shackle, pins and the end of the chain");
  length("fillet_radius", b.fillet_radius, "inside, between cheek and floor (detailed)");
  length("arch_rise", b.arch_rise, "of the arch above the rim (detailed)");
  length("arch_radius", b.arch_radius, "of the arch's bar (detailed)");
  length("rail_radius", b.rail_radius, "of the bar along the rim (detailed)");

  options.group("Bucket: mass and hitches (with an STL file give the hitches)");
  options.add("bucket.mass", p.mass, {0.0, 1e7, "kg"},
              "0: estimated from the plates, as centre and inertia are");
  options.add("bucket.centre", p.centre, {-100.0, 100.0, "m"},
              "centre of mass, in the bucket's frame, if a mass is given");
  options.add("bucket.inertia", p.inertia, {0.0, 1e9, "kg m2"},
              "Ixx, Iyy, Izz about the centre, if a mass is given");
  options.add("bucket.hitch_left", p.hitch_left, {-100.0, 100.0, "m"}, "left hitch of an STL bucket");
  options.add("bucket.hitch_right", p.hitch_right, {-100.0, 100.0, "m"}, "right hitch of an STL bucket");

  options.group("Rig");
  options.add("rig.drag_speed", s.drag_speed, {1e-4, 100.0, "m/s"}, "of both ropes at the winch",
              paper_in_lab);
  options.add("rig.ramp", s.ramp, {1e-6, 100.0, "s"}, "in which the winch comes up to speed");
  options.add("rig.drag_distance", s.drag_distance, {1e-3, 1e3, "m"}, "at which the run ends",
              Provenance::paper);
  options.add("rig.rope_stiffness", s.rope_stiffness, {1.0, 1e12, "N/m"}, "of each rope");
  options.add("rig.rope_damping", s.rope_damping, {0.0, 1e9, "N s/m"}, "of each rope");
  options.add("rig.winch_distance", s.winch_distance, {0.01, 1e4, "m"}, "ahead of the hitches at the start");
  options.add("rig.winch_height", s.winch_height, {-100.0, 1e3, "m"}, "above the surface of the bed");
  options.add("rig.bucket_start", s.bucket_start, {0.0, 1e3, "m"}, "rear of the bucket from the rear wall");
  options.add("rig.placing_time", s.placing_time, {0.0, 1e3, "s"},
              "for the bucket to come to rest before the pull");
  options.add("rig.remove_behind", s.remove_behind, "remove grains that lie behind the bucket",
              Provenance::paper);
  options.add("rig.removal_distance", s.removal_distance, {0.0, 1e3}, "bucket lengths behind it",
              Provenance::paper);
  options.add("rig.removal_interval", s.removal_interval, {1e-4, 1e3, "m"}, "of drag, between two removals");
}

/// Carries what is not bound to the setup itself over into it.
inline void apply(Parameters& p) {
  p.setup.threads = static_cast<unsigned>(p.threads);
  p.setup.rock = p.rock.material();
  p.setup.size_factor = p.rock.size_factor();
  p.setup.stiffness = p.rock.stiffness();
  p.setup.mass_convention = p.rock.mass_convention();
}

} // namespace drag
