#include "support/relative_error.hpp"

#include "scree/material/pair.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

using namespace scree;
using test::relative_error;

namespace {

const Material granite{.name = "granite",
                       .normal_stiffness = 3e6,
                       .shear_stiffness = 2e6,
                       .youngs_modulus = 6e10,
                       .poisson_ratio = 0.25,
                       .friction = 0.6,
                       .restitution = 0.8,
                       .rolling_friction = 0.1,
                       .normal_damping_rate = 10.0,
                       .shear_damping_rate = 2.0};
const Material steel{.name = "steel",
                     .normal_stiffness = 6e6,
                     .shear_stiffness = 6e6,
                     .youngs_modulus = 2e11,
                     .poisson_ratio = 0.3,
                     .friction = 0.3,
                     .restitution = 0.9,
                     .rolling_friction = 0.02,
                     .normal_damping_rate = 30.0,
                     .shear_damping_rate = 6.0};

} // namespace

TEST_CASE("stiffness of particles acts in series, stiffness of contacts as it is") {
  const auto series = mix(granite, steel, Stiffness::of_particle);
  CHECK(relative_error(series.normal_stiffness, 2e6) < 1e-15);
  CHECK(relative_error(series.shear_stiffness, 1.5e6) < 1e-15);
  CHECK(relative_error(series.inverse_shear_stiffness, 1.0 / 1.5e6) < 1e-15);
  const auto direct = mix(granite, steel, Stiffness::of_contact);
  CHECK(direct.normal_stiffness == 3e6);
  CHECK(direct.shear_stiffness == 2e6);
  // The paper's Table 1: 1.75e7 N/m each are 8.75e6 N/m at the contact.
  const Material rock{.normal_stiffness = 1.75e7, .shear_stiffness = 1.75e7};
  CHECK(relative_error(mix(rock, rock, Stiffness::of_particle).normal_stiffness, 8.75e6) < 1e-15);
  CHECK(mix(rock, rock, Stiffness::of_contact).normal_stiffness == 1.75e7);
}

TEST_CASE("no stiffness is no stiffness at the contact, and not infinity") {
  const auto p = mix({}, {}, Stiffness::of_particle);
  CHECK(p.normal_stiffness == 0.0);
  CHECK(p.shear_stiffness == 0.0);
  CHECK(p.inverse_shear_stiffness == 0.0);
  CHECK(p.youngs_modulus == 0.0);
  CHECK(p.shear_modulus == 0.0);
  CHECK(mix(granite, {}, Stiffness::of_particle).normal_stiffness == 0.0);
}

TEST_CASE("moduli mix as Hertz and Mindlin have them") {
  const auto p = mix(granite, steel, Stiffness::of_particle);
  // 1/E* = sum of (1 - nu^2)/E, 1/G* = sum of (2 - nu)/G with G = E / (2 (1 + nu)).
  CHECK(relative_error(1.0 / p.youngs_modulus, (1 - 0.0625) / 6e10 + (1 - 0.09) / 2e11) < 1e-14);
  CHECK(relative_error(1.0 / p.shear_modulus, 1.75 * 2.5 / 6e10 + 1.7 * 2.6 / 2e11) < 1e-14);
}

TEST_CASE("friction and restitution of unlike materials are the smaller, damping rates the mean") {
  const auto p = mix(granite, steel, Stiffness::of_particle);
  CHECK(p.friction == 0.3);
  CHECK(p.rolling_friction == 0.02);
  CHECK(p.damping_ratio == damping_ratio(0.8));
  CHECK(p.normal_damping_rate == 20.0);
  CHECK(p.shear_damping_rate == 4.0);
  CHECK(relative_error(p.normal_damping_coefficient, 2.0 * damping_ratio(0.8) * std::sqrt(2e6)) < 1e-15);
  CHECK(relative_error(p.shear_damping_coefficient, 2.0 * half_oscillation_ratio(0.8) * std::sqrt(1.5e6)) <
        1e-15);
}

TEST_CASE("the order of two materials makes no difference") {
  for (const auto convention : {Stiffness::of_particle, Stiffness::of_contact}) {
    const auto p = mix(granite, steel, convention), q = mix(steel, granite, convention);
    CHECK(p.normal_stiffness == q.normal_stiffness);
    CHECK(p.shear_stiffness == q.shear_stiffness);
    CHECK(p.youngs_modulus == q.youngs_modulus);
    CHECK(p.shear_modulus == q.shear_modulus);
    CHECK(p.friction == q.friction);
    CHECK(p.damping_ratio == q.damping_ratio);
    CHECK(p.normal_damping_rate == q.normal_damping_rate);
  }
}

TEST_CASE("values measured for a pair replace the mixed ones, each by itself and in either order") {
  MaterialTable table;
  const auto g = table.add(granite), s = table.add(steel);
  table.set_pair(s, g, {.friction = 0.45});
  for (const auto& p : {table.pair(g, s), table.pair(s, g)}) {
    CHECK(p.friction == 0.45);
    CHECK(p.rolling_friction == 0.02);
    CHECK(p.damping_ratio == damping_ratio(0.8));
  }
  CHECK(table.pair(g, g).friction == 0.6);
  table.set_pair(g, s, {.restitution = 0.5, .rolling_friction = 0.3});
  CHECK(table.pair(s, g).friction == 0.3); // a new set of values, not an addition to the old
  CHECK(table.pair(s, g).damping_ratio == damping_ratio(0.5));
  CHECK(table.pair(s, g).rolling_friction == 0.3);
}

TEST_CASE("a replaced material changes its pairs") {
  MaterialTable table{Stiffness::of_contact};
  const auto g = table.add(granite), s = table.add(steel);
  table.replace(g, {.name = "chalk", .normal_stiffness = 1e5, .friction = 0.1});
  CHECK(table.at(g).name == "chalk");
  CHECK(table.pair(g, s).normal_stiffness == 1e5);
  CHECK(table.pair(g, s).friction == 0.1);
  CHECK(table.convention() == Stiffness::of_contact);
  CHECK(table.size() == 2);
}

TEST_CASE("the table refuses unknown materials and pair values out of range") {
  MaterialTable table;
  const auto g = table.add(granite), s = table.add(steel);
  CHECK_THROWS_WITH_AS((void)table.at(7), "material number 7 is unknown: the table holds 2", Error);
  CHECK_THROWS_AS(table.replace(2, granite), Error);
  CHECK_THROWS_AS(table.add({.friction = -1.0}), Error);
  CHECK_THROWS_AS(table.replace(g, {.restitution = 2.0}), Error);
  CHECK(table.at(g).name == "granite");
  CHECK_THROWS_WITH_AS(table.set_pair(g, s, {.restitution = 1.5}),
                       "pair 'granite'-'steel': restitution = 1.5 is outside [1e-06, 1]", Error);
  CHECK_THROWS_WITH_AS(table.set_pair(g, s, {.friction = -0.5}),
                       "pair 'granite'-'steel': friction = -0.5 is outside [0, 1.797693135e+308]", Error);
  CHECK_THROWS_AS(table.set_pair(g, s, {.rolling_friction = -0.5}), Error);
  CHECK_THROWS_AS(table.set_pair(g, 5, {}), Error);
  CHECK(table.pair(g, s).friction == 0.3);
}
