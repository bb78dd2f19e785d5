#include "scree/laboratory/oedometer.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>

using namespace scree;

namespace {

/// Few grains, pressed fast: what is checked here holds at any speed.
OedometerSetup quick() {
  OedometerSetup setup = desk_oedometer();
  setup.container = {.radius = 0.1, .height = 0.08};
  setup.low_stress = 1e3;
  setup.high_stress = 5e3;
  setup.cycles = 2;
  setup.strain_rate = 0.5;
  setup.most_inertial_number = 1.0;
  setup.points = 60;
  setup.threads = 1;
  return setup;
}

} // namespace

TEST_CASE("physics: an oedometer loads, unloads and loads again between its two stresses") {
  Oedometer<> oedometer{quick()};
  const OedometerResult& r = oedometer.run();
  const double area = oedometer.setup().container.area();
  REQUIRE(r.cycles.size() == 2);
  REQUIRE(r.curve.size() > 100);
  CHECK(r.cycles[0].hysteresis > 0.0);
  CHECK_FALSE(r.cycles[1].unloaded);
  CHECK(r.cycles[0].permanent > 0.0);
  CHECK(r.cycles[0].unloading_modulus > r.cycles[0].modulus);
  CHECK(r.slope == r.cycles[1].slope);
  CHECK(r.modulus == doctest::Approx(r.slope * r.height / area));
  // The lid stands on the highest of what was struck off at the brim.
  CHECK(r.height > 0.95 * oedometer.setup().container.height);
  CHECK(r.height < oedometer.setup().container.height + 0.03);

  // Lid, weight and mantle are what the base carries, but for the grains' inertia.
  double weight = 0.0;
  for (std::size_t b = 0; b < oedometer.simulation().bodies().size(); ++b) {
    weight += 9.81 * oedometer.simulation().bodies().mass(b);
  }
  double misfit = 0.0, most = 0.0;
  for (const OedometerPoint& p : r.curve) {
    misfit += std::pow(p.lid_force + weight - p.mantle_force - p.base_force, 2);
    most = std::max(most, p.lid_force);
    CHECK(p.displacement > -1e-6);
  }
  CHECK(most < 1.1 * oedometer.setup().high_stress * area);
  CHECK(most > 0.9 * oedometer.setup().high_stress * area);
  CHECK(std::sqrt(misfit / static_cast<double>(r.curve.size())) < 0.05 * most);
}

TEST_CASE("physics: many grains bear a lid that is seated, and give way once instead of while it is loaded") {
  struct Bed {
    double bearing = 0.0, permanent = 0.0; // contacts of the lid at the end, m after the first cycle
  };
  const auto mean_of_beds = [](bool seated) {
    constexpr std::uint64_t beds = 3;
    Bed mean;
    for (std::uint64_t seed = 1; seed <= beds; ++seed) {
      OedometerSetup setup = quick();
      setup.seed = seed;
      setup.seated = seated;
      setup.fill.surplus = 0.5;
      setup.fill.packing_friction = 0.1;
      Oedometer<> oedometer{setup};
      mean.permanent += oedometer.run().cycles.front().permanent / static_cast<double>(beds);
      const auto& simulation = oedometer.simulation();
      simulation.visit_contacts([&](const ContactView& contact) {
        const bool lid = contact.with_wall && simulation.wall(contact.second).name == "lid";
        mean.bearing += lid ? 1.0 / static_cast<double>(beds) : 0.0;
      });
      CHECK(simulation.materials().at(0).friction == setup.sample.rock.friction); // their own again
    }
    return mean;
  };
  const Bed seated = mean_of_beds(true), laid_on = mean_of_beds(false);
  CAPTURE(seated.bearing);
  CAPTURE(laid_on.bearing);
  CAPTURE(seated.permanent);
  CAPTURE(laid_on.permanent);
  CHECK(seated.bearing > 1.3 * laid_on.bearing);
  CHECK(seated.permanent < 0.5 * laid_on.permanent);
}

TEST_CASE("physics: four times the stiffness, density and load make four times the slope") {
  OedometerSetup setup = quick();
  const double once = Oedometer<>{setup}.run().slope;
  // A power of 4, of which the root is a power of 2 too: the motion is then the same to the bit.
  for (Material* m : {&setup.sample.rock, &setup.sample.rig}) {
    m->density *= 4.0;
    m->normal_stiffness *= 4.0;
    m->shear_stiffness *= 4.0;
  }
  setup.low_stress *= 4.0;
  setup.high_stress *= 4.0;
  CHECK(Oedometer<>{setup}.run().slope == doctest::Approx(4.0 * once).epsilon(1e-9));
}

TEST_CASE("physics: stiffer grains make a stiffer bed") {
  // One bed of so few grains is 1.6 to 3.8 times as stiff.
  const auto mean_modulus = [](double factor) {
    constexpr std::uint64_t beds = 4;
    double sum = 0.0;
    for (std::uint64_t seed = 1; seed <= beds; ++seed) {
      OedometerSetup setup = quick();
      setup.seed = seed;
      for (Material* m : {&setup.sample.rock, &setup.sample.rig}) {
        m->normal_stiffness *= factor;
        m->shear_stiffness *= factor;
      }
      sum += Oedometer<>{setup}.run().modulus;
    }
    return sum / static_cast<double>(beds);
  };
  CHECK(mean_modulus(4.0) > 1.5 * mean_modulus(1.0));
}

TEST_CASE("Oedometer refuses what cannot be done") {
  OedometerSetup setup = quick();
  setup.high_stress = setup.low_stress;
  CHECK_THROWS_WITH_AS(Oedometer<>{setup}, doctest::Contains("high_stress = 1000"), Error);
  setup = quick();
  setup.strain_rate = 0.0;
  CHECK_THROWS_WITH_AS(Oedometer<>{setup}, doctest::Contains("strain_rate = 0"), Error);
  setup = quick();
  setup.slope_to = 0.2;
  CHECK_THROWS_WITH_AS(Oedometer<>{setup}, doctest::Contains("slope_to = 0.2"), Error);
  setup = quick();
  setup.cycles = 0;
  CHECK_THROWS_WITH_AS(Oedometer<>{setup}, doctest::Contains("cycles"), Error);
}

TEST_CASE("an oedometer is quasi-static by its inertial number, or refused") {
  OedometerSetup setup = desk_oedometer();
  const double number = setup.strain_rate * setup.sample.assembly.mean_diameter() *
                        std::sqrt(setup.sample.rock.density / setup.low_stress);
  CHECK(Oedometer<>{setup}.result().inertial_number == doctest::Approx(number));
  CHECK(number < 1e-3);
  CHECK(Oedometer<>{{}}.result().inertial_number < 1e-3);
  setup.strain_rate *= 1.01e-3 / number;
  CHECK_THROWS_WITH_AS(Oedometer<>{setup}, doctest::Contains("above most_inertial_number = 0.001"), Error);
}

TEST_CASE("physics: a lid that finds no resistance says so") {
  OedometerSetup setup = quick();
  setup.high_stress = 1e7;
  setup.strain_rate = 2.0;
  CHECK_THROWS_WITH_AS(Oedometer<>{setup}.run(), doctest::Contains("the lid has sunk"), Error);
}
