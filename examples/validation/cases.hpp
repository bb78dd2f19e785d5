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
// spinning_impact.cpp
Outcome constant_normal_speed(const Inputs& inputs);
Outcome spinning_impact(const Inputs& inputs);
// single_spheres.cpp
Outcome falling_sphere(const Inputs& inputs);
Outcome stacked_spheres(const Inputs& inputs);
Outcome sliding_sphere(const Inputs& inputs);
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
