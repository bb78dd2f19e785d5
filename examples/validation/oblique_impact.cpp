/// \file
/// Oblique impact of a sphere on a plane: Chung & Ooi (2011), tests 4 and 5, with the measurements of Kharaz,
/// Gorham & Salman (2001), by Hertz-Mindlin and by the linear law.

#include "cases.hpp"
#include "oblique.hpp"
#include "reference_curve.hpp"

#include "scree/contact/hertz_mindlin.hpp"
#include "scree/contact/linear_spring.hpp"

#include <fmt/format.h>

#include <string>
#include <vector>

namespace validation {

namespace {

/// Test 4: 5 mm spheres of aluminium oxide at 3.9 m/s from 1 to 86 degrees to the normal, on soda-lime glass
/// in the experiment and on a rigid plane in the test.
template <class Law>
Outcome measured_impacts(const Inputs& inputs, const std::string& law) {
  using kharaz::radius, kharaz::speed;
  constexpr double mu = kharaz::friction, e = kharaz::restitution;
  const scree::Material oxide = kharaz::aluminium_oxide(e);
  scree::Material plane = oxide;
  plane.youngs_modulus *= 1e3;
  const double mass = 4.0 / 3.0 * std::numbers::pi * std::pow(radius, 3) * oxide.density;
  const HertzImpact hertz_time{effective_modulus(oxide, plane), radius, mass, speed};
  const double linear_time = std::numbers::pi * std::sqrt(mass / oxide.normal_stiffness);
  const double duration = std::is_same_v<Law, scree::LinearSpring<>> ? linear_time : hertz_time.duration;
  const std::string name = "Chung & Ooi 4 (Kharaz), " + law;
  const auto at = [&](double angle) {
    return oblique_impact<Law>(
        oxide, plane, radius, speed * std::cos(angle * degree), speed * std::sin(angle * degree),
        duration * std::pow(std::cos(angle * degree), -0.2), scree::Stiffness::of_contact);
  };

  Outcome out;
  Series restitution{"scree, " + law, Origin::code, {}, {}}, spin = restitution, patch = restitution;
  for (double angle = 1.0; angle < 87.0; angle += 1.0) {
    const Oblique found = at(angle);
    for (Series* series : {&restitution, &spin, &patch}) {
      series->x.push_back(angle);
    }
    restitution.y.push_back(found.tangential_restitution);
    spin.y.push_back(found.spin);
    patch.y.push_back(found.patch_angle);
  }

  // Sliding from beginning to end, whatever the law: friction is mu times the normal impulse.
  const Source sliding{Origin::theory, "rigid sphere that slides throughout: 1 - mu (1 + e) / tan(angle)"};
  const auto slid = [](double angle) { return 1.0 - mu * (1.0 + e) / std::tan(angle * degree); };
  const double overlap = std::is_same_v<Law, scree::LinearSpring<>>
                             ? speed * std::sqrt(mass / oxide.normal_stiffness)
                             : hertz_time.greatest_overlap;
  for (const double angle : {40.0, 50.0, 60.0, 70.0}) {
    out.add(name, fmt::format("tangential restitution at {:.0f} degrees", angle), "1", slid(angle), sliding,
            value_at(restitution, angle), sliding_tolerance());
    const double w = 2.5 * mu * (1.0 + e) * speed * std::cos(angle * degree) / radius;
    out.add(name, fmt::format("spin at {:.0f} degrees", angle), "rad/s", w,
            {Origin::theory, "rigid sphere that slides throughout: 5/2 mu (1 + e) v_n / r"},
            value_at(spin, angle), sliding_tolerance(0.5 * overlap / radius));
  }
  if (inputs.reference.empty()) {
    out.notes.push_back(name + ": measurements and other codes need the reference data");
    return out;
  }
  const auto file = inputs.file("chung_ooi/test4_oblique.csv");
  const auto compare = [&](const std::string& quantity, const std::string& label, const std::string& y_label,
                           Series simulated, bool measured_there) {
    Chart chart{
        "test4_" + label + "_" + law, name, "incident angle, degrees from the normal", y_label, {}, {}};
    const Series code = read_series(file, "DEM_Al_oxide", quantity, "Chung & Ooi, DEM", Origin::code);
    chart.references.push_back(code);
    if (measured_there) {
      const Series measured =
          read_series(file, "EXPERIMENT_Kharaz2001", quantity, "Kharaz et al., measured", Origin::experiment);
      double height = 0.0;
      for (const double y : measured.y) {
        height = std::max(height, std::abs(y));
      }
      // How far the other code is from the measurements is what a model of this kind can be asked for.
      const double spread = rms_distance(measured, code) / height;
      out.add(name, y_label + ": rms distance over the greatest", "1", 0.0,
              {Origin::experiment, "Kharaz, Gorham & Salman (2001)"},
              rms_distance(measured, simulated) / height,
              {1.5 * spread, false, "1.5 x that of Chung & Ooi's own simulation"});
      chart.references.push_back(measured);
    }
    chart.simulated.push_back(std::move(simulated));
    out.draw(std::move(chart));
  };
  for (double& w : spin.y) {
    w = -w; // the sign of the figure
  }
  compare("tangential_restitution_vt_out_over_vt_in", "restitution", "tangential restitution", restitution,
          false);
  compare("final_angular_velocity_rad_s", "spin", "spin, rad/s", spin, true);
  compare("rebound_angle_contact_patch_deg", "patch", "rebound angle of the contact patch, degrees", patch,
          true);
  return out;
}

} // namespace

Outcome oblique_impact_hertz_mindlin(const Inputs& inputs) {
  return measured_impacts<scree::HertzMindlin<>>(inputs, "Hertz-Mindlin");
}

Outcome oblique_impact_linear(const Inputs& inputs) {
  return measured_impacts<scree::LinearSpring<>>(inputs, "linear");
}

} // namespace validation
