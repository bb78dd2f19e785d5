/// \file
/// What a model in float gives beside the same in double: a bed at rest, an oedometer, a heap.

#include "scree/core/random.hpp"
#include "scree/measure/unbalanced_force.hpp"
#include "scree/simulation/run.hpp"
#include "scree/simulation/simulation.hpp"
#include "support/models.hpp"
#include "support/relative_error.hpp"
#include "support/scenes.hpp"
#include "validation/scatter.hpp"

#include <boost/math/statistics/linear_regression.hpp>
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

using namespace scree;

namespace single_precision_tests {

namespace {

constexpr double tube_radius = 0.04; // m
constexpr std::size_t stones = 160;

/// Stones in a tube with a floor, under a lid that is far above them at first.
template <class Number>
class Tube {
public:
  static constexpr std::size_t floor = 0, side = 1, lid = 2;

  explicit Tube(const Packing& packing, double gravity = 9.81)
      : simulation{{.gravity = {0.0, 0.0, -gravity}, .local_damping = 0.3}} {
    const auto rock = simulation.add_material({.density = 2600.0,
                                               .normal_stiffness = 4e4,
                                               .shear_stiffness = 4e4,
                                               .friction = 0.5,
                                               .restitution = 0.3});
    simulation.add_wall({.name = "floor", .surfaces = {{Plane{}, rock}}, .dynamics = Fixed{}});
    simulation.add_wall({.name = "side",
                         .surfaces = {{Cylinder{.radius = tube_radius}, rock}},
                         .dynamics = Prescribed::constant_velocity(Vector::Zero())});
    simulation.add_wall({.name = "lid",
                         .surfaces = {{Plane{.normal = -Vector::UnitZ()}, rock}},
                         .dynamics = Prescribed::constant_velocity(
                             Vector::Zero(), {{0.0, 0.0, 1.0}, Quaternion::Identity()})});
    simulation.add(packing);
  }

  [[nodiscard]] double top() const {
    double most = 0.0;
    for (const auto& sphere : simulation.bodies().spheres()) {
      most = std::max(most, sphere.position.z + sphere.radius);
    }
    return most;
  }

  Simulation<test::ModelOf<LinearSpring<>, Number>> simulation;
};

/// Stones that fell into the tube and lie at rest, in double.
Packing settled(std::uint64_t seed, double gravity = 9.81) {
  Packing packing{{test::stone(0.005)}, {}};
  Random random{seed, "single precision"};
  const double pitch = 0.0135;
  for (std::size_t k = 0; packing.bodies.size() < stones; ++k) {
    const Vector at{pitch * (static_cast<double>(k % 5) - 2.0),
                    pitch * (static_cast<double>(k / 5 % 5) - 2.0),
                    pitch * (static_cast<double>(k / 25) + 0.6)};
    if (std::hypot(at.x(), at.y()) < tube_radius - 0.0075) {
      PackedBody body;
      body.scale = random.uniform(0.8, 1.1);
      body.position = at;
      body.orientation = random.orientation();
      packing.bodies.push_back(body);
    }
  }
  Tube<double> tube{packing, gravity};
  double unbalanced = 1.0;
  while (unbalanced > 1e-8 && tube.simulation.time() < 10.0) {
    run_for(tube.simulation, 0.1);
    unbalanced = unbalanced_force(tube.simulation).ratio();
  }
  REQUIRE(unbalanced <= 1e-8);
  const auto& bodies = tube.simulation.bodies();
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    PackedBody& body = packing.bodies.at(bodies.id(b));
    body.position = bodies.position(b);
    body.orientation = bodies.orientation(b);
  }
  return packing;
}

struct Lying {
  double unbalanced;
  std::vector<Vector> places;
};

template <class Number>
Lying lying(const Packing& packing) {
  Tube<Number> tube{packing};
  run_for(tube.simulation, 0.2);
  const auto& bodies = tube.simulation.bodies();
  Lying out{unbalanced_force(tube.simulation).ratio(), std::vector<Vector>(bodies.size())};
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    out.places.at(bodies.id(b)) = bodies.position(b);
  }
  return out;
}

/// So much that stones hold each other fast: m/s2. In a loose bed they slip into new places as a lid comes
/// down, and 1e-12 m in where they lie changes the slope by a fifth.
constexpr double strong_gravity = 300.0;

/// N/m, of the lid's force over its way.
template <class Number>
double oedometer_slope(const Packing& packing) {
  Tube<Number> tube{packing, strong_gravity};
  auto& s = tube.simulation;
  constexpr double speed = 0.005, least = 5.0, most = 40.0; // m/s, N
  constexpr std::size_t lid = Tube<Number>::lid;
  s.template dynamics<Prescribed>(lid) =
      Prescribed::constant_velocity({0.0, 0.0, -speed}, {{0.0, 0.0, tube.top()}, Quaternion::Identity()});
  std::vector<double> ways, forces;
  double force = 0.0;
  run_while(
      s, [&](const auto&) { return force < most; },
      [&](const auto& now) {
        force = now.wall(lid).load.force.z();
        if (force > least) {
          ways.push_back(speed * now.time());
          forces.push_back(force);
        }
      });
  return boost::math::statistics::simple_ordinary_least_squares(ways, forces).second;
}

/// Degrees, of the heap that is left where the tube was lifted.
template <class Number>
double heap_angle(const Packing& packing) {
  Tube<Number> tube{packing};
  auto& s = tube.simulation;
  s.template dynamics<Prescribed>(Tube<Number>::side) = Prescribed::constant_velocity({0.0, 0.0, 0.1});
  run_for(s, 0.8);
  // The highest point in each sector of each ring but the innermost, 0 where there is none.
  constexpr std::size_t sectors = 12, rings = 5;
  constexpr double width = 0.012; // m
  std::array<std::array<double, sectors>, rings> top{};
  for (const auto& sphere : s.bodies().spheres()) {
    const double r = std::hypot(sphere.position.x, sphere.position.y);
    const double turn = 0.5 + 0.5 * std::atan2(sphere.position.y, sphere.position.x) / std::numbers::pi;
    const auto ring = static_cast<std::size_t>(r / width);
    const auto sector = std::min(sectors - 1, static_cast<std::size_t>(turn * sectors));
    if (ring < rings) {
      top[ring][sector] = std::max(top[ring][sector], sphere.position.z + sphere.radius);
    }
  }
  std::vector<double> radii, heights;
  for (std::size_t ring = 1; ring < rings; ++ring) {
    for (const double height : top[ring]) {
      radii.push_back((static_cast<double>(ring) + 0.5) * width);
      heights.push_back(height);
    }
  }
  const double slope = boost::math::statistics::simple_ordinary_least_squares(radii, heights).second;
  return std::atan(-slope) * 180.0 / std::numbers::pi;
}

} // namespace

TEST_CASE("physics: a bed that rests in double rests in float, at the same place") {
  const Packing bed = settled(1);
  const Lying exact = lying<double>(bed), coarse = lying<float>(bed);
  double apart = 0.0, squares = 0.0;
  for (std::size_t b = 0; b < exact.places.size(); ++b) {
    const double d = (coarse.places[b] - exact.places[b]).norm();
    apart = std::max(apart, d);
    squares += d * d;
  }
  MESSAGE("unbalanced force " << exact.unbalanced << " and " << coarse.unbalanced
                              << " of the contact force; places differ by "
                              << 1e6 * std::sqrt(squares / static_cast<double>(stones))
                              << " um (root mean square), " << 1e6 * apart << " um at most");
  CHECK(exact.unbalanced < 1e-6);
  CHECK(coarse.unbalanced < 1e-4);
  // Float resolves 6e-8 of an overlap of some um; what slips adds to it.
  CHECK(apart < 1e-8);
}

TEST_CASE("physics: an oedometer has the slope in float that it has in double") {
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    const Packing bed = settled(seed, strong_gravity);
    const double exact = oedometer_slope<double>(bed), coarse = oedometer_slope<float>(bed);
    MESSAGE("slope " << exact << " and " << coarse << " N/m, relative difference " << coarse / exact - 1.0);
    // Ours: in double, too, 1e-10 m in where the stones lie changes the slope by up to 0.2 %.
    CHECK(test::relative_error(coarse, exact) < 0.01);
  }
}

TEST_CASE("long: heaps in float are as steep as in double") {
  std::vector<double> angles;
  double most = 0.0;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const Packing bed = settled(seed);
    const double exact = heap_angle<double>(bed), coarse = heap_angle<float>(bed);
    MESSAGE("angle " << exact << " and " << coarse << " degrees");
    angles.push_back(exact);
    most = std::max(most, std::abs(coarse - exact));
  }
  const validation::Mean mean{angles};
  MESSAGE("standard error of the mean angle " << mean.error << " degrees; float differs by up to " << most);
  CHECK(mean.value > 15.0); // it is a heap
  CHECK(most < mean.error);
}

} // namespace single_precision_tests
