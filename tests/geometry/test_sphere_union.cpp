#include "scree/core/random.hpp"
#include "scree/geometry/sphere_union.hpp"
#include "scree/packing/templates.hpp"
#include "support/relative_error.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

using namespace scree;

namespace sphere_union_tests {

namespace {

constexpr double pi = std::numbers::pi;

/// Volume, moment about the sphere's centre and moments of inertia of the part z < a of a sphere of radius r
/// about the origin, from discs of radius sqrt(r^2 - z^2) stacked from -r to a.
struct TruncatedSphere {
  double volume, moment, axial, zz;

  TruncatedSphere(double r, double a) {
    const auto powers = [&](int n) { return (std::pow(a, n) - std::pow(-r, n)) / n; }; // of z^(n-1)
    const double r2 = r * r;
    volume = pi * (r2 * powers(1) - powers(3));
    moment = pi * (r2 * powers(2) - powers(4));
    zz = pi * (r2 * powers(3) - powers(5));
    axial = 0.5 * pi * (r2 * r2 * powers(1) - 2.0 * r2 * powers(3) + powers(5)); // about z
  }
};

/// Two intersecting spheres on the z axis, the first about the origin and the second at distance d above.
MassProperties two_spheres_on_z(double r1, double r2, double d) {
  const double plane = (d * d + (r1 - r2) * (r1 + r2)) / (2.0 * d);
  const TruncatedSphere lower{r1, plane};
  const TruncatedSphere upper{r2, d - plane}; // upside down about its own centre
  MassProperties p;
  p.mass = lower.volume + upper.volume;
  const double moment = lower.moment + d * upper.volume - upper.moment;
  const double zz = lower.zz + d * d * upper.volume - 2.0 * d * upper.moment + upper.zz;
  p.centre.z() = moment / p.mass;
  const double axial = lower.axial + upper.axial;
  // About a transverse axis a stack of discs has half its axial moment and the second moment along z.
  const double transverse = 0.5 * axial + zz - p.mass * p.centre.z() * p.centre.z();
  p.inertia.diagonal() = Vector{transverse, transverse, axial};
  return p;
}

/// Independent reference: the exact length of the union along each line parallel to z, integrated over y and
/// x by the double exponential (tanh-sinh) rule, which does not mind how the integrand behaves at the ends of
/// a panel. In y, panels end where the discs in the plane x = const begin and cross; in x only where spheres
/// begin, so that the weaker kinks where spheres meet are left to the number of points.
class ColumnQuadrature {
public:
  ColumnQuadrature(std::vector<Sphere> spheres, int points_in_x, int points_in_y)
      : spheres_{std::move(spheres)}, nx_{points_in_x}, ny_{points_in_y} {}

  [[nodiscard]] MassProperties properties() const {
    std::vector<double> ends;
    for (const Sphere& s : spheres_) {
      ends.insert(ends.end(), {s.centre.x() - s.radius, s.centre.x() + s.radius});
    }
    Moments m = Moments::Zero();
    over_panels(ends, nx_, [&](double x, double weight) { m += weight * plane(x); });
    MassProperties p;
    p.mass = m[0];
    p.centre = Vector{m[1], m[2], m[3]} / m[0];
    Matrix second;
    second << m[4], m[5], m[6], m[5], m[7], m[8], m[6], m[8], m[9];
    second -= p.mass * p.centre * p.centre.transpose();
    p.inertia = second.trace() * Matrix::Identity() - second;
    return p;
  }

private:
  using Moments = Eigen::Array<double, 10, 1>; // of 1, x, y, z, xx, xy, xz, yy, yz, zz

  template <class F>
  static void over_panels(std::vector<double>& ends, int points, const F& f) {
    std::sort(ends.begin(), ends.end());
    for (std::size_t i = 1; i < ends.size(); ++i) {
      const double middle = 0.5 * (ends[i] + ends[i - 1]);
      const double half = 0.5 * (ends[i] - ends[i - 1]);
      if (half < 1e-12) {
        continue;
      }
      for (int k = 0; k < points; ++k) {
        const double step = 6.0 / points;
        const double u = -3.0 + step * (k + 0.5);
        const double inner = 0.5 * pi * std::sinh(u);
        const double slope = 0.5 * pi * std::cosh(u) / (std::cosh(inner) * std::cosh(inner));
        f(middle + half * std::tanh(inner), half * slope * step);
      }
    }
  }

  [[nodiscard]] Moments plane(double x) const {
    struct Disc {
      double y, z, squared_radius;
    };
    std::vector<Disc> discs;
    for (const Sphere& s : spheres_) {
      const double dx = x - s.centre.x();
      if (std::abs(dx) < s.radius) {
        discs.push_back({s.centre.y(), s.centre.z(), s.radius * s.radius - dx * dx});
      }
    }
    std::vector<double> ends;
    for (std::size_t i = 0; i < discs.size(); ++i) {
      const Disc& a = discs[i];
      const double radius = std::sqrt(a.squared_radius);
      ends.insert(ends.end(), {a.y - radius, a.y + radius});
      for (std::size_t j = i + 1; j < discs.size(); ++j) {
        const Disc& b = discs[j];
        const double squared = (b.y - a.y) * (b.y - a.y) + (b.z - a.z) * (b.z - a.z);
        const double along = 0.5 * (1.0 + (a.squared_radius - b.squared_radius) / squared);
        const double across = a.squared_radius / squared - along * along;
        if (across > 0.0) {
          const double middle = a.y + along * (b.y - a.y);
          const double half = std::sqrt(across) * (b.z - a.z);
          ends.insert(ends.end(), {middle - half, middle + half});
        }
      }
    }
    Moments sum = Moments::Zero();
    std::vector<std::pair<double, double>> intervals;
    over_panels(ends, ny_, [&](double y, double weight) {
      intervals.clear();
      for (const Disc& d : discs) {
        const double squared = d.squared_radius - (y - d.y) * (y - d.y);
        if (squared > 0.0) {
          intervals.emplace_back(d.z - std::sqrt(squared), d.z + std::sqrt(squared));
        }
      }
      std::sort(intervals.begin(), intervals.end());
      double reached = -std::numeric_limits<double>::infinity();
      double z0 = 0.0, z1 = 0.0, z2 = 0.0; // integrals of 1, z, zz along the column
      for (const auto& [from, to] : intervals) {
        const double start = std::max(from, reached);
        if (to > start) {
          z0 += to - start;
          z1 += (to * to - start * start) / 2.0;
          z2 += (to * to * to - start * start * start) / 3.0;
          reached = to;
        }
      }
      Moments m;
      m << z0, x * z0, y * z0, z1, x * x * z0, x * y * z0, x * z1, y * y * z0, y * z1, z2;
      sum += weight * m;
    });
    return sum;
  }

  std::vector<Sphere> spheres_;
  int nx_, ny_;
};

std::vector<Sphere> moved(std::vector<Sphere> spheres, const Quaternion& turn, const Vector& shift) {
  for (Sphere& s : spheres) {
    s.centre = turn * s.centre + shift;
  }
  return spheres;
}

/// Largest difference relative to volume, size and largest moment of inertia.
double difference(const MassProperties& a, const MassProperties& b) {
  const double size = std::cbrt(b.mass);
  return std::max({std::abs(a.mass / b.mass - 1.0), (a.centre - b.centre).norm() / size,
                   (a.inertia - b.inertia).norm() / b.inertia.norm()});
}

std::vector<Sphere> random_spheres(int count, Random& random) {
  std::vector<Sphere> spheres;
  for (int i = 0; i < count; ++i) {
    const Vector centre{random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)};
    spheres.push_back({centre, random.uniform(0.3, 0.8)});
  }
  return spheres;
}

} // namespace

TEST_CASE("one sphere has its closed form to the bit") {
  const Vector centre{0.1, -0.7, 13.3};
  const std::vector<Sphere> one{{centre, 0.3}};
  for (const auto& p : {union_properties(one), sum_of_spheres_properties(one)}) {
    CHECK(p.mass == test::about(4.0 / 3.0 * pi * 0.027, 1e-15));
    CHECK(p.centre == centre);
    CHECK(p.inertia(0, 0) == test::about(0.4 * p.mass * 0.09, 1e-15));
    CHECK(p.inertia == Matrix(p.inertia(0, 0) * Matrix::Identity()));
  }
}

TEST_CASE("union of two spheres follows the lens formula in volume, centre and inertia") {
  Random random{1};
  for (const double r2 : {1.0, 0.8, 0.5, 0.1}) {
    // From almost contained to almost apart, on axes along and across the direction in which the union is
    // cut.
    for (const double part : {1e-12, 1e-8, 1e-4, 0.1, 0.5, 0.9, 1.0 - 1e-4, 1.0 - 1e-8, 1.0 - 1e-12}) {
      const double d = (1.0 - r2) + part * (2.0 * r2);
      const MassProperties expected = two_spheres_on_z(1.0, r2, d);
      const std::vector<Sphere> pair{{Vector::Zero(), 1.0}, {Vector{0.0, 0.0, d}, r2}};
      const Quaternion across{Eigen::AngleAxisd{0.5 * pi, Vector::UnitX()}};
      for (const Quaternion& turn :
           {Quaternion::Identity(), across, random.orientation(), random.orientation()}) {
        const Vector shift{0.3, -0.2, 0.1};
        const MassProperties found = union_properties(moved(pair, turn, shift));
        const Matrix r = turn.toRotationMatrix();
        CAPTURE(r2);
        CAPTURE(part);
        CHECK(std::abs(found.mass / expected.mass - 1.0) < 1e-9);
        CHECK((found.centre - (turn * expected.centre + shift)).norm() < 1e-9);
        const Matrix inertia = r.transpose() * found.inertia * r;
        CHECK((inertia - expected.inertia).cwiseAbs().maxCoeff() < 1e-9 * expected.inertia(2, 2));
      }
    }
  }
}

TEST_CASE("the lens formula used as reference is right where it is known otherwise") {
  // Two unit spheres at distance 1: the common lens has the volume 5 pi / 12.
  CHECK(two_spheres_on_z(1.0, 1.0, 1.0).mass == test::about(8.0 / 3.0 * pi - 5.0 / 12.0 * pi, 1e-14));
  // Touching spheres are two whole ones.
  const auto touching = two_spheres_on_z(1.0, 0.5, 1.5);
  const std::vector<Sphere> pair{{Vector::Zero(), 1.0}, {Vector{0.0, 0.0, 1.5}, 0.5}};
  CHECK(difference(touching, sum_of_spheres_properties(pair)) < 1e-14);
}

TEST_CASE("disjoint and touching spheres: union and sum are the same") {
  Random random{2};
  const std::vector<Sphere> apart{{{0.0, 0.0, 0.0}, 1.0},
                                  {{2.0, 0.0, 0.0}, 1.0},
                                  {{0.0, 0.0, 1.5}, 0.5},
                                  {{0.0, -3.0, 0.0}, 0.7},
                                  {{5.0, 5.0, 5.0}, 0.1}};
  CHECK(difference(union_properties(apart), sum_of_spheres_properties(apart)) < 1e-12);
  const auto turned = moved(apart, random.orientation(), Vector::Zero());
  CHECK(difference(union_properties(turned), sum_of_spheres_properties(turned)) < 1e-12);
}

TEST_CASE("spheres inside others, touching from inside, and equal ones add nothing") {
  Random random{3};
  const auto some = random_spheres(4, random);
  auto more = some;
  more.push_back(some[1]);
  more.push_back(some[1]);
  more.push_back({some[0].centre, 0.5 * some[0].radius});
  more.push_back({some[2].centre + Vector{0.5 * some[2].radius, 0.0, 0.0}, 0.5 * some[2].radius});
  CHECK(difference(union_properties(more), union_properties(some)) < 1e-13);
}

TEST_CASE("almost equal spheres do not spoil the result") {
  Random random{4};
  const auto some = random_spheres(3, random);
  const auto expected = union_properties(some);
  for (const double shift : {1e-4, 1e-7, 1e-10, 1e-13}) {
    auto more = some;
    for (int copy = 0; copy < 3; ++copy) {
      for (const Sphere& s : some) {
        more.push_back(
            {s.centre + shift * Vector{random.normal(), random.normal(), random.normal()}, s.radius});
      }
    }
    CAPTURE(shift);
    CHECK(difference(union_properties(more), expected) < 20.0 * shift);
  }
}

TEST_CASE("spheres that share one circle") {
  // All pass through the unit circle about the origin; the inner ones are covered by the two outermost.
  std::vector<Sphere> pencil;
  for (const double z : {-1.0, -0.5, 0.0, 0.25, 1.5}) {
    pencil.push_back({Vector{0.0, 0.0, z}, std::sqrt(1.0 + z * z)});
  }
  const std::vector<Sphere> outermost{pencil.front(), pencil.back()};
  const Quaternion tilt{Eigen::AngleAxisd{0.7, Vector{1.0, 2.0, 3.0}.normalized()}};
  for (const Quaternion& turn : {Quaternion::Identity(), tilt}) {
    CHECK(difference(union_properties(moved(pencil, turn, Vector::Zero())),
                     union_properties(moved(outermost, turn, Vector::Zero()))) < 1e-12);
  }
}

TEST_CASE("a closed cavity counts as empty") {
  // Spheres about the corners and the middles of the faces of a cube of edge 2 close off its centre, which
  // none of them reaches. Filling the cavity with one more sphere adds what is left of it.
  std::vector<Sphere> shell;
  for (const double x : {-1.0, 0.0, 1.0}) {
    for (const double y : {-1.0, 0.0, 1.0}) {
      for (const double z : {-1.0, 0.0, 1.0}) {
        if (std::abs(x) + std::abs(y) + std::abs(z) > 0.0) {
          shell.push_back({Vector{x, y, z}, 0.8});
        }
      }
    }
  }
  auto filled = shell;
  filled.push_back({Vector::Zero(), 0.19}); // within the cavity, whose nearest wall is 0.2 away
  const double own = 4.0 / 3.0 * pi * std::pow(0.19, 3);
  CHECK(union_properties(filled).mass - union_properties(shell).mass == test::about(own, 1e-9));
}

TEST_CASE("the four templates and random clumps agree with quadrature over columns") {
  Random random{5};
  const std::vector<std::vector<Sphere>> clumps{aligned_spheres(), pyramid_of_spheres(), flat_of_spheres(),
                                                single_sphere(), random_spheres(5, random)};
  for (const auto& clump : clumps) {
    const auto spheres = moved(clump, random.orientation(), Vector{0.1, 0.2, 0.3});
    CAPTURE(spheres.size());
    CHECK(difference(union_properties(spheres), ColumnQuadrature{spheres, 200, 20}.properties()) < 1e-6);
  }
}

TEST_CASE("mass properties move and turn with the spheres") {
  Random random{6};
  for (const int count : {2, 3, 4, 8}) {
    const auto spheres = random_spheres(count, random);
    const Quaternion turn = random.orientation();
    const Vector shift{3.0, -4.0, 5.0};
    const auto there = moved(spheres, turn, shift);
    const Matrix r = turn.toRotationMatrix();
    for (const auto& properties : {union_properties, sum_of_spheres_properties}) {
      const auto p = properties(spheres);
      const MassProperties expected{p.mass, turn * p.centre + shift, r * p.inertia * r.transpose()};
      CHECK(difference(properties(there), expected) < 1e-12);
    }
  }
}

TEST_CASE("parallel axes: two clumps far apart add up") {
  Random random{7};
  const auto a = random_spheres(3, random);
  const auto b = moved(random_spheres(4, random), random.orientation(), Vector{6.0, 2.0, -3.0});
  auto both = a;
  both.insert(both.end(), b.begin(), b.end());
  for (const auto& properties : {union_properties, sum_of_spheres_properties}) {
    const auto pa = properties(a);
    const auto pb = properties(b);
    MassProperties expected;
    expected.mass = pa.mass + pb.mass;
    expected.centre = (pa.mass * pa.centre + pb.mass * pb.centre) / expected.mass;
    const Vector d = pb.centre - pa.centre;
    const double reduced = pa.mass * pb.mass / expected.mass;
    expected.inertia =
        pa.inertia + pb.inertia + reduced * (d.squaredNorm() * Matrix::Identity() - d * d.transpose());
    CHECK(difference(properties(both), expected) < 1e-12);
  }
}

TEST_CASE("volume scales with the third and inertia with the fifth power of length") {
  Random random{8};
  const auto spheres = random_spheres(5, random);
  const auto p = union_properties(spheres);
  for (const double factor : {1e-3, 0.02, 7.0}) {
    auto larger = spheres;
    for (Sphere& s : larger) {
      s.centre *= factor;
      s.radius *= factor;
    }
    const auto q = union_properties(larger);
    const MassProperties expected{p.mass * std::pow(factor, 3), p.centre * factor,
                                  p.inertia * std::pow(factor, 5)};
    CHECK(difference(q, expected) < 1e-12);
  }
}

TEST_CASE("sum of spheres counts an overlap as often as it occurs") {
  // Two equal spheres of unit radius half a metre off the origin, whatever they overlap.
  const std::vector<Sphere> pair{{{-0.5, 0.0, 0.0}, 1.0}, {{0.5, 0.0, 0.0}, 1.0}};
  const auto p = sum_of_spheres_properties(pair);
  const double m = 4.0 / 3.0 * pi;
  CHECK(p.mass == test::about(2.0 * m, 1e-15));
  CHECK(p.centre.norm() < 1e-15);
  const Vector expected{2.0 * m * 0.4, 2.0 * m * 0.65, 2.0 * m * 0.65};
  CHECK((p.inertia - Matrix(expected.asDiagonal())).norm() < 1e-14);
}

TEST_CASE("bad spheres are refused with their number") {
  const auto complaint = [](const std::vector<Sphere>& spheres) -> std::string {
    try {
      (void)union_properties(spheres);
    } catch (const Error& e) {
      return e.what();
    }
    return "accepted";
  };
  const Sphere good{Vector::Zero(), 1.0};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  CHECK(complaint({}).find("empty") != std::string::npos);
  CHECK(complaint({good, {Vector::Zero(), 0.0}}).find("sphere 2: radius = 0 m") != std::string::npos);
  CHECK(complaint({good, {Vector::Zero(), -1.0}}).find("sphere 2: radius = -1 m") != std::string::npos);
  CHECK(complaint({good, good, {Vector::Zero(), nan}}).find("sphere 3: radius") != std::string::npos);
  CHECK(complaint({{Vector{0.0, nan, 0.0}, 1.0}}).find("sphere 1: its centre") != std::string::npos);
  CHECK(complaint({{Vector{0.0, 0.0, infinite}, 1.0}}).find("sphere 1: its centre") != std::string::npos);
  CHECK_THROWS_AS((void)sum_of_spheres_properties({}), Error);
}

} // namespace sphere_union_tests
