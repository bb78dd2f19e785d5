#include "scree/core/random.hpp"
#include "scree/geometry/dragline_bucket.hpp"
#include "scree/geometry/mesh_topology.hpp"
#include "support/relative_error.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <tuple>
#include <vector>

using namespace scree;

namespace {

constexpr std::array levels{BucketDetail::simplified, BucketDetail::detailed};

/// Longest side over the height on it, of the worst facet.
double worst_aspect_ratio(const TriangleMesh& mesh) {
  double worst = 0.0;
  for (std::size_t i = 0; i < mesh.facets.size(); ++i) {
    const auto [a, b, c] = mesh.corners(i);
    const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    worst = std::max(worst, longest * longest / (b - a).cross(c - a).norm());
  }
  return worst;
}

/// Upright front and back, floor of one thickness, no teeth: the inside is a box but for the heel.
DraglineBucket upright() {
  DraglineBucket bucket;
  bucket.mouth_rake = 0.0;
  bucket.back_rake = 0.0;
  bucket.lip_thickness = bucket.plate_thickness;
  bucket.lip_edge = bucket.plate_thickness;
  bucket.teeth = 0;
  return bucket;
}

/// A quarter disc of radius r less a quarter of the regular polygon of 16 sides that stands for it.
double heel_area(double r) {
  return r * r - 2.0 * r * r * std::sin(std::numbers::pi / 8.0);
}

/// Dimensions drawn around the default ones and scaled; many are out of range.
DraglineBucket drawn(Random& random) {
  const double scale = std::exp(random.uniform(std::log(0.1), std::log(20.0)));
  const auto vary = [&](double& length) { length *= scale * random.uniform(0.4, 2.5); };
  DraglineBucket b;
  for (double* length :
       {&b.width,        &b.length,          &b.height,        &b.plate_thickness,  &b.heel_radius,
        &b.lip_length,   &b.lip_bevel,       &b.lip_thickness, &b.lip_edge,         &b.tooth_length,
        &b.tooth_width,  &b.tooth_tip_width, &b.tooth_height,  &b.tooth_tip_height, &b.hitch_height,
        &b.hitch_radius, &b.hitch_reach,     &b.fillet_radius, &b.arch_rise,        &b.arch_radius,
        &b.rail_radius}) {
    vary(*length);
  }
  b.mouth_rake = random.uniform(0.0, 0.8);
  b.back_rake = random.uniform(0.0, 0.8);
  b.teeth = static_cast<int>(random.index(9));
  return b;
}

bool valid(const DraglineBucket& bucket) {
  try {
    require_valid(bucket);
    return true;
  } catch (const Error&) {
    return false;
  }
}

} // namespace

TEST_CASE("the bucket has the number of facets it is known for") {
  const auto simplified = make_dragline_bucket({}, BucketDetail::simplified).facets.size();
  CHECK(simplified >= 480);
  CHECK(simplified <= 560);
  const auto detailed = make_dragline_bucket({}, BucketDetail::detailed).facets.size();
  CHECK(detailed >= 4500);
  CHECK(detailed <= 5500);
}

TEST_CASE("the bucket is made of closed shells with outward normals and well-shaped facets") {
  for (const auto level : levels) {
    const auto parts = shells(make_dragline_bucket({}, level));
    // Body, teeth, ears, and arch and rail.
    CHECK(parts.size() == 1 + 5 + 2 + (level == BucketDetail::detailed ? 2 : 0));
    for (const auto& part : parts) {
      const auto report = check(part);
      CHECK_MESSAGE(report.clean(), report.summary());
      CHECK(volume(part) > 0.0);
      CHECK(worst_aspect_ratio(part) < 50.0);
    }
  }
}

TEST_CASE("buckets of all valid dimensions are made of closed shells") {
  Random random{17};
  int tried = 0;
  while (tried < 16) {
    const auto bucket = drawn(random);
    if (!valid(bucket)) {
      continue;
    }
    ++tried;
    // The finer mesh is slow to check, but it is the one that a narrow corner breaks first.
    const auto level = tried % 8 == 0 ? BucketDetail::detailed : BucketDetail::simplified;
    for (const auto& part : shells(make_dragline_bucket(bucket, level))) {
      const auto report = check(part);
      CHECK_MESSAGE(report.clean(), report.summary());
      CHECK(volume(part) > 0.0);
    }
    const auto interior = bucket_interior(bucket);
    CHECK(check(interior).clean());
    CHECK(volume(interior) > 0.0);
  }
}

TEST_CASE("the body has the dimensions asked for, in the bucket frame") {
  DraglineBucket bucket;
  bucket.width = 0.4;
  bucket.length = 0.35;
  bucket.height = 0.2;
  for (const auto level : levels) {
    const auto parts = shells(make_dragline_bucket(bucket, level));
    const auto body = bounding_box(parts[0]);
    CHECK((body.min() - Vector{0.0, -0.2, 0.0}).norm() < 1e-12);
    CHECK((body.max() - Vector{0.35, 0.2, 0.2}).norm() < 1e-12);
    // The teeth reach forward from the lip, evenly spaced from right to left.
    for (std::size_t i = 0; i < 5; ++i) {
      const auto tooth = bounding_box(parts[1 + i]);
      CHECK(tooth.max().x() == test::about(0.35 + bucket.tooth_length));
      CHECK(std::abs(tooth.center().y() - 0.08 * (static_cast<double>(i) - 2.0)) < 1e-9);
      // Leaned down from where it leaves the lip; its underside starts within the lip's edge.
      const double drop = std::tan(bucket.tooth_angle) * (bucket.tooth_length + bucket.lip_bevel);
      CHECK(tooth.min().z() == test::about(0.5 * bucket.lip_edge - drop));
    }
  }
  const auto whole = bounding_box(make_dragline_bucket(bucket, BucketDetail::detailed));
  CHECK(whole.max().z() == test::about(0.2 + bucket.arch_rise + bucket.arch_radius, 0.01));
}

TEST_CASE("the bucket's left is the mirror image of its right, vertex by vertex") {
  for (const auto level : levels) {
    for (const auto& mesh : {make_dragline_bucket({}, level), bucket_interior()}) {
      std::vector<std::tuple<double, double, double>> left;
      std::vector<std::tuple<double, double, double>> right;
      for (const auto& v : mesh.vertices) {
        // The teeth are moved into place, which rounds.
        const auto rounded = [](double x) { return std::round(x * 1e9); };
        left.emplace_back(rounded(v.x()), rounded(v.y()), rounded(v.z()));
        right.emplace_back(rounded(v.x()), -rounded(v.y()), rounded(v.z()));
      }
      std::sort(left.begin(), left.end());
      std::sort(right.begin(), right.end());
      CHECK(left == right);
    }
  }
}

TEST_CASE("the interior holds 61 m3 at 1:18") {
  const double target = 61.0 / std::pow(18.0, 3);
  CHECK(volume(bucket_interior()) == test::about(target, 0.03));
}

TEST_CASE("the interior of an upright bucket is a box less the heel") {
  const auto bucket = upright();
  const double t = bucket.plate_thickness;
  const double side = (bucket.length - t) * (bucket.height - t) - heel_area(bucket.heel_radius - t);
  CHECK(volume(bucket_interior(bucket)) == test::about(side * (bucket.width - 2.0 * t), 1e-12));
}

TEST_CASE("the plates of an upright bucket fill what is left between outside and inside") {
  const auto bucket = upright();
  const auto body = shells(make_dragline_bucket(bucket))[0];
  const double outside = bucket.width * (bucket.length * bucket.height - heel_area(bucket.heel_radius));
  CHECK(volume(body) == test::about(outside - volume(bucket_interior(bucket)), 1e-12));
}

TEST_CASE("the interior begins where the steel ends") {
  Random random{23};
  const auto interior = bucket_interior();
  const auto body = shells(make_dragline_bucket())[0];
  const auto bounds = bounding_box(interior);
  CHECK(bounds.max().z() == test::about(0.175)); // struck off at the rim
  const Vector least = bounding_box(body).min();
  const Vector most = bounding_box(body).max();
  int inside = 0;
  int steel = 0;
  for (int i = 0; i < 400; ++i) {
    const Vector p{random.uniform(least.x(), most.x()), random.uniform(least.y(), most.y()),
                   random.uniform(least.z(), most.z())};
    const bool in_body = contains(body, p);
    const bool in_interior = contains(interior, bounds, p);
    CHECK_FALSE((in_body && in_interior));
    // What is neither lies before the mouth, or outside below the heel or behind the back.
    const bool before_mouth = p.x() > 0.3 - p.z() * std::tan(DraglineBucket{}.mouth_rake);
    const bool behind = p.x() < 0.175 * std::tan(DraglineBucket{}.back_rake) + 0.09;
    CHECK((in_body || in_interior || before_mouth || behind));
    inside += in_interior ? 1 : 0;
    steel += in_body ? 1 : 0;
  }
  CHECK(inside > 200);
  CHECK(steel > 10);
}

TEST_CASE("the hitch points lie on the surface, at the front of the ears") {
  DraglineBucket bucket;
  bucket.hitch_height = 0.09;
  for (const auto level : levels) {
    const auto mesh = make_dragline_bucket(bucket, level);
    const auto [left, right] = hitch_points(bucket);
    CHECK(left.y() > 0.0);
    CHECK(left.z() == 0.09);
    CHECK((left - Vector{right.x(), -right.y(), right.z()}).norm() == 0.0);
    for (const Vector& hitch : {left, right}) {
      CHECK(contains(mesh, hitch - 1e-7 * Vector::UnitX()));
      CHECK_FALSE(contains(mesh, hitch + 1e-7 * Vector::UnitX()));
    }
  }
}

TEST_CASE("the plates weigh what a bucket of that volume does") {
  const auto steel = estimated_from_plates();
  const double volume_in_m3 = volume(bucket_interior());
  CHECK(steel.mass >= 740.0 * volume_in_m3);
  CHECK(steel.mass <= 890.0 * volume_in_m3);
  // Symmetric; most of the steel is low and behind the middle.
  CHECK(std::abs(steel.centre.y()) < 1e-12);
  CHECK(std::abs(steel.inertia(0, 1)) < 1e-12);
  CHECK(std::abs(steel.inertia(1, 2)) < 1e-12);
  CHECK(steel.centre.x() > 0.10);
  CHECK(steel.centre.x() < 0.17);
  CHECK(steel.centre.z() < 0.5 * 0.175);
  DraglineBucket bare;
  bare.hitch_mass = 0.0;
  const auto plates = estimated_from_plates(bare);
  CHECK(estimated_from_plates(bare, 3925.0).mass == test::about(0.5 * plates.mass));
  CHECK(steel.mass == test::about(plates.mass + 1.2));
  CHECK(steel.mass * steel.centre.x() ==
        test::about(plates.mass * plates.centre.x() + 1.2 * hitch_points()[0].x()));
  // Positive definite, and no axis more than the other two together.
  const Vector diagonal = steel.inertia.diagonal();
  CHECK(diagonal.minCoeff() > 0.0);
  CHECK(2.0 * diagonal.maxCoeff() < diagonal.sum());
  CHECK_THROWS_AS((void)estimated_from_plates({}, 0.0), Error);
}

TEST_CASE("thin plates have the mass and the inertia of a bent plate of no thickness") {
  auto bucket = upright();
  bucket.plate_thickness = bucket.lip_thickness = bucket.lip_edge = 0.0004;
  const auto body = shells(make_dragline_bucket(bucket))[0];
  // Half of the closed surface is the outside, half the inside.
  const auto bent = plate_properties(body, 0.5 * bucket.plate_thickness, 7850.0);
  const auto solid = solid_properties(body, 7850.0);
  CHECK(bent.mass == test::about(solid.mass, 0.005));
  CHECK((bent.centre - solid.centre).norm() < 0.001);
  CHECK((bent.inertia - solid.inertia).norm() < 0.01 * solid.inertia.norm());
}

TEST_CASE("dimensions out of range are refused by name") {
  const auto refuses = [](double DraglineBucket::*dimension, double value, const char* name) {
    DraglineBucket bucket;
    bucket.*dimension = value;
    for (int i = 0; i < 2; ++i) {
      try {
        (void)(i == 0 ? make_dragline_bucket(bucket) : bucket_interior(bucket));
        FAIL_CHECK(std::string{name} << " = " << value << " is accepted");
      } catch (const Error& error) {
        CHECK_MESSAGE(std::string(error.what()).find(name) != std::string::npos, error.what());
      }
    }
  };
  const double nan = std::nan("");
  refuses(&DraglineBucket::width, 0.0, "width");
  refuses(&DraglineBucket::width, nan, "width");
  refuses(&DraglineBucket::length, -0.3, "length");
  refuses(&DraglineBucket::height, nan, "height");
  refuses(&DraglineBucket::plate_thickness, 0.0, "plate_thickness");
  refuses(&DraglineBucket::plate_thickness, 0.05, "plate_thickness");
  refuses(&DraglineBucket::mouth_rake, 1.2, "mouth_rake");
  refuses(&DraglineBucket::back_rake, -0.1, "back_rake");
  refuses(&DraglineBucket::heel_radius, 0.3, "heel_radius");
  refuses(&DraglineBucket::heel_radius, nan, "heel_radius");
  refuses(&DraglineBucket::fillet_radius, 0.2, "fillet_radius");
  refuses(&DraglineBucket::lip_length, 0.02, "lip_length");
  refuses(&DraglineBucket::lip_edge, 0.02, "lip_edge");
  refuses(&DraglineBucket::tooth_width, 0.1, "tooth_width");
  refuses(&DraglineBucket::tooth_tip_height, 0.03, "tooth_tip_height");
  refuses(&DraglineBucket::hitch_height, 0.2, "hitch_height");
  refuses(&DraglineBucket::hitch_reach, 0.001, "hitch_reach");
  refuses(&DraglineBucket::hitch_mass, -1.0, "hitch_mass");
  refuses(&DraglineBucket::arch_rise, 0.01, "arch_rise");
  refuses(&DraglineBucket::rail_radius, 0.1, "rail_radius");
  DraglineBucket toothy;
  toothy.teeth = 21;
  CHECK_THROWS_AS((void)make_dragline_bucket(toothy), Error);
  toothy.teeth = -1;
  CHECK_THROWS_AS((void)hitch_points(toothy), Error);
}
