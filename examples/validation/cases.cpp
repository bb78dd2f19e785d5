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
      {"oblique_impact_mfix", "MFiX DEM05, Kharaz et al.", oblique_impact_mfix},
      {"constant_normal_speed", "Chung & Ooi 5", constant_normal_speed},
      {"spinning_impact", "Chung & Ooi 6 to 8", spinning_impact},
      {"falling_sphere", "MFiX DEM01 and DEM02", falling_sphere},
      {"stacked_spheres", "MFiX DEM03", stacked_spheres},
      {"sliding_sphere", "MFiX DEM04", sliding_sphere},
      {"mfix_stored", "MFiX DEM02 to DEM04, its own results", mfix_stored},
      {"sphere_on_incline", "a sphere that rolls or slides down an incline", sphere_on_incline},
      {"block_on_incline", "a block that sticks or slides on an incline", block_on_incline},
      {"resisted_rolling", "an incline with rolling resistance", resisted_rolling},
      {"tangential_loop", "tangential loading, unloading and reloading", tangential_loop},
      {"turning_pair", "the tangential force of a pair that turns", turning_pair},
      {"grazing_wall", "walls make no energy", grazing_wall},
      {"free_clump", "a clump that turns freely", free_clump},
      {"valley_pendulum", "a clump that swings in a trough", valley_pendulum},
      {"settled_column", "weight above, level and on a slope", settled_column},
      {"janssen", "force on the bottom of a filled tube", janssen},
      {"beverloo", "discharge through a circular orifice", beverloo},
      {"mesh_drop", "dropped on a mesh and on a plane", mesh_drop},
      {"mesh_roll", "rolling on a mesh and on a plane", mesh_roll},
      {"mesh_tube", "rolling in a tessellated tube", mesh_tube},
      {"mesh_silo", "a silo as a cylinder and as meshes", mesh_silo},
      {"mesh_hopper", "a hopper as planes and as meshes", mesh_hopper},
      {"triaxial", "triaxial compression of spheres", triaxial},
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
