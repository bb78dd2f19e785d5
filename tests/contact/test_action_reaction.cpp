/// \file
/// A law sees a pair from either side alike.

#include "scree/contact/hertz_mindlin.hpp"
#include "scree/contact/linear_spring.hpp"
#include "scree/contact/rolling_resistance.hpp"
#include "scree/core/random.hpp"
#include "scree/simulation/pair_loop.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

using namespace scree;

namespace action_reaction_tests {

namespace {

const Material rock{.normal_stiffness = 1e6,
                    .shear_stiffness = 8e5,
                    .youngs_modulus = 1e9,
                    .friction = 0.4,
                    .restitution = 0.6,
                    .rolling_friction = 0.1};

Vector random_vector(Random& random) {
  return {random.normal(), random.normal(), random.normal()};
}

double off(const Vec3<double>& a, const Vec3<double>& b) {
  return norm(a - b) / (norm(a) + norm(b) + 1e-300);
}

} // namespace

TEST_CASE_TEMPLATE("the same motion seen from i and from j gives opposite forces and the same work", Law,
                   LinearSpring<>, HertzMindlin<>, LinearSpring<RollingResistance>,
                   HertzMindlin<RollingResistance>) {
  const auto pair = mix(rock, rock, Stiffness::of_contact);
  Random random{1};
  int slid = 0, stuck = 0;
  for (int contact = 0; contact < 40; ++contact) {
    SphereRecord<double> i, j;
    i.radius = 0.01;
    j.radius = 0.014;
    i.inverse_mass = 80.0;
    j.inverse_mass = 30.0;
    std::array<double, static_cast<std::size_t>(Law::history_size)> history{}, mirrored{};
    const double dt = 1e-6;
    const Vector apart = 0.02395 * random_vector(random).normalized();
    Vector between = apart;
    const Vector velocity = 0.1 * random_vector(random);
    const double slow = contact % 2 == 0 ? 1.0 : 0.01;
    for (int k = 0; k < 200; ++k) {
      between += slow * velocity * dt;
      between = between.normalized() * 0.02395 * (1.0 - 1e-4 * k / 200.0);
      i.velocity = to_vec3(Vector(slow * velocity));
      i.angular_velocity = to_vec3(Vector(10.0 * slow * random_vector(random)));
      j.angular_velocity = to_vec3(Vector(5.0 * slow * random_vector(random)));
      const Vec3<double> d = to_vec3(between);
      const auto from_i = touch_of(i, j, d, squared_norm(d), dt);
      const auto from_j = touch_of(j, i, -d, squared_norm(d), dt);
      REQUIRE(from_i.arm_i == from_j.arm_j);
      const auto f = Law{}.evaluate(pair, from_i.kinematics, history);
      const auto g = Law{}.evaluate(pair, from_j.kinematics, mirrored);
      REQUIRE(f.normal == g.normal);
      REQUIRE(off(f.tangential, -g.tangential) < 1e-12);
      if (norm(f.couple) > 0.0) {
        REQUIRE(off(f.couple, -g.couple) < 1e-12);
      }
      REQUIRE(std::abs(f.frictional_work - g.frictional_work) <
              1e-12 * (std::abs(f.frictional_work) + 1e-12));
      REQUIRE(std::abs(f.viscous_work - g.viscous_work) < 1e-12 * (std::abs(f.viscous_work) + 1e-12));
      double scale = 0.0, worst = 0.0;
      for (std::size_t h = 0; h < history.size(); ++h) {
        scale = std::max(scale, std::abs(history[h]));
        worst = std::max(worst, std::abs(history[h] - Law::history_parity[h] * mirrored[h]));
      }
      REQUIRE(worst < 1e-12 * scale);
      (norm(f.tangential) > pair.friction * f.normal * (1.0 - 1e-9) ? slid : stuck) += 1;
    }
  }
  // Both branches of the law were taken.
  CHECK(slid > 100);
  CHECK(stuck > 100);
}

} // namespace action_reaction_tests
