#pragma once
/// \file
/// The dimensions that make a dragline bucket, and which of them go together.

#include "scree/core/error.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace scree {

/// Dimensions of a dragline bucket, in m and rad.
///
/// Bucket frame: x is the drag direction (the teeth point to +x), y is left, z is up, and the floor is level.
/// The origin is at the underside of the floor (z = 0), half way between the cheeks (y = 0), below the
/// rearmost point of the back's rim (x = 0). Pitch is positive with the teeth up, which is a negative
/// rotation about y.
///
/// In the side view the floor runs back from the lip at (length, 0), turns up over the heel into the back,
/// which leans rearward and ends at the rim at (0, height). The cheeks fill the view between floor, back, rim
/// and mouth; the mouth leans rearward from the lip.
///
/// Width, length and height are those of the 1:18 model of Coetzee, Els & Dymond 2010, Sec. 3.1, which holds
/// 61 m3/18^3 = 10.5 L. All other values are ours, not in the paper, chosen so that the interior holds that
/// volume and the plates weigh what buckets of that volume do.
struct DraglineBucket {
  double width = 0.300;  ///< m, over the cheeks; 0.02 to 20
  double length = 0.300; ///< m, from the rearmost point to the lip, without the teeth; 0.02 to 20
  double height = 0.175; ///< m, from the underside of the floor to the rim, without the arch; 0.02 to 20

  double plate_thickness = 0.004; ///< m, of floor, back and cheeks; to a tenth of the bucket
  double mouth_rake = 0.54;       ///< rad, by which the cheeks' front edge leans rearward; 0 to 0.8
  double back_rake = 0.25;        ///< rad, by which the back leans rearward; 0 to 0.8
  double heel_radius = 0.090;     ///< m, outside radius of the bend from floor to back; above plate_thickness

  double lip_length = 0.060;    ///< m, of the thick front part of the floor; above lip_bevel
  double lip_bevel = 0.025;     ///< m, over which the lip thins towards its edge; above 0
  double lip_thickness = 0.012; ///< m, of the lip where it is thickest; at least the plate's
  double lip_edge = 0.002;      ///< m, of the lip at its front edge; above 0, to lip_thickness

  int teeth = 5;                    ///< number of teeth, evenly spaced; 0 to 20
  double tooth_length = 0.045;      ///< m, in front of the lip; at least lip_bevel
  double tooth_width = 0.022;       ///< m, at the lip; above 0, all together to half the width
  double tooth_tip_width = 0.016;   ///< m; above 0, to tooth_width
  double tooth_height = 0.022;      ///< m, at the lip; above 1.5 lip_edge
  double tooth_tip_height = 0.0035; ///< m; above 0, to tooth_height
  double tooth_angle = 0.42; ///< rad, by which the teeth lean down from the floor: they bite first; 0 to 0.8

  double hitch_height = 0.040; ///< m, of the hitch points above the floor's underside; between lip and rim
  double hitch_radius = 0.011; ///< m, of the round front of the ear on each cheek; above 0
  double hitch_reach = 0.022;  ///< m, from the cheek's front edge to the hitch point; above hitch_radius

  double hitch_mass = 0.6; ///< kg, at each hitch point: shackle, pins and the end of the chain; 0 or above

  // Of the detailed bucket only:
  double fillet_radius = 0.010; ///< m, between the inside of a cheek and floor or back; above 0
  double arch_rise = 0.075;     ///< m, of the arch's axis above the rim; above 0
  double arch_radius = 0.0075;  ///< m, of the arch's round bar; above plate_thickness
  double rail_radius = 0.0045;  ///< m, of the round bar along the rim; above half the plate_thickness
};

/// \throws Error naming the first dimension that is outside the range which the others leave it.
inline void require_valid(const DraglineBucket& bucket) {
  const auto& b = bucket;
  // Stands for "above 0": smaller details would drown in the tolerances of mesh checks.
  const double least = 1e-4 * require("width", b.width, {0.02, 20.0, "m"});
  require("length", b.length, {0.02, 20.0, "m"});
  require("height", b.height, {0.02, 20.0, "m"});
  const double t = require("plate_thickness", b.plate_thickness,
                           {least, 0.1 * std::min({b.width, b.length, b.height}), "m"});
  require("mouth_rake", b.mouth_rake, {0.0, 0.8, "rad"});
  require("back_rake", b.back_rake, {0.0, 0.8, "rad"});
  const double mouth_slope = std::tan(b.mouth_rake);
  const double back_slope = std::tan(b.back_rake);
  require("height * tan(mouth_rake)", b.height * mouth_slope, {0.0, 0.6 * b.length, "m"});

  require("lip_bevel", b.lip_bevel, {least, 0.4 * b.length, "m"});
  require("lip_length", b.lip_length, {1.05 * b.lip_bevel, 0.5 * b.length, "m"});
  require("lip_thickness", b.lip_thickness, {t, 0.2 * b.height, "m"});
  require("lip_edge", b.lip_edge, {least, b.lip_thickness, "m"});

  // The bend takes this much of floor and back for each unit of its radius.
  const double bend = std::tan(0.25 * std::numbers::pi - 0.5 * b.back_rake);
  const double floor = b.length - b.height * back_slope;
  const double back = b.height / std::cos(b.back_rake);
  require("heel_radius", b.heel_radius,
          {1.5 * t, std::min(floor - 1.05 * b.lip_length, 0.9 * back) / bend, "m"});
  // A fillet's edge is offset along mouth and rim, which must leave it some of floor and back.
  require("fillet_radius", b.fillet_radius,
          {least,
           std::min({0.25 * b.width, b.heel_radius / 1.2 - t,
                     0.5 * (floor - bend * b.heel_radius) / mouth_slope - t,
                     0.5 * (back - bend * b.heel_radius) / back_slope - t}),
           "m"});

  require("teeth", b.teeth, {0.0, 20.0});
  require("tooth_length", b.tooth_length, {b.lip_bevel, b.length, "m"});
  require("tooth_width", b.tooth_width, {least, 0.5 * b.width / std::max(b.teeth, 1), "m"});
  require("tooth_tip_width", b.tooth_tip_width, {least, b.tooth_width, "m"});
  require("tooth_height", b.tooth_height, {1.5 * b.lip_edge, b.height, "m"});
  require("tooth_tip_height", b.tooth_tip_height, {least, b.tooth_height, "m"});
  require("tooth_angle", b.tooth_angle, {0.0, 0.8, "rad"});

  require("hitch_radius", b.hitch_radius, {least, 0.25 * b.height, "m"});
  require("hitch_reach", b.hitch_reach, {(1.05 + mouth_slope) * b.hitch_radius, b.length, "m"});
  require("hitch_height", b.hitch_height,
          {b.lip_thickness + b.hitch_radius, b.height - 1.5 * b.hitch_radius, "m"});

  require("hitch_mass", b.hitch_mass, {0.0, 1e6, "kg"});

  require("arch_radius", b.arch_radius, {t, 0.05 * std::min(b.width, b.length), "m"});
  // The arch's bends must be wider than its bar.
  require("arch_rise", b.arch_rise, {std::sqrt(b.width * b.arch_radius), 2.0 * b.width, "m"});
  require("rail_radius", b.rail_radius, {0.6 * t, 0.9 * (b.fillet_radius + 0.5 * t), "m"});
}

} // namespace scree
