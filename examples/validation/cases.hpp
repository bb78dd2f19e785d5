#pragma once
/// \file
/// Every case of the validation, by name.

#include "finding.hpp"
#include "normal_impact.hpp"
#include "oblique_impact.hpp"
#include "single_spheres.hpp"
#include "spinning_impact.hpp"

#include <functional>
#include <string>
#include <vector>

namespace validation {

struct Case {
  std::string name, brief;
  std::function<Outcome(const Inputs&)> run;
};

inline std::vector<Case> all_cases() {
  return {
      {"normal_impact", "Chung & Ooi 1 and 2", elastic_normal_impact},
      {"restitution", "Chung & Ooi 3", restitution},
      {"oblique_impact", "Chung & Ooi 4, Kharaz et al., Hertz-Mindlin",
       [](const Inputs& in) { return kharaz<scree::HertzMindlin<>>(in, "Hertz-Mindlin"); }},
      {"oblique_impact_linear", "the same by the linear law",
       [](const Inputs& in) { return kharaz<scree::LinearSpring<>>(in, "linear"); }},
      {"constant_normal_speed", "Chung & Ooi 5", constant_normal_speed},
      {"falling_sphere", "MFiX DEM01 and DEM02", falling_sphere},
      {"stacked_spheres", "MFiX DEM03", stacked_spheres},
      {"sliding_sphere", "MFiX DEM04", sliding_sphere},
      {"spinning_impact", "Chung & Ooi 6 to 8", spinning_impact},
  };
}

} // namespace validation
