#include "scree/core/random.hpp"
#include "scree/geometry/clump.hpp"
#include "support/relative_error.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>

using namespace scree;

namespace {

const std::vector<Sphere> uneven{{{0.0, 0.0, 0.0}, 1.0}, {{1.2, 0.3, 0.0}, 0.6}, {{-0.2, 0.9, 0.4}, 0.5}};

std::vector<Sphere> moved(std::vector<Sphere> spheres, const Quaternion& turn, const Vector& shift) {
  for (Sphere& s : spheres) {
    s.centre = turn * s.centre + shift;
  }
  return spheres;
}

double largest_distance(const std::vector<Sphere>& a, const std::vector<Sphere>& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    largest = std::max(largest, (a[i].centre - b[i].centre).norm());
  }
  return largest;
}

} // namespace

TEST_CASE("a clump lies in its principal frame") {
  Random random{11};
  const auto spheres = moved(uneven, random.orientation(), Vector{4.0, 5.0, 6.0});
  for (const auto convention : {MassConvention::union_of_spheres, MassConvention::sum_of_spheres}) {
    const Clump clump = make_clump("uneven", spheres, convention);
    const MassProperties p = convention == MassConvention::union_of_spheres
                                 ? union_properties(clump.spheres)
                                 : sum_of_spheres_properties(clump.spheres);
    CHECK(clump.volume == test::about(p.mass, 1e-12));
    CHECK(p.centre.norm() < 1e-12);
    CHECK((p.inertia - Matrix(clump.inertia.asDiagonal())).norm() < 1e-11);
    CHECK(clump.inertia[0] < clump.inertia[1]);
    CHECK(clump.inertia[1] < clump.inertia[2]);
    // The clump is the given one turned, not its mirror image: the handedness of three spheres and the centre
    // is kept.
    const auto handedness = [&](const std::vector<Sphere>& s, const Vector& centre) {
      return (s[0].centre - centre).dot((s[1].centre - centre).cross(s[2].centre - centre));
    };
    const Vector centre = convention == MassConvention::union_of_spheres
                              ? union_properties(spheres).centre
                              : sum_of_spheres_properties(spheres).centre;
    // Of one sign, unless the centre lies in the plane of the three.
    CHECK(std::abs(handedness(clump.spheres, Vector::Zero()) - handedness(spheres, centre)) < 1e-12);
  }
}

TEST_CASE("the conventions differ in mass, not in the volume that is filled") {
  const Clump united = make_clump("a", uneven, MassConvention::union_of_spheres);
  const Clump summed = make_clump("a", uneven, MassConvention::sum_of_spheres);
  double sum = 0.0;
  for (const Sphere& s : uneven) {
    sum += 4.0 / 3.0 * std::numbers::pi * std::pow(s.radius, 3);
  }
  CHECK(summed.volume == test::about(sum, 1e-14));
  CHECK(united.volume < 0.95 * sum);
  CHECK(united.union_volume == united.volume);
  CHECK(summed.union_volume == united.volume);
}

TEST_CASE("a lone sphere is centred and isotropic to the bit") {
  for (const auto convention : {MassConvention::union_of_spheres, MassConvention::sum_of_spheres}) {
    const Clump c = make_clump("ball", std::vector<Sphere>{{{0.1, 0.2, 0.3}, 0.7}}, convention);
    CHECK(c.spheres.size() == 1);
    CHECK(c.spheres[0].centre == Vector::Zero());
    CHECK(c.spheres[0].radius == 0.7);
    CHECK(c.bounding_radius == 0.7);
    CHECK(c.inertia == Vector::Constant(c.inertia[0]));
    CHECK(c.inertia[0] == test::about(0.4 * c.volume * 0.49, 1e-15));
  }
}

TEST_CASE("the principal frame does not depend on rounding where moments are equal") {
  // A rod along (1, 1, 1): any axes across it are principal. Shifts as small as rounding must not turn them.
  Random random{12};
  const Vector along{1.0, 1.0, 1.0};
  const std::vector<Sphere> rod{{-0.5 * along, 0.6}, {Vector::Zero(), 0.6}, {0.5 * along, 0.6}};
  const Matrix frame = principal_axes(union_properties(rod).inertia).axes;
  CHECK((frame.col(0) - along.normalized()).norm() < 1e-12);
  for (int i = 0; i < 20; ++i) {
    auto shaken = rod;
    for (Sphere& s : shaken) {
      s.centre += 1e-14 * Vector{random.normal(), random.normal(), random.normal()};
    }
    CHECK((principal_axes(union_properties(shaken).inertia).axes - frame).norm() < 1e-12);
  }
}

TEST_CASE("principal axes diagonalise, are right-handed and keep given axes where they can") {
  Random random{13};
  const std::vector<Vector> moment_sets{
      {1.0, 2.0, 2.5}, {1.0, 1.0, 1.7}, {1.0, 1.8, 1.8}, {2.0, 2.0, 2.0}, {1.0, 1.0 + 1e-12, 1.5}};
  for (const Vector& moments : moment_sets) {
    CHECK(principal_axes(moments.asDiagonal()).axes == Matrix::Identity());
    for (int i = 0; i < 20; ++i) {
      const Matrix r = random.orientation().toRotationMatrix();
      const Matrix inertia = r * moments.asDiagonal() * r.transpose();
      const PrincipalAxes p = principal_axes(inertia);
      CHECK((p.moments - moments).norm() < 1e-11);
      CHECK((p.axes * p.moments.asDiagonal() * p.axes.transpose() - inertia).norm() < 1e-11);
      CHECK((p.axes.transpose() * p.axes - Matrix::Identity()).norm() < 1e-12);
      CHECK(p.axes.determinant() == test::about(1.0, 1e-12));
    }
  }
}

TEST_CASE("the same clump comes out however it is turned") {
  Random random{14};
  const Clump reference = make_clump("uneven", uneven);
  for (int i = 0; i < 10; ++i) {
    const Clump c = make_clump("uneven", moved(uneven, random.orientation(), Vector{1.0, -2.0, 0.5}));
    CHECK((c.inertia - reference.inertia).norm() < 1e-11);
    CHECK(c.bounding_radius == test::about(reference.bounding_radius, 1e-11));
    // The sense of the axes is free: up to a half turn about one of them the spheres are in the same places.
    double nearest = std::numeric_limits<double>::infinity();
    for (const Vector& signs : {Vector{1, 1, 1}, Vector{1, -1, -1}, Vector{-1, 1, -1}, Vector{-1, -1, 1}}) {
      auto turned = c.spheres;
      for (Sphere& s : turned) {
        s.centre = s.centre.cwiseProduct(signs);
      }
      nearest = std::min(nearest, largest_distance(turned, reference.spheres));
    }
    CHECK(nearest < 1e-10);
  }
}

TEST_CASE("a scaled clump is the clump of scaled spheres") {
  for (const auto convention : {MassConvention::union_of_spheres, MassConvention::sum_of_spheres}) {
    const double factor = 0.013;
    auto small = uneven;
    for (Sphere& s : small) {
      s.centre *= factor;
      s.radius *= factor;
    }
    const Clump direct = make_clump("uneven", small, convention);
    const Clump c = scaled(make_clump("uneven", uneven, convention), factor);
    CHECK(c.volume == test::about(direct.volume, 1e-12));
    CHECK(c.union_volume == test::about(direct.union_volume, 1e-12));
    CHECK(c.bounding_radius == test::about(direct.bounding_radius, 1e-12));
    CHECK((c.inertia - direct.inertia).norm() < 1e-12 * direct.inertia.norm());
    CHECK(largest_distance(c.spheres, direct.spheres) < 1e-12);
    CHECK(c.convention == convention);
    CHECK(c.name == "uneven");
  }
  CHECK_THROWS_AS((void)scaled(make_clump("uneven", uneven), 0.0), Error);
  CHECK_THROWS_AS((void)scaled(make_clump("uneven", uneven), std::numeric_limits<double>::quiet_NaN()),
                  Error);
}

TEST_CASE("the bounding sphere holds every member and touches one") {
  const Clump c = make_clump("uneven", uneven);
  double reach = 0.0;
  for (const Sphere& s : c.spheres) {
    reach = std::max(reach, s.centre.norm() + s.radius);
  }
  CHECK(c.bounding_radius == reach);
}

TEST_CASE("mass conventions have names") {
  for (const auto convention : {MassConvention::union_of_spheres, MassConvention::sum_of_spheres}) {
    CHECK(parse_mass_convention(to_string(convention)) == convention);
  }
  CHECK(to_string(MassConvention::sum_of_spheres) == "sum_of_spheres");
  CHECK_THROWS_WITH_AS((void)parse_mass_convention("both"),
                       "mass convention \"both\" is neither union_of_spheres nor sum_of_spheres", Error);
}

TEST_CASE("a clump refuses bad spheres") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS((void)make_clump("none", {}), Error);
  CHECK_THROWS_AS((void)make_clump("flat", std::vector<Sphere>{{Vector::Zero(), 0.0}}), Error);
  CHECK_THROWS_AS((void)make_clump("nan", std::vector<Sphere>{{Vector{nan, 0.0, 0.0}, 1.0}}), Error);
}
