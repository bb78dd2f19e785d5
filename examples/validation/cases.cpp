#include "cases.hpp"

#include "scree/core/error.hpp"

#include <algorithm>

namespace validation {

const std::vector<Case>& all_cases() {
  static const std::vector<Case> cases{
      {"normal_impact", "Chung & Ooi 1 and 2", elastic_normal_impact},
      {"restitution", "Chung & Ooi 3", restitution},
      {"oblique_impact", "Chung & Ooi 4, Kharaz et al., Hertz-Mindlin", oblique_impact_hertz_mindlin},
      {"oblique_impact_linear", "the same by the linear law", oblique_impact_linear},
      {"constant_normal_speed", "Chung & Ooi 5", constant_normal_speed},
      {"spinning_impact", "Chung & Ooi 6 to 8", spinning_impact},
      {"falling_sphere", "MFiX DEM01 and DEM02", falling_sphere},
      {"stacked_spheres", "MFiX DEM03", stacked_spheres},
      {"sliding_sphere", "MFiX DEM04", sliding_sphere},
      {"dosta_silo", "Dosta et al. 1, silo", dosta_silo},
      {"dosta_drum", "Dosta et al. 2, drum", dosta_drum},
      {"dosta_impact", "Dosta et al. 3, impact on a bed", dosta_impact},
  };
  return cases;
}

const Case& find_case(const std::string& name) {
  const auto found =
      std::find_if(all_cases().begin(), all_cases().end(), [&](const Case& c) { return c.name == name; });
  if (found == all_cases().end()) {
    throw scree::Error(scree::message("no case is named '", name, "'"));
  }
  return *found;
}

} // namespace validation
