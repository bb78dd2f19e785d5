#include "laboratory/dragline.hpp"

#include "scree/core/error.hpp"
#include "scree/geometry/interior_from_hull.hpp"
#include "scree/geometry/mesh_topology.hpp"
#include "scree/io/stl.hpp"
#include "scree/laboratory/bucket_body.hpp"
#include "support/recipe_options.hpp"

namespace scree::examples {

Dragline::Dragline(bool desk)
    : setup{desk ? desk_drag() : DragSetup{}}, paper_in_lab_{desk ? Provenance::ours : Provenance::paper} {
  for (const Vector& hitch : hitch_points(shape_)) {
    (hitch.y() > 0.0 ? hitch_left_ : hitch_right_) = {hitch.x(), hitch.y(), hitch.z()};
  }
}

void Dragline::bind(Options& options) {
  DragSetup& s = setup;
  options.group("Bed");
  options.add("bed.length", s.bed_length, {0.01, 1e3, "m"}, "of the trough", paper_in_lab_);
  options.add("bed.width", s.bed_width, {0.01, 1e3, "m"}, "of the trough", paper_in_lab_);
  options.add("bed.depth", s.bed_depth, {0.01, 1e3, "m"}, "of the trough where it is deepest", paper_in_lab_);
  options.add("bed.shaped", s.shaped_bed, "floor shaped along the path of the bucket, not a box",
              Provenance::paper);
  options.add("bed.drag_angle", s.drag_angle, {-1.2, 1.2, "rad"}, "by which the bed rises towards the winch");
  bind_bed(options, s.bed);

  options.group("Bucket: its shape");
  DraglineBucket& b = shape_;
  options.add("bucket.stl", stl_, {}, "STL file (x ahead, z up) in place of the parametric bucket");
  options.add("bucket.interior_stl", interior_stl_, {},
              "closed STL of its interior; none: hull of its side view");
  options.add("bucket.stl_scale", stl_scale_, {1e-6, 1e6}, "m per unit of the STL files");
  options.add("bucket.stl_weld", stl_weld_, {0.0, 1.0, "m"}, "vertices closer than this are one");
  options.add("bucket.detail", detail_, {"simplified", "detailed"}, "about 520 or about 5000 facets",
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
  options.add("bucket.mass", mass_, {0.0, 1e7, "kg"},
              "0: estimated from the plates, as centre and inertia are");
  options.add("bucket.centre", centre_, {-100.0, 100.0, "m"},
              "centre of mass, in the bucket's frame, if a mass is given");
  options.add("bucket.inertia", inertia_, {0.0, 1e9, "kg m2"},
              "Ixx, Iyy, Izz about the centre, if a mass is given");
  options.add("bucket.hitch_left", hitch_left_, {-100.0, 100.0, "m"}, "left hitch of an STL bucket");
  options.add("bucket.hitch_right", hitch_right_, {-100.0, 100.0, "m"}, "right hitch of an STL bucket");

  options.group("Rig");
  options.add("rig.drag_speed", s.drag_speed, {1e-4, 100.0, "m/s"}, "of both ropes at the winch",
              paper_in_lab_);
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

BucketBody Dragline::bucket(std::vector<std::string>& remarks) const {
  BucketBody out;
  const auto vector = [](const std::vector<double>& v) { return Vector{v[0], v[1], v[2]}; };
  if (stl_.empty()) {
    const auto level = detail_ == "detailed" ? BucketDetail::detailed : BucketDetail::simplified;
    out = bucket_body(shape_, level);
  } else {
    const StlOptions reading{.scale = stl_scale_, .weld_tolerance = stl_weld_};
    out.surface = without_collapsed_facets(read_stl(stl_, reading));
    const auto report = check(out.surface);
    if (!report.clean()) {
      remarks.push_back(stl_ + ": " + report.summary());
    }
    out.interior = interior_stl_.empty() ? interior_from_hull(out.surface) : read_stl(interior_stl_, reading);
    out.hitches = {vector(hitch_left_), vector(hitch_right_)};
    out.body = plate_properties(out.surface, 0.5 * shape_.plate_thickness, 7850.0);
    if (interior_stl_.empty()) {
      remarks.push_back("interior of the bucket: hull of its side view between the cheeks");
    }
  }
  if (!check(out.interior).closed()) {
    throw Error("bucket interior: the mesh is not closed, so nothing can be inside it");
  }
  if (mass_ > 0.0) {
    out.body = {mass_, vector(centre_), vector(inertia_).asDiagonal()};
  } else {
    remarks.push_back(message("mass of the bucket estimated from its plates: ", out.body.mass, " kg"));
  }
  return out;
}

} // namespace scree::examples
