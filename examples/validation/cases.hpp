#pragma once
/// \file
/// Every case of the validation. A case is a function of this header, written in the file of its subject.

#include "finding.hpp"

#include <string>
#include <vector>

namespace validation {

// normal_impact.cpp
Outcome elastic_normal_impact(const Inputs& inputs);
Outcome restitution(const Inputs& inputs);
// oblique_impact.cpp
Outcome oblique_impact_hertz_mindlin(const Inputs& inputs);
Outcome oblique_impact_linear(const Inputs& inputs);
// oblique_mfix.cpp
Outcome oblique_impact_mfix(const Inputs& inputs);
// spinning_impact.cpp
Outcome constant_normal_speed(const Inputs& inputs);
Outcome spinning_impact(const Inputs& inputs);
// single_spheres.cpp
Outcome falling_sphere(const Inputs& inputs);
Outcome stacked_spheres(const Inputs& inputs);
Outcome sliding_sphere(const Inputs& inputs);
// mfix_stored.cpp
Outcome mfix_stored(const Inputs& inputs);
// incline.cpp
Outcome sphere_on_incline(const Inputs& inputs);
Outcome block_on_incline(const Inputs& inputs);
// resisted_rolling.cpp
Outcome resisted_rolling(const Inputs& inputs);
// tangential_loop.cpp
Outcome tangential_loop(const Inputs& inputs);
// turning_pair.cpp
Outcome turning_pair(const Inputs& inputs);
// grazing_wall.cpp
Outcome grazing_wall(const Inputs& inputs);
// free_clump.cpp
Outcome free_clump(const Inputs& inputs);
// valley_pendulum.cpp
Outcome valley_pendulum(const Inputs& inputs);
// settled_column.cpp
Outcome settled_column(const Inputs& inputs);
// janssen.cpp
Outcome janssen(const Inputs& inputs);
// beverloo.cpp
Outcome beverloo(const Inputs& inputs);
// mesh_walls.cpp
Outcome mesh_drop(const Inputs& inputs);
Outcome mesh_roll(const Inputs& inputs);
// mesh_tube.cpp
Outcome mesh_tube(const Inputs& inputs);
// mesh_silo.cpp
Outcome mesh_silo(const Inputs& inputs);
// mesh_hopper.cpp
Outcome mesh_hopper(const Inputs& inputs);
// triaxial.cpp
Outcome triaxial(const Inputs& inputs);
// dosta_silo.cpp, dosta_drum.cpp, dosta_impact.cpp
Outcome dosta_silo(const Inputs& inputs);
Outcome dosta_drum(const Inputs& inputs);
Outcome dosta_impact(const Inputs& inputs);

struct Case {
  std::string name, brief;
  Outcome (*run)(const Inputs&);
};

/// In the order of the table.
const std::vector<Case>& all_cases();

/// \throws scree::Error for a name that no case has.
const Case& find_case(const std::string& name);

} // namespace validation
