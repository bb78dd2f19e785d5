/// \file
/// Chung & Ooi (2011), tests 1 to 3: normal impact, elastic and with restitution.

#include "cases.hpp"
#include "impact.hpp"
#include "reference_curve.hpp"

#include "scree/contact/hertz_mindlin.hpp"

#include <fmt/format.h>

#include <string>
#include <vector>

namespace validation {

const Source hertz{Origin::theory, "Hertz (1882), closed form of the elastic impact"};

namespace {

/// Extremes of an elastic impact beside Hertz's.
void compare_with_hertz(Outcome& out, const std::string& case_name, const ImpactRecord& record,
                        const HertzImpact& theory, int steps) {
  // The leapfrog is of second order; the end of a contact is known to one step.
  const Tolerance second_order{10.0 * std::pow(std::numbers::pi / steps, 2), true,
                               "second order of the time step"};
  const Tolerance one_step{2.0 / steps, true, "one time step at either end"};
  out.add(case_name, "greatest force", "N", theory.greatest_force, hertz, record.greatest_force,
          second_order);
  out.add(case_name, "greatest overlap", "m", theory.greatest_overlap, hertz, record.greatest_overlap,
          second_order);
  out.add(case_name, "duration", "s", theory.duration, hertz, record.duration, one_step);
}

/// A curve read off the figure, beside what was simulated.
void compare_with_curve(Outcome& out, const std::string& case_name, const Inputs& inputs,
                        const std::string& file, const std::string& quantity, const std::string& x_label,
                        std::vector<double> x, const std::vector<double>& force) {
  if (inputs.reference.empty()) {
    out.notes.push_back(case_name + ": the digitised curve needs the reference data");
    return;
  }
  Series read = read_curve(inputs.file(file), "Chung & Ooi (2011), digitised", Origin::code);
  Series simulated{"scree", Origin::code, std::move(x), {}};
  for (const double f : force) {
    simulated.y.push_back(1e-3 * f);
  }
  const double scale = *std::max_element(read.y.begin(), read.y.end());
  out.add(case_name, quantity + ": rms distance over the greatest", "1", 0.0,
          {Origin::code, "Chung & Ooi (2011), figure digitised by the Kratos project"},
          rms_distance(read, simulated) / scale,
          {0.02, false, "reading of a printed figure, 2 % of its height (ours)"});
  out.draw({file.substr(file.find('/') + 1, file.rfind('.') - file.find('/') - 1),
            case_name,
            x_label,
            "force, kN",
            {std::move(read)},
            {std::move(simulated)}});
}

} // namespace

/// Tests 1 and 2: two like spheres at 10 m/s each, and a sphere on a rigid plane at 0.2 m/s.
Outcome elastic_normal_impact(const Inputs& inputs) {
  struct Given {
    const char* name;
    scree::Material material;
    double radius, speed;
    bool plane;
    const char* curve;
  };
  // Inputs of Chung & Ooi (2011), table 2, as the YADE project states them (examples of test 1 and 2).
  const std::vector<Given> all{
      {"Chung & Ooi 1, glass",
       {.density = 2800,
        .youngs_modulus = 4.8e10,
        .poisson_ratio = 0.20,
        .friction = 0.35,
        .restitution = 1.0},
       0.010,
       10.0,
       false,
       "chung_ooi/test1"},
      {"Chung & Ooi 1, limestone",
       {.density = 2500,
        .youngs_modulus = 2.0e10,
        .poisson_ratio = 0.25,
        .friction = 0.35,
        .restitution = 1.0},
       0.010,
       10.0,
       false,
       nullptr},
      {"Chung & Ooi 2, aluminium alloy",
       {.density = 2699,
        .youngs_modulus = 7.0e10,
        .poisson_ratio = 0.30,
        .friction = 0.0,
        .restitution = 1.0},
       0.1,
       0.2,
       true,
       "chung_ooi/test2"},
      {"Chung & Ooi 2, magnesium alloy",
       {.density = 1800,
        .youngs_modulus = 4.0e10,
        .poisson_ratio = 0.35,
        .friction = 0.0,
        .restitution = 1.0},
       0.1,
       0.2,
       true,
       nullptr},
  };
  constexpr int steps = 2000;
  Outcome out;
  for (const Given& g : all) {
    std::vector<Ball> balls{{g.material, g.radius, {0.0, 0.0, -g.speed}}};
    const scree::Material plane = rigid(g.material);
    const double mass = mass_of(balls.front());
    if (!g.plane) {
      balls.push_back({g.material, g.radius, {0.0, 0.0, g.speed}});
    }
    const HertzImpact theory{effective_modulus(g.material, g.plane ? plane : g.material),
                             g.plane ? g.radius : 0.5 * g.radius, g.plane ? mass : 0.5 * mass,
                             g.plane ? g.speed : 2.0 * g.speed};
    const auto record =
        impact<scree::HertzMindlin<>>(balls, g.plane ? &plane : nullptr, theory.duration, steps);
    compare_with_hertz(out, g.name, record, theory, steps);
    if (g.curve != nullptr) {
      std::vector<double> micrometres, microseconds;
      for (std::size_t k = 0; k < record.time.size(); ++k) {
        micrometres.push_back(1e6 * record.overlap[k]);
        microseconds.push_back(1e6 * (record.time[k] - record.time.front()));
      }
      const std::string file = g.curve;
      compare_with_curve(out, g.name, inputs, file + "_force_displacement.csv", "force over overlap",
                         "overlap, um", micrometres, record.force);
      compare_with_curve(out, g.name, inputs, file + "_force_time.csv", "force over time", "time, us",
                         microseconds, record.force);
    }
  }
  return out;
}

/// Test 3: what comes back of 3.9 m/s for restitutions of 0.2 to 1.
Outcome restitution(const Inputs& /*inputs*/) {
  constexpr int steps = 4000;
  constexpr double radius = 0.0025, speed = 3.9;
  Outcome out;
  for (const bool iron : {false, true}) {
    const char* name = iron ? "Chung & Ooi 3, cast iron" : "Chung & Ooi 3, aluminium oxide";
    Series simulated{name, Origin::code, {}, {}}, given{"requested", Origin::theory, {}, {}};
    for (const double e : {0.2, 0.4, 0.6, 0.8, 1.0}) {
      scree::Material material{.density = 4000, .youngs_modulus = 3.8e11, .poisson_ratio = 0.23};
      if (iron) {
        material.density = 7000;
        material.youngs_modulus = 1e11;
        material.poisson_ratio = 0.25;
      }
      material.restitution = e;
      const Ball ball{material, radius, {0.0, 0.0, -speed}};
      const scree::Material plane = rigid(material);
      const HertzImpact theory{effective_modulus(material, plane), radius, mass_of(ball), speed};
      const auto record = impact<scree::HertzMindlin<>>({ball}, &plane, theory.duration, steps);
      const double back = record.after[0].velocity.z() / speed;
      out.add(name, fmt::format("restitution of {}", e), "1", e, {Origin::theory, "the one requested"}, back,
              {10.0 / steps, false, "a few time steps at the end of the contact"});
      given.x.push_back(e);
      given.y.push_back(e);
      simulated.x.push_back(e);
      simulated.y.push_back(back);
    }
    out.draw({iron ? "test3_cast_iron" : "test3_aluminium_oxide",
              name,
              "restitution requested",
              "restitution found",
              {given},
              {simulated}});
  }
  return out;
}

} // namespace validation
