#include "scree/material/material.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <string>

using namespace scree;

namespace {

std::string complaint(const Material& m) {
  try {
    validate(m);
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

} // namespace

TEST_CASE("the default material and the ends of every range are accepted") {
  CHECK(complaint({}).empty());
  CHECK(complaint({.normal_stiffness = 0.0, .shear_stiffness = 0.0, .poisson_ratio = 0.0, .friction = 0.0})
            .empty());
  CHECK(complaint({.poisson_ratio = 0.5, .restitution = 1.0}).empty());
  CHECK(complaint({.restitution = 1e-6}).empty());
}

TEST_CASE("a parameter out of its range is refused with material, parameter, value and range") {
  CHECK(complaint({.name = "clay", .restitution = 1.1}) ==
        "material 'clay': restitution = 1.1 is outside [1e-06, 1]");
  CHECK(complaint({.name = "clay", .restitution = 0.0}) ==
        "material 'clay': restitution = 0 is outside [1e-06, 1]");
  CHECK(complaint({.name = "clay", .poisson_ratio = 0.51}) ==
        "material 'clay': poisson_ratio = 0.51 is outside [0, 0.5]");
  CHECK(complaint({.name = "clay", .density = -1.0}) ==
        "material 'clay': density = -1 kg/m3 must be a finite number above 0");
  // Ranges without an upper end of their own end at the largest number.
  const std::string open = ", 1.797693135e+308]";
  CHECK(complaint({.name = "clay", .friction = -0.1}) ==
        "material 'clay': friction = -0.1 is outside [0" + open);
  CHECK(complaint({.name = "clay", .normal_stiffness = -5.0}) ==
        "material 'clay': normal_stiffness = -5 N/m is outside [0" + open + " N/m");
  CHECK(complaint({.name = "clay", .shear_stiffness = -5.0}) ==
        "material 'clay': shear_stiffness = -5 N/m is outside [0" + open + " N/m");
  CHECK(complaint({.name = "clay", .youngs_modulus = -5.0}) ==
        "material 'clay': youngs_modulus = -5 Pa is outside [0" + open + " Pa");
  CHECK(complaint({.name = "clay", .rolling_friction = -0.2}) ==
        "material 'clay': rolling_friction = -0.2 is outside [0" + open);
  CHECK(complaint({.name = "clay", .normal_damping_rate = -1.0}) ==
        "material 'clay': normal_damping_rate = -1 1/s is outside [0" + open + " 1/s");
  CHECK(complaint({.name = "clay", .shear_damping_rate = -1.0}) ==
        "material 'clay': shear_damping_rate = -1 1/s is outside [0" + open + " 1/s");
}

TEST_CASE("a parameter that is not a finite number is refused") {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    for (double Material::*field :
         {&Material::density, &Material::normal_stiffness, &Material::shear_stiffness,
          &Material::youngs_modulus, &Material::poisson_ratio, &Material::friction, &Material::restitution,
          &Material::rolling_friction, &Material::normal_damping_rate, &Material::shear_damping_rate}) {
      Material m;
      m.*field = bad;
      CHECK_THROWS_AS(validate(m), Error);
    }
  }
}
