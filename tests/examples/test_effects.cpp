#include "diagnose/catalogue.hpp"
#include "laboratory/diagnosis_plans.hpp"
#include "laboratory/measured_folder.hpp"
#include "make_measured/effects.hpp"
#include "make_measured/faults.hpp"
#include "support/scratch_folder.hpp"

#include "scree/io/atomic_file.hpp"
#include "scree/laboratory/rock_parameters.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

using namespace scree;

namespace {

examples::Plan plan_of(const char* name) {
  const test::ScratchFolder scratch;
  write_atomically(scratch.path() / "calibration.toml", examples::diagnosis_plan(name, 6).toml);
  return examples::read_plan(scratch.path(), examples::Data::none);
}
examples::Plan mini() {
  return plan_of("mini");
}

std::string complaint(const std::string& effects, const char* plan = "mini") {
  Random random{1};
  try {
    (void)make_measured::effects_in(effects, plan_of(plan), random);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

} // namespace

TEST_CASE("effects are read with values in their units or drawn from the seed, and each has its cause") {
  const examples::Plan plan = mini();
  Random random{1}, again{1};
  const auto given = make_measured::effects_in("adhesion=1.5,damping=0.3", plan, random);
  REQUIRE(given.size() == 2);
  CHECK(given[0].parameter.name == "adhesion");
  CHECK(given[0].value == 1.5);
  CHECK(given[1].parameter.name == "restitution");
  const auto drawn = make_measured::effects_in("size_scale=auto", plan, random);
  CHECK(drawn[0].value == make_measured::effects_in("size_scale=auto", plan, again)[0].value);
  CHECK(drawn[0].value > plan.model.sample.assembly.size_factor());

  for (const Cause& cause : diagnose::catalogue(plan, "")) {
    CAPTURE(cause.name);
    const auto effects = make_measured::effects_in(cause.name + "=auto", plan, random);
    REQUIRE(effects.size() == cause.parameters.size());
    CHECK(effects.front().value != doctest::Approx(cause.null.front()).epsilon(0.05));
    for (std::size_t k = 0; k < effects.size(); ++k) {
      CHECK(effects[k].parameter.name == cause.parameters[k].name);
      CHECK(effects[k].value > cause.parameters[k].least);
      CHECK(effects[k].value < cause.parameters[k].most);
    }
  }
}

TEST_CASE("effects of the rig have their causes too, with a value for each of their parameters") {
  const examples::Plan plan = plan_of("drag");
  Random random{1};
  std::size_t of_two = 0;
  for (const Cause& cause : diagnose::catalogue(plan, "")) {
    CAPTURE(cause.name);
    const auto drawn = make_measured::effects_in(cause.name + "=auto", plan, random);
    REQUIRE(drawn.size() == cause.parameters.size());
    of_two += drawn.size() == 2 ? 1 : 0;
    for (std::size_t k = 0; k < drawn.size(); ++k) {
      CHECK(drawn[k].name == cause.name);
      CHECK(drawn[k].parameter.name == cause.parameters[k].name);
      CHECK(drawn[k].value != cause.null[k]);
      CHECK(drawn[k].value > cause.parameters[k].least);
      CHECK(drawn[k].value < cause.parameters[k].most);
    }
  }
  CHECK(of_two == 3); // shapes, load cell and bucket

  const auto first = make_measured::effects_in("load_cell=1.2", plan, random);
  REQUIRE(first.size() == 1);
  CHECK(first[0].parameter.name == "load_cell_gain");
  CHECK(first[0].value == 1.2);
  const auto both = make_measured::effects_in("load_cell=1.2:-8,bucket_inertia=1.4:auto", plan, random);
  REQUIRE(both.size() == 4);
  CHECK(both[1].parameter.name == "load_cell_offset");
  CHECK(both[1].parameter.unit == "N");
  CHECK(both[1].value == -8.0);
  CHECK(both[2].value == 1.4);
  CHECK(both[3].parameter.name == "bucket_inertia");
}

TEST_CASE("effects that make no sense are refused") {
  CHECK(complaint("rope_stiffness=0.2") ==
        "effect = rope_stiffness=0.2: only experiments of the kind drag show it, and this plan has none");
  CHECK(complaint("load_cell=1.2:3:4", "drag") ==
        "effect = load_cell=1.2:3:4: '3:4' is neither a number nor auto");
  CHECK(complaint("rope_stiffness=0.2:3", "drag") ==
        "effect = rope_stiffness=0.2:3: rope_stiffness has one parameter, rope_stiffness");
  CHECK(complaint("load_cell=1.2:much", "drag") ==
        "effect = load_cell=1.2:much: 'much' is neither a number nor auto");
  CHECK(complaint("load_cell=20", "drag") == "effect load_cell = 20 is outside [0.1, 10]");
  CHECK(complaint("wind=3").find(
            "effect = wind=3: there is no effect 'wind'; there are rolling_resistance") == 0);
  CHECK(complaint("adhesion") == "effect = adhesion: '' is neither a number nor auto");
  CHECK(complaint("damping=2") == "effect damping = 2 is outside [0.01, 1]");
  CHECK(complaint("particle_density=2000") ==
        "effect = particle_density=2000: particle_density is a base parameter of this plan");
}

TEST_CASE("effects in another form are of the same cause, with parameters that no cause has") {
  const examples::Plan plan = mini();
  const auto causes = diagnose::catalogue(plan, "");
  for (const char* form : {"rolling_resistance:dashpot", "damping:local", "shape_fraction:third_shape"}) {
    CAPTURE(form);
    Random random{1};
    const auto effects = make_measured::effects_in(std::string{form} + "=auto", plan, random);
    const make_measured::Effect& last = effects.back(); // what makes the form another
    CHECK(last.name + ":" + last.form == form);
    CHECK(std::any_of(causes.begin(), causes.end(), [&](const Cause& c) { return c.name == last.name; }));
    CHECK(std::none_of(causes.begin(), causes.end(), [&](const Cause& c) {
      return std::any_of(c.parameters.begin(), c.parameters.end(),
                         [&](const Parameter& p) { return p.name == last.parameter.name; });
    }));
    RockModel model = plan.model;
    const RockParameter& parameter = rock_parameter(last.parameter.name);
    CHECK(parameter.get(model) != doctest::Approx(last.value));
    parameter.set(model, last.value);
    CHECK(parameter.get(model) == doctest::Approx(last.value));
  }
  CHECK(complaint("damping:wind=0.3").find("there is no effect 'damping:wind'") != std::string::npos);
}

TEST_CASE("what a laboratory does wrong is read, and refused where it makes no sense") {
  const std::string stated = examples::diagnosis_plan("micro", 4).toml;
  const std::string truly =
      make_measured::as_it_was(stated, "experiments.tamped.fill.packing_friction=0.9,rock.density=1700");
  const test::ScratchFolder scratch;
  write_atomically(scratch / "calibration.toml", truly);
  const examples::Plan plan = examples::read_plan(scratch.path(), examples::Data::none);
  CHECK(plan.experiments[plan.index_of("tamped")].setup.find("\"fill.packing_friction\":0.9") !=
        std::string::npos);
  CHECK(plan.model.sample.rock.density == 1700.0);
  const auto refused = [&](const std::string& misstated) {
    CHECK_THROWS_AS((void)make_measured::as_it_was(stated, misstated), Error);
  };
  refused("rock.density");
  refused("=3");
  refused("nowhere.density=1700");

  auto readings = examples::diagnosis_plan("micro", 4).readings;
  make_measured::misread("tamped.bulk_density_kg_m3=1.2", readings);
  const auto tamped = std::find_if(readings.begin(), readings.end(),
                                   [](const examples::Reading& r) { return r.experiment == "tamped"; });
  CHECK(tamped->gains.at("bulk_density_kg_m3") == 1.2);
  for (const char* misread :
       {"tamped=1.2", "heap.angle_deg=2", "tamped.bulk_density_kg_m3=much", "tamped.bulk_density_kg_m3=0"}) {
    CAPTURE(misread);
    CHECK_THROWS_AS(make_measured::misread(misread, readings), Error);
  }
}

TEST_CASE("the catalogue has the null values of the plan's rock, and leaves out what is looked for anyway") {
  const examples::Plan plan = mini();
  const auto causes = diagnose::catalogue(plan, "");
  CHECK(causes.size() >= 11);
  CHECK(std::none_of(causes.begin(), causes.end(),
                     [](const Cause& c) { return c.name == "particle_density"; }));
  for (const Cause& cause : causes) {
    CAPTURE(cause.name);
    RockModel model = plan.model;
    const RockParameter& parameter = rock_parameter(cause.parameters.front().name);
    parameter.set(model, 0.5 * (cause.null.front() + cause.parameters.front().most));
    CHECK(parameter.get(model) ==
          doctest::Approx(0.5 * (cause.null.front() + cause.parameters.front().most)));
    RockModel null = plan.model;
    parameter.set(null, cause.null.front());
    CHECK(parameter.get(null) == parameter.get(plan.model));
    CHECK_FALSE(null.extended());
  }
  CHECK(diagnose::catalogue(plan, "damping,adhesion").size() == 2);

  // Of two shapes, one share says all; of one shape there is none.
  const auto of_shapes = [&](std::size_t count) {
    examples::Plan few = mini();
    std::vector<ShapeFraction> shapes = plan.model.sample.assembly.shapes();
    shapes.erase(shapes.begin() + static_cast<std::ptrdiff_t>(count), shapes.end());
    for (ShapeFraction& shape : shapes) {
      shape.fraction = 1.0 / static_cast<double>(count);
    }
    few.model.sample.assembly = Assembly{std::move(shapes)};
    const auto causes_of_shape = diagnose::catalogue(few, "shape_fraction");
    return causes_of_shape.empty() ? 0 : causes_of_shape.front().parameters.size();
  };
  CHECK(of_shapes(4) == 2);
  CHECK(of_shapes(3) == 2);
  CHECK(of_shapes(2) == 1);
  CHECK(of_shapes(1) == 0);
  CHECK_THROWS_WITH_AS(diagnose::catalogue(plan, "damping,wind"), doctest::Contains("there is no 'wind'"),
                       Error);
}

TEST_CASE("causes of the rig are considered where there is a drag") {
  const auto names = [](const examples::Plan& plan, const char* only) {
    std::vector<std::string> out;
    for (const Cause& cause : diagnose::catalogue(plan, only)) {
      cause.check();
      out.push_back(cause.name);
    }
    return out;
  };
  const std::vector<std::string> rig{"rope_stiffness", "load_cell", "bucket_inertia", "bed_floor"};
  const auto without = names(mini(), ""), with = names(plan_of("drag"), "");
  REQUIRE(with.size() == without.size() + rig.size());
  CHECK(std::equal(rig.begin(), rig.end(), with.end() - 4));
  CHECK(names(mini(), "damping,load_cell") == std::vector<std::string>{"damping"});

  // Whatever there is of a cause must be null in the plan's rock and rig.
  const examples::Plan plan = plan_of("drag");
  for (const Cause& cause : diagnose::catalogue(plan, "load_cell,bucket_inertia")) {
    CAPTURE(cause.name);
    REQUIRE(cause.parameters.size() == 2);
    for (std::size_t k = 0; k < 2; ++k) {
      CHECK(rock_parameter(cause.parameters[k].name).get(plan.model) == cause.null[k]);
    }
  }
}

TEST_CASE("a parameter of the gear that is looked for is none of a cause's any more") {
  examples::Plan plan = plan_of("drag");
  plan.space.push_back({.name = "load_cell_gain", .least = 0.9, .most = 1.1});
  const auto causes = diagnose::catalogue(plan, "load_cell");
  REQUIRE(causes.size() == 1);
  REQUIRE(causes[0].parameters.size() == 1);
  CHECK(causes[0].parameters[0].name == "load_cell_offset");
}

TEST_CASE("held-out experiments come last, and a calibration drops them") {
  examples::Plan plan = mini();
  REQUIRE(plan.experiments.size() == 10);
  CHECK_FALSE(plan.experiments[7].held_out);
  CHECK(plan.experiments[8].held_out);
  CHECK(plan.experiments[9].held_out);
  plan.drop_held_out();
  CHECK(plan.experiments.size() == 8);
  CHECK(plan.remarks.back() == "stronger is held out, and not looked at");
}
